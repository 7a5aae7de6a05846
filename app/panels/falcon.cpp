// The Falcon in the Device panel: what it does, what it needs next, with the homing guide; then its
// workspace, buttons and constants.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string>

#include "app/panels/device_rows.hpp"
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/touching/device_state.hpp"

namespace dibhr {

namespace {

constexpr float kHeight = 5.2F;   // of the picture, text lines
constexpr double kOut_s = 1.6;    // the grip is pulled out so long,
constexpr double kPause_s = 0.6;  // pauses,
constexpr double kIn_s = 1.2;     // is pushed in, and pauses again
constexpr double kCycle_s = kOut_s + kIn_s + 2.0 * kPause_s;
constexpr std::array kAxes{"Top", "Right", "Left"};

/// Where the grip is, 0: in, 1: all the way out, and which of the two steps that is.
struct Movement {
    float out{0.0F};
    bool pulling{true};
};

float eased(double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    return static_cast<float>(s * s * (3.0 - 2.0 * s));
}

Movement movement_at(double t_s) {
    const double t = std::fmod(t_s, kCycle_s);
    if (t < kOut_s + kPause_s) return {eased(t / kOut_s), true};
    return {1.0F - eased((t - kOut_s - kPause_s) / kIn_s), false};
}

ImVec2 between(ImVec2 from, ImVec2 to, float share) {
    return {from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share};
}

/// One of the legs: a thigh from the base to its elbow, and a shin from there to the grip.
void draw_leg(ImDrawList& list, ImVec2 hip, ImVec2 grip, float up, float unit, ImU32 colour) {
    const ImVec2 middle = between(hip, grip, 0.42F);
    const ImVec2 elbow{middle.x, middle.y - up * unit * 0.75F};
    list.AddLine(hip, elbow, colour, unit * 0.16F);
    list.AddLine(elbow, grip, colour, unit * 0.10F);
    list.AddCircleFilled(elbow, unit * 0.12F, colour);
}

void draw_arrow(ImDrawList& list, ImVec2 from, ImVec2 to, float unit, ImU32 colour) {
    const float way = to.x > from.x ? 1.0F : -1.0F;
    list.AddLine(from, {to.x - way * unit * 0.3F, to.y}, colour, unit * 0.12F);
    list.AddTriangleFilled({to.x, to.y}, {to.x - way * unit * 0.45F, to.y - unit * 0.28F},
                           {to.x - way * unit * 0.45F, to.y + unit * 0.28F}, colour);
}

void draw_device(ImDrawList& list, ImVec2 low, ImVec2 high, const Movement& movement) {
    const float unit = (high.y - low.y) / kHeight;
    const float middle = (low.y + high.y) * 0.5F;
    const ImU32 body = ImGui::GetColorU32(ImGuiCol_ButtonActive);
    const ImU32 legs = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    const ImU32 accent = ImGui::GetColorU32(ImGuiCol_CheckMark);
    const float left = (low.x + high.x) * 0.5F - 5.5F * unit;
    const float front = left + 1.8F * unit;
    const float in = front + 1.6F * unit;
    const float out = front + 8.0F * unit;
    const ImVec2 grip{in + (out - in) * movement.out, middle};
    list.AddRectFilled({left, middle - 1.7F * unit}, {front, middle + 1.7F * unit}, body,
                       unit * 0.6F);
    draw_leg(list, {front, middle - 1.1F * unit}, grip, 1.0F, unit, legs);
    draw_leg(list, {front, middle + 1.1F * unit}, grip, -1.0F, unit, legs);
    list.AddCircleFilled(grip, unit * 0.8F, accent, 32);
    const float y = high.y - 0.15F * unit;
    movement.pulling ? draw_arrow(list, {in, y}, {out, y}, unit, accent)
                     : draw_arrow(list, {out, y}, {in, y}, unit, accent);
}

void draw_step(const char* text, bool now) {
    ImGui::PushStyleColor(
        ImGuiCol_Text, ImGui::GetStyleColorVec4(now ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void draw_axis(const char* name, bool homed, int counts) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    ImGui::TableNextColumn();
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 centre{low.x + line * 0.5F, low.y + line * 0.5F};
    const ImU32 colour = ImGui::GetColorU32(homed ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (homed) {
        list.AddCircleFilled(centre, line * 0.32F, colour, 20);
    } else {
        list.AddCircle(centre, line * 0.32F, colour, 20, line * 0.1F);
    }
    ImGui::Dummy({line, line});
    ImGui::SameLine();
    ImGui::TextUnformatted(homed ? "homed" : "not yet");
    ImGui::TableNextColumn();
    const std::string text = formatted("%d counts", counts);
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, room));
    ImGui::TextDisabled("%s", text.c_str());
}

/// How to home it, as a moving picture with words, and which axes are homed.
void draw_homing_guide(const ViewerState& state) {
    const falcon::Reply& reply = state.touch.falcon->status.reply;
    const Movement movement = movement_at(ImGui::GetTime());
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, kHeight * ImGui::GetTextLineHeight()};
    draw_device(*ImGui::GetWindowDrawList(), low, {low.x + size.x, low.y + size.y}, movement);
    ImGui::Dummy(size);
    draw_step("1  Pull the grip all the way out", movement.pulling);
    draw_step("2  Push it straight in", !movement.pulling);
    if (!ImGui::BeginTable("axes", 3)) return;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
        draw_axis(kAxes[axis], (reply.homed >> axis & 1U) != 0, reply.encoder[axis]);
    }
    ImGui::EndTable();
}

using falcon::Stage;

std::string name_text(const falcon::Status& status) {
    if (!status.serial.empty()) return status.serial;
    return status.stage == Stage::looking ? "none attached" : "attached";
}

/// The logo's colour, as the driver lights it.
struct Light {
    ImVec4 colour;
    const char* text;
};

Light light_of(const ViewerState& state) {
    const ImVec4 red{0.90F, 0.30F, 0.27F, 1.0F};
    const ImVec4 blue{0.36F, 0.56F, 0.95F, 1.0F};
    const ImVec4 green{0.36F, 0.78F, 0.45F, 1.0F};
    if (state.touch.falcon->status.stage == Stage::homing) return {red, "red: to be homed"};
    const bool force = glm::length(state.touch.haptic.touch.sent_force_newton) > 0.0;
    return force ? Light{green, "green: force"} : Light{blue, "blue: ready"};
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

void draw_exchange(const ViewerState& state) {
    const falcon::Status& status = state.touch.falcon->status;
    draw_light(state);
    fact_row("Replies", formatted("%.0f per second", status.replies_per_s));
    if (status.resent + status.line_errors + status.bytes_discarded > 0) {
        fact_row("Link", std::to_string(status.resent) + " sent again, " +
                             std::to_string(status.line_errors) + " line errors, " +
                             std::to_string(status.bytes_discarded) + " bytes lost");
    }
}

void draw_workspace(ViewerState& state) {
    WorkspaceOptions& workspace = state.settings.falcon.workspace;
    if (ImGui::Button("Fit the image")) {
        workspace.scale = fitting_scale(
            {state.media.depth_columns, state.media.depth_rows,
             state.settings.touch.shape.relief_px, state.settings.touch.coupling.pixel_pitch_mm},
            workspace);
    }
    explain("The scale at which the hand reaches the whole image");
    ImGui::SameLine();
    if (ImGui::Button("Centre the hand")) ++state.touch.centred;
    explain("Takes back what the clutch has shifted", state.keys, Action::centre_workspace);
    draw_device_rows(state.settings.falcon, "Workspace");
}

/// Where a person names the firmware file.
void draw_firmware_field(ViewerState& state) {
    const bool entered = text_field(
        "##firmware", "Firmware file (.bin)", state.ui.fields.firmware,
        "Path of the firmware; Enter takes it. It is checked first, and kept for the next time");
    const bool named = state.ui.fields.firmware[0] != '\0';
    const bool pressed = button_or_drop("Load", named, "the file");
    if ((entered || pressed) && named) {
        state.commands.push(UseFirmware{typed_path(state.ui.fields.firmware.data())});
    }
}

void draw_connection(ViewerState& state) {
    const FalconNews& news = *state.touch.falcon;
    fact_row("Firmware", news.firmware.empty() ? "none kept" : news.firmware);
    if (news.status.stage != falcon::Stage::no_firmware) draw_firmware_field(state);
    draw_device_rows(state.settings.falcon, "Connection");
    quiet_text("These are used from the next start of the program.");
}

}  // namespace

void draw_falcon_state(ViewerState& state) {
    const falcon::Status& status = state.touch.falcon->status;
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
    if (!status.unguarded.empty()) trouble_text(capitalised(status.unguarded));
    if (status.stage == Stage::no_firmware) {
        const std::string& trouble = state.touch.falcon->firmware_trouble;
        if (!trouble.empty()) trouble_text(capitalised(trouble));
        draw_firmware_field(state);
    }
    if (status.stage == Stage::loading) draw_progress(status);
    if (status.stage == Stage::homing) draw_homing_guide(state);
    if (status.stage == Stage::homing || status.stage == Stage::ready) draw_exchange(state);
    fact_row("Touches", touching_text(state.touch));
}

void draw_falcon_settings(ViewerState& state) {
    FalconSettings& settings = state.settings.falcon;
    if (part("Workspace")) draw_workspace(state);
    if (part("Buttons")) draw_device_rows(settings, "Buttons");
    if (part("Calibration")) {
        quiet_text(
            "Sources differ on these; the defaults are libnifalcon's. Each change lets the "
            "force rise again from zero.");
        draw_device_rows(settings, "Calibration");
    }
    if (part("Connection")) draw_connection(state);
}

}  // namespace dibhr
