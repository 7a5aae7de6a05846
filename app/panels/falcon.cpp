// The Falcon in the Device panel: what it does, and what it needs next.
#include <glm/geometric.hpp>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

using falcon::Stage;

std::string name_text(const falcon::Status& status) {
    if (!status.serial.empty()) return status.serial;
    return status.stage == Stage::looking ? "none attached" : "attached";
}

/// The logo's colour, as the driver lights it (fact sheet, section 9).
struct Light {
    ImVec4 colour;
    const char* text;
};

Light light_of(const ViewerState& state) {
    const ImVec4 kRed{0.90F, 0.30F, 0.27F, 1.0F};
    const ImVec4 kBlue{0.36F, 0.56F, 0.95F, 1.0F};
    const ImVec4 kGreen{0.36F, 0.78F, 0.45F, 1.0F};
    if (state.falcon->status.stage == Stage::homing) return {kRed, "red: to be homed"};
    const bool force = glm::length(state.haptic.touch.sent_force_newton) > 0.0;
    return force ? Light{kGreen, "green: force"} : Light{kBlue, "blue: ready"};
}

void draw_light(const ViewerState& state) {
    const Light light = light_of(state);
    fact_row("Logo", std::string("     ") + light.text);
    const ImVec2 low = ImGui::GetItemRectMin();
    const float line = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled({low.x + line * 0.45F, low.y + line * 0.5F},
                                                line * 0.36F, ImGui::GetColorU32(light.colour), 20);
}

void draw_progress(const falcon::Status& status) {
    const std::string text =
        status.load_try > 1 ? formatted("%.0f %%, try %d", 100.0 * status.loaded, status.load_try)
                            : formatted("%.0f %%", 100.0 * status.loaded);
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImGui::GetStyleColorVec4(ImGuiCol_SliderGrab));
    ImGui::ProgressBar(static_cast<float>(status.loaded), {-1.0F, 0.0F}, text.c_str());
    ImGui::PopStyleColor();
}

void draw_firmware(ViewerState& state) {
    if (!state.falcon->firmware_trouble.empty()) {
        trouble_text(capitalised(state.falcon->firmware_trouble));
    }
    draw_firmware_field(state);
}

void draw_exchange(const ViewerState& state) {
    const falcon::Status& status = state.falcon->status;
    draw_light(state);
    fact_row("Replies", formatted("%.0f per second", status.replies_per_s));
    if (status.resent + status.line_errors + status.bytes_discarded > 0) {
        fact_row("Link", formatted("%llu sent again, %llu line errors, %llu bytes lost",
                                   static_cast<unsigned long long>(status.resent),
                                   static_cast<unsigned long long>(status.line_errors),
                                   static_cast<unsigned long long>(status.bytes_discarded)));
    }
}

}  // namespace

void draw_firmware_field(ViewerState& state) {
    const bool entered = text_field(
        "##firmware", "Firmware file (.bin)", state.fields.firmware,
        "Path of the firmware; Enter takes it. It is checked first, and kept for the next time");
    ImGui::BeginDisabled(state.fields.firmware[0] == '\0');
    const bool pressed = ImGui::Button("Load");
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("or drop the file on the window");
    if ((entered || pressed) && state.fields.firmware[0] != '\0') {
        state.requests.firmware = std::filesystem::path(state.fields.firmware.data());
    }
}

void draw_falcon_state(ViewerState& state) {
    const falcon::Status& status = state.falcon->status;
    fact_row("Falcon", name_text(status));
    if (!status.sentence.empty()) {
        const std::string sentence = capitalised(status.sentence);
        if (status.trouble) {
            trouble_text(sentence);
        } else if (status.stage == Stage::looking || status.stage == Stage::ready) {
            quiet_text(sentence);
        } else {
            ImGui::TextWrapped("%s", sentence.c_str());
        }
    }
    if (status.stage == Stage::no_firmware) draw_firmware(state);
    if (status.stage == Stage::loading) draw_progress(status);
    if (status.stage == Stage::homing) draw_homing_guide(state);
    if (status.stage == Stage::homing || status.stage == Stage::ready) draw_exchange(state);
    fact_row("Touches", state.haptic.hand.stand_in ? "the mouse, meanwhile" : "the Falcon");
}

}  // namespace dibhr
