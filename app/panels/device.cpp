// The Device panel: the devices, the state of the touch, and the switch of the force.
#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/touching/device_state.hpp"
#include "app/touching/force_law.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

namespace {

std::string point_text(const Vec3& p) {
    return formatted("%7s %7s %7s px", decimal(p.x, 1).c_str(), decimal(p.y, 1).c_str(),
                     decimal(p.z, 1).c_str());
}

std::string state_text(const ViewerState& state) {
    const HapticState& haptic = state.touch.haptic;
    if (!haptic.touchable) return "waiting for a surface";
    if (!haptic.hand.ready && a_device_touches(state.touch))
        return force_device_kinds()[touching_device(state.touch)->kind]->no_pose_advice;
    if (const std::string reason = why_held(state); !reason.empty()) return "no force: " + reason;
    return haptic.touch.proxy.contact ? "in contact" : "free";
}

/// Text, colour and help of the force switch.
struct ForceSwitch {
    const char* text;
    std::optional<ImVec4> ground;  ///< nothing: as other buttons
    std::string help;
};

ForceSwitch force_switch(const ViewerState& state) {
    const std::string key = state.keys.in_brackets(Action::toggle_force);
    if (!state.touch.force_enabled) {
        return {"Force: off###force", ImVec4{0.46F, 0.22F, 0.16F, 1.0F},
                "Switch the force on again; it rises slowly" + key};
    }
    if (const std::string reason = why_held(state); !reason.empty()) {
        return {"Force: held###force", ImVec4{0.44F, 0.35F, 0.12F, 1.0F},
                "On, but no force is sent: " + reason + "\nClick to switch it off" + key};
    }
    // A mouse has no motors, of which people should be warned.
    if (!may_touch(state.touch)) {
        return {"Force: on###force", {}, "Switch the force that the arrow shows off" + key};
    }
    return {"Force: on###force", ImVec4{0.14F, 0.38F, 0.33F, 1.0F}, "Switch the force off" + key};
}

}  // namespace

std::string why_held(const ViewerState& state) {
    const TouchState& touch = state.touch;
    if (touch.replay) return {};
    const auto& question = state.ui.depth_question;
    if (question && question->answered) return "reading the files again";
    if (touch.depth_in_question) return "which depth is right?";
    if (waits_for_front(state.settings, touch)) return "this window is not in front";
    if (clutched(state.settings, touch)) return "the clutch is held";
    const auto& live = state.media.playback.live;
    if (live && live->force_off) return "no signal";
    const SafetyCut cut = touch.haptic.touch.cut;
    const bool lasts = cut == SafetyCut::device_not_ready || cut == SafetyCut::standstill;
    return lasts ? name_of(cut) : "";
}

float force_switch_width() {
    return button_width("Force: held");  // the widest of its texts
}

void draw_force_switch(ViewerState& state, float width) {
    const ForceSwitch shown = force_switch(state);
    if (shown.ground) {
        const ImVec4& ground = *shown.ground;
        const ImVec4 raised{ground.x * 1.2F, ground.y * 1.2F, ground.z * 1.2F, 1.0F};
        ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0F, 1.0F, 1.0F, 1.0F));  // in every theme
        ImGui::PushStyleColor(ImGuiCol_Button, ground);
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, raised);
        ImGui::PushStyleColor(ImGuiCol_ButtonActive, raised);
    }
    bool& on = state.touch.force_enabled;
    if (item::button(shown.text, {width, 0.0F})) on = !on;
    if (shown.ground) ImGui::PopStyleColor(4);
    add_tooltip(shown.help.c_str());
}

void draw_device_panel(ViewerState& state) {
    if (!section(state, "Device", state.settings.panels.device, &state.touch.needs_person)) return;
    ImGui::PushID("device");
    std::vector<DeviceInfo> devices = state.touch.devices;
    std::erase_if(devices, [](const DeviceInfo& info) { return !attached_or_expected(info); });
    for (const DeviceInfo& info : devices) draw_force_device(state, info);
    if (devices.empty()) {
        const bool looks = !state.touch.devices.empty();
        fact_row("Device", looks ? "mouse" : state.touch.device.name);
        if (looks) draw_dimmed("A force device takes over as soon as it is plugged in.");
    }
    fact_row("State", state_text(state));
    draw_force_switch(state, -1.0F);
    if (!devices.empty()) {
        flag_row("Force only while the window is in front", state.settings.force_in_front_only,
                 Settings{}.force_in_front_only,
                 "No force while another window has the keyboard, or this window is an icon: the "
                 "hand is safe while nobody looks. Switch this off if one person touches while "
                 "another works in another window, for example in an experiment");
    }
    const SafetyLimits standard;
    double& max_newton = state.settings.max_force_newton;
    const double most_newton = state.touch.device.limits.max_force_newton;
    number_row({"Max force", "%.1f N", 0.0, most_newton, standard.max_force_newton,
                "No more than this is ever sent"},
               max_newton);
    max_newton = std::clamp(max_newton, 0.0, most_newton);
    const Touch& touch = state.touch.haptic.touch;
    fact_row("Goal", point_text(touch.goal), "Where the hand is: column, row and elevation");
    fact_row("Proxy", point_text(touch.proxy.position),
             "The point that stays on the surface; the spring pulls the hand to it");
    fact_row("Force", formatted("%.2f N", glm::length(touch.sent_force_newton)),
             "What is sent to the hand");
    if (touch.cut != SafetyCut::none) fact_row("Cut", name_of(touch.cut), "Why no force is sent");
    for (const DeviceInfo& info : devices) draw_force_device_settings(state, info);
    ImGui::PopID();
}

}  // namespace dibhr
