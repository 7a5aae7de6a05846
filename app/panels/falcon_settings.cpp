// The Falcon's workspace, buttons and constants in the Device panel.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

void draw_number(const FalconNumber& number, FalconSettings& settings) {
    FalconSettings standard;
    double shown = number.in(settings)*number.shown;
    const NumberRow row{
        .label = number.label,
        .format = number.format,
        .lowest = number.lowest * number.shown,
        .highest = number.highest * number.shown,
        .standard = number.in(standard)*number.shown,
        .help = number.help,
        .logarithmic = number.lowest > 0.0 && number.highest > 50.0 * number.lowest};
    const bool changed = number_row(row, shown);
    if (changed) {
        number.in(settings) = std::clamp(shown / number.shown, number.lowest, number.highest);
    }
}

void draw_numbers(FalconTopic topic, FalconSettings& settings) {
    for (const FalconNumber& number : falcon_numbers()) {
        if (number.topic == topic) draw_number(number, settings);
    }
}

void draw_workspace(ViewerState& state) {
    falcon::WorkspaceOptions& workspace = state.settings.falcon.workspace;
    if (ImGui::Button("Fit the image")) {
        workspace.scale = falcon::fitting_scale(
            {state.media.depth_columns, state.media.depth_rows,
             state.settings.touch.shape.relief_px, state.settings.touch.coupling.pixel_pitch_mm},
            workspace);
    }
    explain("The scale at which the hand reaches the whole image");
    ImGui::SameLine();
    if (ImGui::Button("Centre the hand")) ++state.centred;
    explain("Takes back what the clutch has shifted (C)");
    draw_numbers(FalconTopic::workspace, state.settings.falcon);
}

void draw_buttons(ButtonActions& buttons) {
    for (std::size_t k = 0; k < kFalconButtons; ++k) {
        choice_row(kGripButtons[k].label, button_jobs(), buttons[k],
                   "What this button of the grip does", kStandardButtons[k]);
    }
}

void draw_connection(ViewerState& state) {
    falcon::ConnectionOptions& connection = state.settings.falcon.connection;
    const falcon::ConnectionOptions standard;
    fact_row("Firmware", state.falcon->firmware.empty() ? "none kept" : state.falcon->firmware);
    if (state.falcon->status.stage != falcon::Stage::no_firmware) draw_firmware_field(state);
    flag_row("Event character", connection.event_character, standard.event_character,
             "The USB chip passes a reply on at its last byte instead of a millisecond later; not "
             "tried on a real Falcon yet");
    flag_row("Slower firmware loading", connection.slower_upload, standard.slower_upload,
             "140 351 baud instead of 142 857; both are reported to work");
    std::array<char, 64> serial{};
    connection.serial.copy(serial.data(), serial.size() - 1);
    if (text_field("##serial", "Serial: the first one found", serial,
                   "Which Falcon, when several are attached", false)) {
        connection.serial = serial.data();
    }
    quiet_text("These are used from the next start of the program.");
}

}  // namespace

void draw_falcon_settings(ViewerState& state) {
    FalconSettings& settings = state.settings.falcon;
    if (part("Workspace")) draw_workspace(state);
    if (part("Buttons")) draw_buttons(settings.buttons);
    if (part("Calibration")) {
        quiet_text(
            "Sources differ on these; the defaults are libnifalcon's. Each change lets the "
            "force rise again from zero.");
        draw_numbers(FalconTopic::motors, settings);
        draw_numbers(FalconTopic::geometry, settings);
    }
    if (part("Connection")) draw_connection(state);
}

}  // namespace dibhr
