// A force device in the Device panel: its state and the next step; then its settings by topic.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/button_action_names.hpp"
#include "app/touching/device_state.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

namespace {

void draw_device_value(const DeviceRow& row, bool* value, const bool* usual) {
    flag_row(row.label, *value, *usual, row.help);
}

void draw_device_value(const DeviceRow& row, double* value, const double* usual) {
    double shown = *value * row.panel_factor;
    const NumberRow number{.label = row.label,
                           .format = row.format,
                           .lowest = row.lowest * row.panel_factor,
                           .highest = row.highest * row.panel_factor,
                           .standard = *usual * row.panel_factor,
                           .help = row.help,
                           .logarithmic = row.lowest > 0.0 && row.highest > 50.0 * row.lowest};
    if (number_row(number, shown))
        *value = std::clamp(shown / row.panel_factor, row.lowest, row.highest);
}

void draw_device_value(const DeviceRow& row, int* value, const int* usual) {
    double number = *value;
    const double standard = *usual;
    draw_device_value(row, &number, &standard);
    *value = static_cast<int>(std::lround(number));
}

void draw_device_value(const DeviceRow& row, std::string* value, const std::string*) {
    std::array<char, 128> text{};
    const auto room = std::span(text).first(static_cast<std::size_t>(row.highest) + 1);
    value->copy(room.data(), room.size() - 1);
    const std::string id = "##" + std::string(row.topic) + "-" + std::string(row.name);
    if (text_field(id.c_str(), row.label, room, row.help, false)) *value = room.data();
}

void draw_device_value(const DeviceRow& row, ButtonAction* value, const ButtonAction* usual) {
    choice_row(row.label, button_jobs(), *value, row.help, *usual);
}

void draw_device_value(const DeviceRow& row, const DeviceEnum& value, const DeviceEnum& usual) {
    int chosen = *value;
    index_row(row.label, value.labels, chosen, row.help, *usual);
    *value = static_cast<std::uint8_t>(chosen);
}

/// The rows of `topic`, text inputs last.
void draw_device_rows(DeviceSettings& settings, DeviceSettings& standard, std::string_view topic) {
    const std::vector<DeviceRow> rows = settings.rows();
    const std::vector<DeviceRow> usual = standard.rows();
    for (const bool texts : {false, true}) {
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if (rows[k].topic != topic) continue;
            std::visit(
                [&]<typename Place>(const Place& value) {
                    if (std::is_same_v<Place, std::string*> == texts)
                        draw_device_value(rows[k], value, std::get<Place>(usual[k].value));
                },
                rows[k].value);
        }
    }
}

void draw_line(const DeviceLine& line) {
    if (*line.label != '\0') {
        fact_row(line.label, line.text, line.help);
        return;
    }
    draw_dimmed(capitalised(line.text));
    if (*line.help != '\0') add_tooltip(line.help);
}

void draw_sentence(const DeviceState& device) {
    const std::string sentence = capitalised(device.sentence);
    if (sentence.empty()) return;
    if (device.trouble) {
        draw_warning(sentence);
    } else if (device.needs_person) {
        ImGui::TextWrapped("%s", sentence.c_str());
    } else {
        draw_dimmed(sentence);
    }
}

/// The input for the path of the firmware file.
void draw_firmware_field(ViewerState& state) {
    const bool entered = text_field("##firmware", "Firmware file (.bin)", state.ui.fields.firmware,
                                    "Path of the firmware; Enter loads it. The file is checked "
                                    "first, and kept for the next time");
    const bool named = state.ui.fields.firmware[0] != '\0';
    const bool pressed = button_or_drop("Load", named, "the file");
    if ((entered || pressed) && named) {
        state.commands.push(UseFirmware{expand_home(state.ui.fields.firmware.data())});
    }
}

void draw_missing_firmware(ViewerState& state, const DeviceFirmware& firmware) {
    if (!firmware.trouble.empty()) draw_warning(capitalised(firmware.trouble));
    draw_firmware_field(state);
}

/// Two clicks: the first one shows the warning beside the button that agrees.
void draw_offer(ViewerState& state, std::size_t kind, const DeviceOffer& offer) {
    if (offer.warning.empty()) {
        if (item::button(offer.label.c_str()))
            state.commands.push(AgreeToDevice{kind, offer.number});
        return;
    }
    const std::string popup = "##agree" + std::to_string(offer.number);
    if (item::button((offer.label + "...").c_str())) ImGui::OpenPopup(popup.c_str());
    if (!ImGui::BeginPopup(popup.c_str())) return;
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0F);
    ImGui::TextUnformatted(offer.warning.c_str());
    ImGui::PopTextWrapPos();
    if (item::button(offer.label.c_str())) {
        state.commands.push(AgreeToDevice{kind, offer.number});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (item::button("Not now")) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void draw_progress(const DeviceProgress& progress) {
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImGui::GetStyleColorVec4(ImGuiCol_SliderGrab));
    ImGui::ProgressBar(static_cast<float>(progress.part), {-1.0F, 0.0F}, progress.text.c_str());
    ImGui::PopStyleColor();
}

ImVec4 colour_of(DeviceLamp::Colour colour) {
    switch (colour) {
        case DeviceLamp::Colour::red:
            return {0.90F, 0.30F, 0.27F, 1.0F};
        case DeviceLamp::Colour::green:
            return {0.36F, 0.78F, 0.45F, 1.0F};
        case DeviceLamp::Colour::blue:
            return {0.36F, 0.56F, 0.95F, 1.0F};
    }
    return {};
}

void draw_lamp(const DeviceLamp& lamp) {
    fact_row(lamp.label, std::string("     ") + lamp.text);
    const ImVec2 low = ImGui::GetItemRectMin();
    const float line = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled({low.x + line * 0.45F, low.y + line * 0.5F},
                                                line * 0.36F,
                                                ImGui::GetColorU32(colour_of(lamp.colour)), 20);
}

/// Above the rows of the topic that maps the device to the image.
void draw_placing(ViewerState& state, DeviceSettings& settings, const char* fit_help) {
    if (item::button("Fit the image")) {
        settings.fit({state.media.depth_columns, state.media.depth_rows,
                      state.settings.touch.shape.relief_px,
                      state.settings.touch.coupling.pixel_pitch_mm});
    }
    add_tooltip(fit_help);
    ImGui::SameLine();
    if (item::button("Centre the workspace")) ++state.touch.centre_count;
    add_tooltip("Takes back what the clutch has shifted", state.keys, Action::centre_workspace);
}

/// Above the rows of the topic on the connection.
void draw_connection(ViewerState& state, const DeviceInfo& info) {
    if (const auto& firmware = info.state.firmware) {
        fact_row("Firmware", firmware->name.empty() ? "none kept" : firmware->name);
        if (!firmware->needed) draw_firmware_field(state);
    }
    for (const DeviceLine& line : info.kept) draw_line(line);
}

}  // namespace

void draw_force_device(ViewerState& state, const DeviceInfo& info) {
    const DeviceState& device = info.state;
    ImGui::PushID(force_device_kinds()[info.kind]->name);
    draw_line(device.name_line);
    draw_sentence(device);
    if (!device.unguarded.empty()) draw_warning(capitalised(device.unguarded));
    if (device.firmware && device.firmware->needed) draw_missing_firmware(state, *device.firmware);
    if (device.offer) draw_offer(state, info.kind, *device.offer);
    if (device.progress) draw_progress(*device.progress);
    if (!device.homing.empty()) draw_homing_guide(device.homing);
    const bool pushes = glm::length(state.touch.haptic.touch.sent_force_newton) > 0.0;
    if (const auto& lamp = pushes ? device.pushing_lamp : device.lamp) draw_lamp(*lamp);
    for (const DeviceLine& line : device.lines) draw_line(line);
    fact_row("Touches", touching_text(state.touch));
    ImGui::PopID();
}

void draw_force_device_settings(ViewerState& state, const DeviceInfo& info) {
    DeviceSettings& settings = state.settings.devices[info.kind];
    const auto standard = force_device_kinds()[info.kind]->make_settings();
    ImGui::PushID(force_device_kinds()[info.kind]->name);  // kinds have rows with equal labels
    for (const DeviceTopic& topic : settings.topics()) {
        if (!subsection(topic.name)) continue;
        if (*topic.remark != '\0') draw_dimmed(topic.remark);
        if (*topic.fit_help != '\0') draw_placing(state, settings, topic.fit_help);
        if (topic.connection) draw_connection(state, info);
        draw_device_rows(settings, *standard, topic.name);
        if (topic.connection) draw_dimmed("Changes here count from the next start of the program.");
    }
    ImGui::PopID();
}

}  // namespace dibhr
