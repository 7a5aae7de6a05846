// A line of time to go along, with what happened on it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

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

/// Contacts as blocks under the line; neighbours in one piece.
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

/// Marks as small flags above the line. The one under the cursor, if any.
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

}  // namespace

std::optional<double> draw_time_line(const TimeLineContents& line, float width) {
    const Track track{ImGui::GetCursorScreenPos(), std::max(width, 1.0F), ImGui::GetFrameHeight(),
                      line.length_s};
    ImGui::InvisibleButton("time line", {track.width, track.height});
    const bool hovered = ImGui::IsItemHovered();
    const bool held = ImGui::IsItemActive();
    const float cursor_x = ImGui::GetIO().MousePos.x;
    const float under = std::clamp((cursor_x - track.low.x) / track.width, 0.0F, 1.0F);
    const double under_s = static_cast<double>(under) * line.length_s;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (line.contacts != nullptr) draw_contacts(list, *line.contacts, track);
    const SessionMark* mark = draw_marks(list, line.marks, track, cursor_x);
    draw_line(list, track, track.x_of(held ? under_s : line.now_s), hovered || held);
    if (hovered || held) {
        const std::string tag = mark != nullptr ? "   " + mark->tag : "";
        ImGui::SetTooltip("%s%s", clock_text(under_s).c_str(), tag.c_str());
    }
    const bool moved = ImGui::IsItemActivated() || ImGui::GetIO().MouseDelta.x != 0.0F;
    if (held && moved) return under_s;
    return {};
}

}  // namespace dibhr
