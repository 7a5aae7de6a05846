// The ruler: two points on the relief and their distance.
#include <cmath>
#include <glm/geometric.hpp>

#include "app/panels/panels.hpp"
#include "app/panels/relief_screen.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr ImU32 kRulerLine = IM_COL32(255, 236, 120, 255);
constexpr ImU32 kRulerEdge = IM_COL32(0, 0, 0, 190);

Vec3 end_place(const PixelShown& pixel) {
    return {pixel.column, pixel.row, pixel.elevation_px};
}

/// The difference of depth in the file's own unit; empty if the depth's meaning is not known.
std::string depth_between(const ViewerState& state, const PixelShown& a, const PixelShown& b) {
    if (a.unseen || b.unseen) return "no data";
    if (!state.media.meaning) return {};
    const DepthMeaning& meaning = *state.media.meaning;
    const double apart = std::abs(value_at(meaning, a.nearness) - value_at(meaning, b.nearness));
    if (meaning.unit.value == DepthUnit::levels)
        return formatted("%.1f levels of depth", apart / meaning.scale.value);
    return short_text(apart, 4) + " " + std::string(name_of(meaning.unit.value)) + " of depth";
}

}  // namespace

std::string ruler_text(const ViewerState& state) {
    const std::vector<PixelShown>& ends = state.ui.ruler->ends;
    if (ends.empty()) return "Ruler   click two points (N ends it)";
    if (ends.size() == 1) return "Ruler   click the other point";
    const double apart_px = glm::distance(end_place(ends[0]), end_place(ends[1]));
    const double pitch_mm = state.settings.touch.coupling.pixel_pitch_mm;
    const std::string depth = depth_between(state, ends[0], ends[1]);
    return formatted("Ruler   %.1f px, %.2f mm under the hand", apart_px, apart_px * pitch_mm) +
           (depth.empty() ? "" : "   " + depth);
}

void draw_ruler(const ViewerState& state, const glm::dmat4& clip_from_grid) {
    if (!state.ui.ruler || state.ui.explained) return;
    const ReliefScreen screen(state, clip_from_grid);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    std::vector<ImVec2> seen;
    for (const PixelShown& end : state.ui.ruler->ends) {
        const auto at = screen.at(end_place(end));
        if (!at) return;
        seen.push_back(*at);
    }
    list.PushClipRect(screen.low(), screen.high());
    const float thick = 1.5F * state.ui.scale;
    if (seen.size() == 2) {
        list.AddLine(seen[0], seen[1], kRulerEdge, thick + 2.0F * state.ui.scale);
        list.AddLine(seen[0], seen[1], kRulerLine, thick);
    }
    for (const ImVec2 at : seen) {
        list.AddCircleFilled(at, 5.0F * state.ui.scale, kRulerEdge, 20);
        list.AddCircleFilled(at, 4.0F * state.ui.scale, kRulerLine, 20);
    }
    list.PopClipRect();
}

}  // namespace dibhr
