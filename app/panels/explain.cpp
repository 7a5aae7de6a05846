// One update of DIBHR on the relief: the visited primitives, the goal's foot, the friction cone and
// the proxy's path, with a line of text for each step.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/relief_screen.hpp"
#include "app/panels/widgets.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"

namespace dibhr {

namespace {

constexpr ImU32 kMesh = IM_COL32(255, 255, 255, 60);
constexpr ImU32 kVisited = IM_COL32(80, 200, 190, 60);
constexpr ImU32 kVisitedLine = IM_COL32(80, 220, 210, 170);
constexpr ImU32 kNow = IM_COL32(250, 230, 64, 90);
constexpr ImU32 kNowLine = IM_COL32(250, 230, 64, 255);
constexpr ImU32 kGoal = IM_COL32(242, 140, 13, 255);
constexpr ImU32 kProxy = IM_COL32(64, 148, 245, 255);
constexpr ImU32 kFoot = IM_COL32(255, 255, 255, 235);
constexpr ImU32 kCone = IM_COL32(255, 205, 120, 200);
constexpr ImU32 kLabel = IM_COL32(255, 255, 255, 235);
constexpr ImU32 kOutline = IM_COL32(0, 0, 0, 190);

constexpr int kNetAround = 4;   // cells on each side of the path
constexpr int kWidestNet = 90;  // the lines of a wider mesh would cover the relief: not drawn

/// Draws in grid space on top of the relief.
class ReliefOverlay {
  public:
    ReliefOverlay(const ViewerState& state, const glm::dmat4& clip_from_grid)
        : screen_(state, clip_from_grid), scale_(state.ui.scale) {}

    void line(Vec3 from, Vec3 to, ImU32 colour, float thick = 1.0F) const {
        const auto a = screen_.at(from);
        const auto b = screen_.at(to);
        if (a && b) list().AddLine(*a, *b, colour, thick * scale_);
    }

    void dashes(Vec3 from, Vec3 to, ImU32 colour) const {
        constexpr int kDashes = 14;
        for (int k = 0; k < kDashes; ++k) {
            const Vec3 step = (to - from) / static_cast<double>(kDashes);
            line(from + step * static_cast<double>(k), from + step * (k + 0.55), colour, 1.5F);
        }
    }

    void triangle(const std::array<Vec3, 3>& corners, ImU32 fill, ImU32 border) const {
        const auto a = screen_.at(corners[0]);
        const auto b = screen_.at(corners[1]);
        const auto c = screen_.at(corners[2]);
        if (!a || !b || !c) return;
        list().AddTriangleFilled(*a, *b, *c, fill);
        list().AddTriangle(*a, *b, *c, border, 1.5F * scale_);
    }

    void dot(Vec3 at, float radius, ImU32 colour) const {
        if (const auto p = screen_.at(at)) {
            list().AddCircleFilled(*p, (radius + 1.5F) * scale_, kOutline, 24);
            list().AddCircleFilled(*p, radius * scale_, colour, 24);
        }
    }

    void ring(Vec3 at, float radius, ImU32 colour) const {
        if (const auto p = screen_.at(at)) {
            list().AddCircle(*p, radius * scale_, kOutline, 28, 5.0F * scale_);
            list().AddCircle(*p, radius * scale_, colour, 28, 3.0F * scale_);
        }
    }

    /// Whether labels at both places would not overlap.
    [[nodiscard]] bool are_apart(Vec3 one, Vec3 other) const {
        const auto a = screen_.at(one);
        const auto b = screen_.at(other);
        const ImVec2 label = ImGui::CalcTextSize("proxy");
        return !a || !b || std::abs(a->y - b->y) > label.y ||
               std::abs(a->x - b->x) > 1.5F * label.x;
    }

    /// A label beside a place, readable on any picture.
    void label(Vec3 at, const char* text) const {
        const auto p = screen_.at(at);
        if (!p) return;
        const ImVec2 size = ImGui::CalcTextSize(text);
        const float gap = 12.0F * scale_;
        const ImVec2 low{p->x + gap, p->y - 0.5F * size.y};
        const float pad = 3.0F * scale_;
        list().AddRectFilled({low.x - pad, low.y}, {low.x + size.x + pad, low.y + size.y},
                             IM_COL32(0, 0, 0, 170), pad);
        list().AddText(low, kLabel, text);
    }

  private:
    [[nodiscard]] static ImDrawList& list() { return *ImGui::GetBackgroundDrawList(); }

    ReliefScreen screen_;
    float scale_;
};

std::array<Vec3, 3> corners_of(const DepthSurface& surface, const Primitive& triangle) {
    const int far = triangle.side == TriangleSide::far_corner ? 1 : 0;
    const int i = triangle.i;
    const int j = triangle.j;
    return {surface.vertex_at(i + far, j + far), surface.vertex_at(i + 1, j),
            surface.vertex_at(i, j + 1)};
}

void draw_net(const ReliefOverlay& overlay, const DepthSurface& surface,
              const ExplainedUpdate& update) {
    const auto [low, high] = box_of(update);
    const int first_i = std::max(static_cast<int>(low.x) - kNetAround, 0);
    const int first_j = std::max(static_cast<int>(low.y) - kNetAround, 0);
    const int last_i = std::min(static_cast<int>(high.x) + 1 + kNetAround, surface.columns() - 1);
    const int last_j = std::min(static_cast<int>(high.y) + 1 + kNetAround, surface.rows() - 1);
    if (last_i - first_i > kWidestNet || last_j - first_j > kWidestNet) return;
    for (int j = first_j; j <= last_j; ++j) {
        for (int i = first_i; i <= last_i; ++i) {
            const Vec3 here = surface.vertex_at(i, j);
            if (i < last_i) overlay.line(here, surface.vertex_at(i + 1, j), kMesh);
            if (j < last_j) overlay.line(here, surface.vertex_at(i, j + 1), kMesh);
            if (i < last_i && j < last_j)
                overlay.line(surface.vertex_at(i + 1, j), surface.vertex_at(i, j + 1), kMesh);
        }
    }
}

void draw_primitive(const ReliefOverlay& overlay, const DepthSurface& surface,
                    const Primitive& primitive, bool now) {
    const ImU32 border = now ? kNowLine : kVisitedLine;
    switch (primitive.kind) {
        case PrimitiveKind::triangle:
            return overlay.triangle(corners_of(surface, primitive), now ? kNow : kVisited, border);
        case PrimitiveKind::edge: {
            const EdgeEnds ends = ends_of(primitive);
            return overlay.line(surface.vertex_at(ends.begin_i, ends.begin_j),
                                surface.vertex_at(ends.end_i, ends.end_j), border,
                                now ? 5.0F : 3.0F);
        }
        case PrimitiveKind::vertex:
            return overlay.dot(surface.vertex_at(primitive.i, primitive.j), now ? 7.0F : 4.0F,
                               border);
        case PrimitiveKind::none:
            break;
    }
}

/// The cone's rim, a circle around the foot across the axis from the goal, and lines from the goal.
void draw_cone(const ReliefOverlay& overlay, Vec3 goal, const WalkStep& step) {
    constexpr int kSides = 48;
    constexpr int kRays = 6;
    constexpr double kNone_px = 1e-6;
    const Vec3 axis = step.foot - goal;
    if (step.cone_px <= kNone_px || glm::length(axis) <= kNone_px) return;
    const Vec3 up = glm::normalize(axis);
    const Vec3 any = std::abs(up.x) < 0.7 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
    const Vec3 one = glm::normalize(glm::cross(up, any));
    const Vec3 other = glm::cross(up, one);
    const auto rim = [&](int k) {
        const double turn = 2.0 * std::numbers::pi * k / kSides;
        return step.foot + step.cone_px * (std::cos(turn) * one + std::sin(turn) * other);
    };
    for (int k = 0; k < kSides; ++k) {
        overlay.line(rim(k), rim(k + 1), kCone, 2.0F);
        if (k % (kSides / kRays) == 0) overlay.line(goal, rim(k), kCone);
    }
}

void draw_path(const ReliefOverlay& overlay, const ExplainedInfo& info) {
    for (std::size_t k = 0; k < info.taken; ++k) {
        const WalkStep& step = info.update.steps[k];
        overlay.line(step.before.position, step.after.position, kOutline, 5.0F);
        overlay.line(step.before.position, step.after.position, kProxy, 3.0F);
    }
}

/// Whether the hand is in the air: no primitive of the surface takes part.
bool is_free(const ExplainedUpdate& update) {
    return update.result.moves == 0 && !update.start.contact && !update.result.contact;
}

void draw_on_relief(const ReliefOverlay& overlay, const DepthSurface& surface,
                    const ExplainedInfo& info) {
    const ExplainedUpdate& update = info.update;
    if (!is_free(update)) draw_net(overlay, surface, update);
    for (std::size_t k = 0; k < info.taken; ++k) {
        const WalkStep& step = update.steps[k];
        for (std::size_t n = 0; n < step.visits; ++n) {
            draw_primitive(overlay, surface, step.visited.at(n), k + 1 == info.taken);
        }
    }
    const WalkStep* last = info.taken > 0 ? &update.steps[info.taken - 1] : nullptr;
    const bool has_foot = last != nullptr && (last->piece.kind == PrimitiveKind::triangle ||
                                              last->piece.kind == PrimitiveKind::edge);
    if (has_foot) {
        overlay.dashes(last->before.position, last->foot, kFoot);
        overlay.dashes(update.goal, last->foot, kGoal);
        draw_cone(overlay, update.goal, *last);
        overlay.dot(last->foot, 3.0F, kFoot);
        overlay.label(last->foot, "foot");
    } else {
        overlay.dashes(last != nullptr ? last->before.position : update.start.position, update.goal,
                       kGoal);
    }
    draw_path(overlay, info);
    const Vec3 proxy = last != nullptr ? last->after.position : update.start.position;
    const bool apart = overlay.are_apart(proxy, update.goal);  // else one label hides the other
    overlay.ring(update.goal, 9.0F, kGoal);
    if (apart) overlay.label(update.goal, "goal");
    overlay.dot(proxy, 6.0F, kProxy);
    overlay.label(proxy, apart ? "proxy" : "proxy, goal");
}

/// The card's text: on the current step, or how to begin.
std::string card_text(const ViewerState& state) {
    const ExplainedInfo& info = *state.ui.explained;
    if (is_free(info.update))
        return std::string("The goal is above the surface: no contact, no force. ") +
               (state.touch.replay ? "Step on to the next update, or seek to a contact first."
                                   : "Hold the left button on the relief to explain a touch.");
    if (info.taken > 0) return text_of(info.update.steps[info.taken - 1]);
    const KeyTable& keys = state.keys;
    const std::string on = keys.name_for(Action::step_forward);
    const std::string back = keys.name_for(Action::step_back);
    const std::string steps = on.empty() || back.empty() ? "" : " ( " + on + " and " + back + " )";
    const std::string after = "Step with the arrows" + steps + " or let it run slowly" +
                              keys.in_brackets(Action::play_or_pause) + ".";
    if (info.held) return "The update begins here. " + after;
    return "What one update does, from where the proxy was to where you press: hold the left "
           "button to move the goal. " +
           after;
}

/// The longest title that fits into `room`.
std::string title_of(const ExplainedInfo& info, float room) {
    const std::size_t steps = info.update.steps.size();
    const std::string what = "Explain one update of DIBHR";
    if (is_free(info.update)) return what + ": it visits nothing";
    if (steps == 0) return what + ": the proxy rests where it is";
    std::string step = formatted("step %zu of %zu", info.taken, steps);
    const int moves = info.taken > 0 ? info.update.steps[info.taken - 1].after.moves : 0;
    const std::string more = formatted("%s     %d of %d primitives visited", step.c_str(), moves,
                                       info.update.result.moves);
    for (const std::string& title : {formatted("%s     %s", what.c_str(), more.c_str()), more}) {
        if (ImGui::CalcTextSize(title.c_str()).x < room) return title;
    }
    return step;
}

void draw_card(ViewerState& state) {
    const ExplainedInfo& info = *state.ui.explained;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float room = display.x - panel_column_width(state);
    const float margin = 12.0F * state.ui.scale;
    const float width = std::min(room - 2.0F * margin, 46.0F * ImGui::GetFontSize());
    ImGui::SetNextWindowPos({0.5F * room, display.y - bottom_bar_height(state) - margin},
                            ImGuiCond_Always, {0.5F, 1.0F});
    ImGui::SetNextWindowSize({width, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.9F);
    ImGui::Begin("Explain", nullptr, kBareWindow | ImGuiWindowFlags_NoFocusOnAppearing);
    const auto button = [&state](const char* id, Icon icon, std::string help, Action action) {
        help += state.keys.in_brackets(action);
        if (icon_button(id, icon, help.c_str())) state.commands.push(action);
    };
    button("back", Icon::step_back, "One step back", Action::step_back);
    ImGui::SameLine(0.0F, 0.0F);
    button("run", info.runs ? Icon::pause : Icon::play, "Slow motion", Action::play_or_pause);
    ImGui::SameLine(0.0F, 0.0F);
    button("on", Icon::step_forward, "One step on", Action::step_forward);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const std::string end = "End" + state.keys.in_brackets(Action::explain);
    const float end_x =
        width - ImGui::CalcTextSize(end.c_str()).x - 3.0F * ImGui::GetStyle().WindowPadding.x;
    ImGui::TextUnformatted(title_of(info, end_x - ImGui::GetCursorPosX()).c_str());
    ImGui::SameLine(end_x);
    if (item::small_button(end.c_str())) state.commands.push(Action::explain);
    ImGui::TextWrapped("%s", card_text(state).c_str());
    // At least two lines high, so that the text does not jump.
    const float lines = ImGui::GetCursorPosY();
    const float least = ImGui::GetFrameHeight() + 2.6F * ImGui::GetTextLineHeightWithSpacing();
    if (lines < least + ImGui::GetStyle().WindowPadding.y)
        ImGui::Dummy({0.0F, least + ImGui::GetStyle().WindowPadding.y - lines});
    ImGui::End();
}

}  // namespace

void draw_explanation(ViewerState& state, const DepthSurface& surface,
                      const glm::dmat4& clip_from_grid) {
    if (!state.ui.explained || state.ui.explained->waits) return;
    draw_on_relief(ReliefOverlay(state, clip_from_grid), surface, *state.ui.explained);
    draw_card(state);
}

}  // namespace dibhr
