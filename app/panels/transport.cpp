// The bar under the relief: the time line, playback and the force switch.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// The contents of a time line.
struct TimeLineContents {
    double now_s{0.0};  ///< from the line's beginning, like all its times
    double length_s{0.0};
    std::optional<MediaPart> part{};       ///< the only part that is played
    const ContactBand* contacts{nullptr};  ///< null: none
    std::vector<SessionMark> marks{};
};

struct Track {
    ImVec2 low{};  // upper left of the whole item
    float width{0.0F}, height{0.0F};
    double length_s{0.0};

    [[nodiscard]] float x_of(double t_s) const {
        const double share = length_s > 0.0 ? t_s / length_s : 0.0;
        return low.x + width * static_cast<float>(std::clamp(share, 0.0, 1.0));
    }
    [[nodiscard]] float middle() const { return low.y + height * 0.5F; }
};

/// Contacts as blocks under the line; adjacent blocks are merged.
void draw_contacts(ImDrawList& list, const ContactBand& band, const Track& track) {
    const ImU32 colour = IM_COL32(242, 140, 13, 190);  // the hand's orange
    const float top = track.low.y + track.height * 0.68F;
    const float bottom = track.low.y + track.height * 0.88F;
    const float piece = track.width / static_cast<float>(ContactBand::kPieces);
    for (std::size_t begin = 0; begin < ContactBand::kPieces; ++begin) {
        if (!band.contact.at(begin)) continue;
        std::size_t end = begin + 1;
        while (end < ContactBand::kPieces && band.contact.at(end)) ++end;
        const float left = track.low.x + piece * static_cast<float>(begin);
        const float right = track.low.x + piece * static_cast<float>(end);
        list.AddRectFilled({left, top}, {std::max(right, left + 1.0F), bottom}, colour);
        begin = end;
    }
}

/// Marks as small flags above the line. Returns the mark under the cursor, or null.
const SessionMark* draw_marks(ImDrawList& list, const std::vector<SessionMark>& marks,
                              const Track& track, float cursor_x) {
    const SessionMark* under = nullptr;
    const float side = track.height * 0.16F;
    for (const SessionMark& mark : marks) {
        const float x = track.x_of(mark.t_s);
        const float top = track.low.y + track.height * 0.08F;
        list.AddTriangleFilled({x - side, top}, {x + side, top}, {x, top + 1.6F * side},
                               IM_COL32(250, 230, 64, 235));
        if (std::abs(cursor_x - x) <= 1.5F * side) under = &mark;
    }
    return under;
}

void draw_line(ImDrawList& list, const Track& track, float x, bool lively) {
    const float y = track.middle();
    const float thick = track.height * 0.09F;
    list.AddRectFilled({track.low.x, y - thick}, {track.low.x + track.width, y + thick},
                       ImGui::GetColorU32(ImGuiCol_FrameBgActive), thick);
    list.AddRectFilled({track.low.x, y - thick}, {x, y + thick},
                       ImGui::GetColorU32(ImGuiCol_SliderGrabActive), thick);
    list.AddCircleFilled(
        {x, y}, track.height * (lively ? 0.28F : 0.22F),
        ImGui::GetColorU32(lively ? ImGuiCol_CheckMark : ImGuiCol_SliderGrabActive), 24);
}

/// The played part, between two posts.
void draw_part(ImDrawList& list, const MediaPart& part, const Track& track) {
    const ImU32 colour = ImGui::GetColorU32(ImGuiCol_CheckMark);
    const float thick = std::max(1.5F, track.height * 0.07F);
    const float reach = track.height * 0.30F;
    const float y = track.middle();
    const float left = track.x_of(part.from_s);
    const float right = track.x_of(part.to_s);
    for (const float x : {left, right})
        list.AddRectFilled({x - thick, y - reach}, {x + thick, y + reach}, colour, 0.5F * thick);
    list.AddRectFilled({left, y + reach - thick}, {right, y + reach}, colour);
}

/// Returns the time that a person clicked or dragged to [s]. `width` in pixels.
std::optional<double> draw_time_line(const TimeLineContents& line, float width) {
    const Track track{ImGui::GetCursorScreenPos(), std::max(width, 1.0F), ImGui::GetFrameHeight(),
                      line.length_s};
    ImGui::InvisibleButton("time line", {track.width, track.height});
    const bool by_keys = item::reach(ItemKeys::turn, [&] {
        return ItemWords{"Time line", "slider", clock_text(std::round(line.now_s))};
    });
    const bool hovered = ImGui::IsItemHovered();
    const bool held = ImGui::IsItemActive();
    const float cursor_x = ImGui::GetIO().MousePos.x;
    const float under = std::clamp((cursor_x - track.low.x) / track.width, 0.0F, 1.0F);
    const double under_s = static_cast<double>(under) * line.length_s;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (line.contacts != nullptr) draw_contacts(list, *line.contacts, track);
    const SessionMark* mark = draw_marks(list, line.marks, track, cursor_x);
    if (line.part) draw_part(list, *line.part, track);
    draw_line(list, track, track.x_of(held ? under_s : line.now_s), hovered || held);
    if (hovered || held) {
        const std::string tag = mark != nullptr ? "   " + mark->tag : "";
        draw_tooltip(clock_text(under_s) + tag);
    }
    const bool moved = ImGui::IsItemActivated() || ImGui::GetIO().MouseDelta.x != 0.0F;
    if (held && moved) return under_s;
    const int steps = by_keys ? item::steps().across : 0;
    if (steps == 0) return {};
    return std::clamp(line.now_s + steps, 0.0, line.length_s);
}

/// The text beside the time line: whole if it leaves room for a usable line, else shorter, or
/// nothing.
struct TimeText {
    std::string time{};  ///< "00:04.1 / 00:10.0"
    std::string more{};  ///< "frame 124"; empty if there is no room
    float width{0.0F};   ///< of both, with the gaps
};

/// `more_width`: of the longest `more`; `right_of_line`: space for other items [px].
TimeText fit_time_text(const TimeLineContents& line, const std::string& more, float more_width,
                       float right_of_line) {
    const float least = 7.0F * ImGui::GetFontSize();
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float room = ImGui::GetContentRegionAvail().x - right_of_line - least;
    const std::string now = clock_text(line.now_s);
    const std::string both = now + " / " + clock_text(line.length_s);
    const auto width = [gap](const std::string& text) {
        return text.empty() ? 0.0F : ImGui::CalcTextSize(text.c_str()).x + gap;
    };
    if (width(both) + more_width + gap <= room) return {both, more, width(both) + more_width + gap};
    if (width(both) <= room) return {both, {}, width(both)};
    if (width(now) <= room) return {now, {}, width(now)};
    return {};
}

/// The time line, as long as possible with `right_of_line` pixels free beside the time. Returns the
/// time to seek [s].
std::optional<double> draw_line_and_time(const TimeLineContents& line, const std::string& more,
                                         float more_width, float right_of_line) {
    const TimeText beside = fit_time_text(line, more, more_width, right_of_line);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = ImGui::GetContentRegionAvail().x - beside.width - right_of_line - gap;
    std::optional<double> wanted_s;
    if (width > 2.0F * ImGui::GetFontSize()) {
        wanted_s = draw_time_line(line, width);
        ImGui::SameLine();
    }
    if (beside.time.empty()) return wanted_s;
    const float begin = ImGui::GetCursorPosX();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(beside.time.c_str());
    if (!beside.more.empty()) {
        ImGui::SameLine();
        ImGui::TextDisabled("%s", beside.more.c_str());
    }
    ImGui::SameLine(begin + beside.width);
    return wanted_s;
}

/// As wide as the relief. End it with ImGui::End().
void begin_bottom_bar(const ViewerState& state, const char* name) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float height = bottom_bar_height(state);
    ImGui::SetNextWindowPos({0.0F, display.y - height});
    ImGui::SetNextWindowSize({display.x - panel_column_width(state), height});
    ImGui::SetNextWindowBgAlpha(0.85F);
    ImGui::Begin(name, nullptr, kBareWindow | ImGuiWindowFlags_NoBringToFrontOnFocus);
}

/// The state of a live source, in place of the time line.
void draw_live(const LiveStatus& live, bool playing, float right_of_text) {
    const ImU32 red = IM_COL32(226, 60, 52, 255);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    const float radius = 0.17F * height;
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - right_of_text;
    ImGui::GetWindowDrawList()->AddCircleFilled(
        {at.x + 2.0F * radius, at.y + 0.5F * height}, radius,
        playing && live.signal ? red : ImGui::GetColorU32(ImGuiCol_TextDisabled), 16);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 5.0F * radius);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(playing ? "LIVE" : "HELD");
    ImGui::SameLine();
    const std::string text = playing ? in_words(live) : "play goes on with the newest frame";
    const float room = right - ImGui::GetCursorPosX();
    if (ImGui::CalcTextSize(text.c_str()).x < room) ImGui::TextDisabled("%s", text.c_str());
    ImGui::SameLine(right + ImGui::GetStyle().ItemSpacing.x);
}

/// The time line of a course, from its begin.
TimeLineContents line_of(const PlayState& play_state) {
    TimeLineContents line{.now_s = play_state.now_s - play_state.begin_s,
                          .length_s = play_state.end_s - play_state.begin_s,
                          .part = play_state.part};
    if (line.part) {
        line.part->from_s -= play_state.begin_s;
        line.part->to_s -= play_state.begin_s;
    }
    return line;
}

void draw_playback(const ViewerState& state, Transport& player, float right_of_line) {
    const PlaybackStatus& playback = state.media.playback;
    play_button(playback.playing, player, state.keys);
    ImGui::SameLine();
    if (playback.live) return draw_live(*playback.live, playback.playing, right_of_line);
    const auto wanted_s = draw_line_and_time(line_of(playback.play_state()),
                                             "frame " + std::to_string(playback.frame + 1),
                                             ImGui::CalcTextSize("frame 00000").x, right_of_line);
    if (wanted_s) player.seek(*wanted_s);
}

void draw_transport_bar(ViewerState& state, Transport& player) {
    const ImGuiStyle& style = ImGui::GetStyle();
    begin_bottom_bar(state, "Transport");
    const float force_width = force_switch_width();
    if (state.media.still) {
        const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("A still picture");
        ImGui::SameLine(right - force_width);
    } else {
        draw_playback(state, player, force_width + style.ItemSpacing.x);
    }
    draw_force_switch(state, force_width);
    draw_depth_line(state);
    ImGui::End();
}

void draw_replay_bar(ViewerState& state, Transport& replay) {
    begin_bottom_bar(state, "Replay");
    const SessionPlayback& playback = state.touch.replay->playback;
    play_and_step_buttons(playback.playing, replay, state.keys, "tick", 0.0F);
    const std::string again =
        "Start again at the end" + state.keys.in_brackets(Action::toggle_loop);
    if (icon_button("loop", Icon::loop, again.c_str(), playback.looping)) {
        replay.set_looping(!playback.looping);
    }
    ImGui::SameLine();
    TimeLineContents line = line_of(playback);
    line.contacts = state.touch.replay->contacts;
    line.marks = state.touch.replay->marks;
    for (SessionMark& mark : line.marks) mark.t_s -= playback.begin_s;
    const std::string video = "video " + clock_text(state.touch.replay->tick.video_s);
    const auto wanted_s =
        draw_line_and_time(line, video, ImGui::CalcTextSize(video.c_str()).x, 0.0F);
    if (wanted_s) replay.seek(playback.begin_s + *wanted_s);
    ImGui::End();
}

/// While the panels are hidden, the bar appears only near the pointer, but not while the pointer
/// presses on the relief.
bool bar_is_visible(const ViewerState& state) {
    constexpr float kNear = 2.5F;  // of its height
    if (state.settings.panels_visible) return true;
    const ImGuiIO& io = ImGui::GetIO();
    const bool touches = io.MouseDown[ImGuiMouseButton_Left] && !io.WantCaptureMouse;
    const float from_below = io.DisplaySize.y - io.MousePos.y;
    return !touches && from_below >= 0.0F && from_below < kNear * bottom_bar_height(state);
}

/// The force switch without the bar, always in reach.
void draw_force_switch_only(ViewerState& state) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(display, ImGuiCond_Always, {1.0F, 1.0F});
    ImGui::SetNextWindowBgAlpha(0.0F);
    ImGui::Begin(
        "Force", nullptr,
        kBareWindow | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoBringToFrontOnFocus);
    draw_force_switch(state, force_switch_width());
    ImGui::End();
}

}  // namespace

float bottom_bar_height(const ViewerState& state) {
    if (state.ui.kiosk) return kiosk_height(state);
    const ImGuiStyle& style = ImGui::GetStyle();
    const bool has_line = !state.touch.replay && state.media.meaning;
    const float line = has_line ? ImGui::GetTextLineHeight() + style.ItemSpacing.y : 0.0F;
    return ImGui::GetFrameHeight() + line + 2.0F * style.WindowPadding.y;
}

void draw_bottom_bar(ViewerState& state, Transport& transport) {
    if (state.ui.kiosk) return draw_kiosk(state);
    const bool wanted = bar_is_visible(state);
    if (state.touch.replay) {
        if (wanted) draw_replay_bar(state, transport);
    } else if (wanted) {
        draw_transport_bar(state, transport);
    } else {
        draw_force_switch_only(state);
    }
}

}  // namespace dibhr
