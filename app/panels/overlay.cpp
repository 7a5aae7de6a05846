// What is written over the relief: the force in numbers, the first hint, short notices, the box
// that tells what went wrong, and the help sheet.
#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>

#include "app/panels/falcon_state.hpp"
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/keys.hpp"

namespace dibhr {

namespace {

ImU32 with_alpha(ImGuiCol colour, float alpha) {
    ImVec4 value = ImGui::GetStyleColorVec4(colour);
    value.w *= alpha;
    return ImGui::GetColorU32(value);
}

void draw_ground(ImVec2 low, ImVec2 size, float alpha) {
    ImGui::GetBackgroundDrawList()->AddRectFilled(low, {low.x + size.x, low.y + size.y},
                                                  with_alpha(ImGuiCol_PopupBg, alpha), 5.0F);
}

/// Text on a dark rounded ground, so that it can be read over any picture.
void label(const std::string& text, ImVec2 low, float alpha) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    draw_ground(low, {size.x + 2.0F * pad.x, size.y + 2.0F * pad.y}, 0.8F * alpha);
    ImGui::GetBackgroundDrawList()->AddText({low.x + pad.x, low.y + pad.y},
                                            with_alpha(ImGuiCol_Text, alpha), text.c_str());
}

/// What the Falcon lacks, at the top in the middle of the relief, as wide as there is room.
void draw_banner(const ViewerState& state, const std::string& text) {
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    const ImGuiStyle& style = ImGui::GetStyle();
    const float wrap =
        std::max(std::min(room - 4.0F * style.WindowPadding.x, ImGui::GetFontSize() * 40.0F), 1.0F);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 pad = style.WindowPadding;
    const ImVec2 low{(room - size.x) * 0.5F, 3.2F * ImGui::GetFrameHeight()};
    draw_ground({low.x - pad.x, low.y - pad.y}, {size.x + 2.0F * pad.x, size.y + 2.0F * pad.y},
                0.88F);
    ImGui::GetBackgroundDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), low,
                                            with_alpha(ImGuiCol_Text, 1.0F), text.c_str(), nullptr,
                                            wrap);
}

void centred_label(const ViewerState& state, const std::string& text, float lines_above_bar,
                   float alpha) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetFrameHeight();
    const float bar = bottom_bar_height(state);
    const float width = display.x - panel_column_width(state);
    label(text,
          {(width - ImGui::CalcTextSize(text.c_str()).x) * 0.5F,
           display.y - bar - (1.4F + lines_above_bar) * line},
          alpha);
}

/// Whether something is recorded is seen at a glance, also from afar.
void draw_recording(const RecordingNews& recording, ImVec2 low) {
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    const float line = ImGui::GetTextLineHeight();
    const std::string indent = "      ";
    label(indent + "Recording   " + clock_text(recording.time_s), low, 1.0F);
    ImGui::GetBackgroundDrawList()->AddCircleFilled(
        {low.x + pad.x + line * 0.45F, low.y + pad.y + line * 0.5F}, line * 0.42F,
        IM_COL32(235, 64, 52, 255), 24);
}

std::string replay_text(const ReplayNews& replay) {
    const std::string date = date_text(replay.started);
    const char* comma = replay.participant.empty() || date.empty() ? "" : ", ";
    const std::string about = replay.participant + comma + date;
    return "Replay of " + replay.file.filename().string() + (about.empty() ? "" : " - " + about);
}

/// Where playing is, in time and in frames or ticks.
std::string place_text(const ViewerState& state) {
    if (state.replay) {
        const SessionPlayback& at = state.replay->playback;
        return clock_text(at.now_s - at.begin_s) + " of " + clock_text(at.end_s - at.begin_s) +
               ", tick " + std::to_string(state.replay->tick.tick);
    }
    const PlaybackStatus& at = state.playback;
    return clock_text(at.media_s) + " of " + clock_text(at.duration_s) + ", frame " +
           std::to_string(at.frame + 1);
}

std::string touch_text(const ViewerState& state) {
    const HapticState& haptic = state.haptic;
    if (!state.replay && !state.force_enabled) return "Force off";
    if (waits_for_front(state)) return "Force off: not in front";
    if (!haptic.touchable) return state.replay ? "No surface" : "No surface yet";
    if (clutched(state)) return "Held by the clutch";
    if (haptic.touch.cut != SafetyCut::none)
        return std::string("No force: ") + name_of(haptic.touch.cut);
    if (!haptic.touch.proxy.contact) return "Free";
    const Vec3& f = haptic.touch.sent_force_newton;
    const bool limited = glm::length(haptic.touch.spring_force_newton) > 1.001 * glm::length(f);
    return formatted("Touching   %.2f N%s   (%s, %s, %s)", glm::length(f),
                     limited ? ", limited" : "", decimal(f.x, 2).c_str(), decimal(f.y, 2).c_str(),
                     decimal(f.z, 2).c_str());
}

struct Explained {
    const char* what;
    const char* help;
};

constexpr Explained kMarks[] = {
    {"Orange ring", "The goal: where the hand is"},
    {"Blue ball", "The proxy: stays on the surface"},
    {"Pale ball", "In a replay: the proxy as recorded"},
    {"Line between", "The spring that pulls the hand"},
    {"Blue ring, dashed line", "The proxy is catching up with a jump"},
    {"Yellow arrow", "The force on the hand"},
    {"Yellow ring", "How much of the most force that may be sent"},
    {"Light dots", "Where you have touched in the last seconds"},
    {"Green rod", "The surface's normal"},
    {"Pale cone", "The friction cone: a proxy inside it sticks"},
};

constexpr Explained kMouse[] = {
    {"Move", "The hand hovers over the surface"},
    {"Hold left", "Press in, deeper for the first second"},
    {"Hold left + wheel", "Deeper still, less deep"},
    {"Drag right", "Turn the view"},
    {"Drag middle, Shift + right", "Shift the view"},
    {"Wheel", "Nearer, farther"},
};

void row(const char* left, const char* right) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(left);
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", right);
}

void heading(const ViewerState& state, const std::string& text) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::Spacing();
    ImGui::PushFont(state.fonts.heading);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopFont();
}

void draw_keys(const ViewerState& state) {
    std::string_view group;
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.shown.empty()) continue;
        if (binding.group != group) {
            group = binding.group;
            heading(state, std::string(group));
        }
        row(std::string(binding.shown).c_str(), std::string(binding.help).c_str());
    }
}

}  // namespace

namespace {

/// Always in view, at the upper right of the relief, and never over what is said at its left.
void draw_way_to_keys(const ViewerState& state, float margin) {
    constexpr float kFaint = 0.6F;
    const std::string text = "Keys: ?   Panels: Tab";
    const float width =
        ImGui::CalcTextSize(text.c_str()).x + 2.0F * ImGui::GetStyle().FramePadding.x;
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    const float touching = ImGui::CalcTextSize(touch_text(state).c_str()).x;
    if (touching + width + 4.0F * margin < room)
        label(text, {room - width - margin, margin}, kFaint);
}

}  // namespace

void draw_overlay(const ViewerState& state, double now_s) {
    const float margin = 12.0F * state.scale;
    const float line = 1.3F * ImGui::GetFrameHeight();
    const float second = margin + line;
    label(touch_text(state), {margin, state.replay ? second : margin}, 1.0F);
    if (state.replay) label(replay_text(*state.replay), {margin, margin}, 1.0F);
    draw_way_to_keys(state, margin);
    if (state.recording) draw_recording(*state.recording, {margin, second});
    if (state.catching_up) {
        const bool taken = state.replay || state.recording;
        label("Catching up", {margin, taken ? second + line : second}, 1.0F);
    }
    if (const std::string banner = falcon_banner(state); !banner.empty()) {
        draw_banner(state, capitalised(banner));
    }
    if (now_s < state.notice_until_s) {
        const double left_s = state.notice_until_s - now_s;
        const std::string text = state.notice_of_place ? place_text(state) : state.notice;
        centred_label(state, text, 1.5F, static_cast<float>(std::min(1.0, left_s)));
    }
}

void draw_hint(const ViewerState& state, Hint hint, float alpha) {
    if (alpha <= 0.0F) return;
    constexpr const char* kHints[][2] = {
        {"Move the mouse over the picture. Hold the left button to touch.",
         "Hold the left button to touch."},
        {"Turn the wheel while you press: deeper, or less deep.", "Wheel: press deeper."}};
    const auto& [whole, brief] = kHints[static_cast<int>(hint)];
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    const bool fits = ImGui::CalcTextSize(whole).x + 40.0F * state.scale < room;
    centred_label(state, fits ? whole : brief, 0.0F, alpha);
}

void draw_message_box(ViewerState& state) {
    if (state.message.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.4F}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({ImGui::GetFontSize() * 32.0F, 0.0F});
    bool open = true;
    ImGui::Begin("That did not work", &open,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    ImGui::TextWrapped("%s", state.message.c_str());
    ImGui::Spacing();
    if (ImGui::Button("Close (Esc)")) open = false;
    ImGui::End();
    if (!open) state.message.clear();
}

void draw_help_sheet(ViewerState& state) {
    if (!state.help_open) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.5F}, ImGuiCond_Appearing,
                            {0.5F, 0.5F});
    ImGui::Begin("Keys and mouse", &state.help_open,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings);
    if (ImGui::BeginTable("sheet", 2, ImGuiTableFlags_SizingFixedFit)) {
        heading(state, "Mouse");
        for (const Explained& use : kMouse) row(use.what, use.help);
        heading(state, "Marks");
        for (const Explained& mark : kMarks) row(mark.what, mark.help);
        draw_keys(state);
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace dibhr
