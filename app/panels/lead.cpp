// What the first start shows, in pictures: a pointer and a mouse that do what a person may do.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/relief_screen.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

constexpr ImU32 kInk = IM_COL32(255, 255, 255, 245);
constexpr ImU32 kEdge = IM_COL32(12, 18, 20, 215);
constexpr ImU32 kGlow = IM_COL32(255, 255, 255, 120);
constexpr double kShownAgain_s = 2.0;  // the movement is shown again and again

ImU32 accent() {
    ImVec4 colour = ImGui::GetStyleColorVec4(ImGuiCol_SliderGrabActive);
    colour.w = 1.0F;
    return ImGui::GetColorU32(colour);
}

/// The drawn hand at one moment of the movement.
struct Hand {
    ImVec2 at{};
    bool pressed{false};
    float share{0.0F};  ///< of what is done while it is pressed, 0 to 1
};

/// From 0 to 1 while `now` goes from `from` to `to`, slow at both ends.
float eased(double now, double from, double to) {
    const double t = std::clamp((now - from) / (to - from), 0.0, 1.0);
    return static_cast<float>(t * t * (3.0 - 2.0 * t));
}

/// The hand comes from beside, presses, goes to the end of the way, and lets go. `way` is not
/// empty.
Hand hand_on(const std::vector<ImVec2>& way, double time_s, float scale) {
    constexpr double kThere = 0.25;
    constexpr double kLetsGo = 0.8;
    const double now = std::fmod(time_s, kShownAgain_s) / kShownAgain_s;
    const float comes = 1.0F - eased(now, 0.0, kThere);
    const float share = eased(now, kThere, kLetsGo);
    const std::size_t k =
        static_cast<std::size_t>(std::lround(share * static_cast<float>(way.size() - 1)));
    return {{way[k].x + 44.0F * scale * comes, way[k].y + 34.0F * scale * comes},
            now >= kThere && now < kLetsGo,
            share};
}

void draw_pointer(ImDrawList& list, ImVec2 at, float s) {
    const auto p = [at, s](float x, float y) { return ImVec2{at.x + x * s, at.y + y * s}; };
    const ImVec2 shape[] = {p(0.0F, 0.0F),  p(0.0F, 17.0F), p(4.0F, 13.4F), p(6.8F, 19.6F),
                            p(9.6F, 18.4F), p(6.9F, 12.3F), p(12.2F, 12.0F)};
    list.AddPolyline(shape, 7, kEdge, ImDrawFlags_Closed, 4.0F * s);
    list.AddTriangleFilled(shape[0], shape[1], shape[6], kInk);
    list.AddQuadFilled(shape[2], shape[3], shape[4], shape[5], kInk);
}

/// A computer's mouse; its left button lights while it is pressed.
void draw_mouse(ImDrawList& list, ImVec2 middle, float s, bool pressed) {
    const ImVec2 low{middle.x - 14.0F * s, middle.y - 21.0F * s};
    const ImVec2 high{middle.x + 14.0F * s, middle.y + 21.0F * s};
    const float round = 13.0F * s;
    const float seam = low.y + 17.0F * s;
    list.AddRectFilled({low.x - 3.0F * s, low.y - 3.0F * s}, {high.x + 3.0F * s, high.y + 3.0F * s},
                       kEdge, round + 3.0F * s);
    if (pressed)
        list.AddRectFilled(low, {middle.x, seam}, accent(), round, ImDrawFlags_RoundCornersTopLeft);
    list.AddRect(low, high, kInk, round, 0, 2.0F * s);
    list.AddLine({middle.x, low.y}, {middle.x, seam}, kInk, 1.6F * s);
    list.AddLine({low.x, seam}, {high.x, seam}, kInk, 1.6F * s);
}

/// The pointer, and the mouse to its lower right, or to its left where there is no room.
void draw_hand(ImDrawList& list, const Hand& hand, float scale) {
    draw_pointer(list, hand.at, 1.4F * scale);
    const bool has_room = hand.at.x + 67.0F * scale < list.GetClipRectMax().x;
    const float aside = has_room ? 50.0F : -30.0F;
    draw_mouse(list, {hand.at.x + aside * scale, hand.at.y + 34.0F * scale}, scale, hand.pressed);
}

void draw_tick(ImDrawList& list, ImVec2 middle, float r) {
    const ImVec2 line[] = {{middle.x - 0.5F * r, middle.y},
                           {middle.x - 0.1F * r, middle.y + 0.4F * r},
                           {middle.x + 0.55F * r, middle.y - 0.4F * r}};
    list.AddCircleFilled(middle, r, accent(), 32);
    list.AddPolyline(line, 3, kInk, 0, 0.2F * r);
}

void draw_line(ImDrawList& list, const std::vector<ImVec2>& way, std::size_t count, ImU32 colour,
               float thick) {
    if (count >= 2) list.AddPolyline(way.data(), static_cast<int>(count), colour, 0, thick);
}

/// On the relief: the place or the way, and the hand; a tick once the step is done.
void draw_on_relief(ImDrawList& list, const LeadShown& lead, const std::vector<ImVec2>& way,
                    float scale) {
    const float ring = 20.0F * scale;
    if (lead.done) return draw_tick(list, way[way.size() / 2], ring);
    const Hand hand = hand_on(way, lead.time_s, scale);
    if (way.size() == 1) {
        const float r = hand.pressed ? ring * (0.55F + 0.45F * hand.share) : ring;
        if (hand.pressed) list.AddCircleFilled(way[0], r, kGlow, 40);
        list.AddCircle(way[0], r, kEdge, 40, 5.0F * scale);
        list.AddCircle(way[0], r, kInk, 40, 2.5F * scale);
    } else {
        draw_line(list, way, way.size(), kEdge, 9.0F * scale);
        draw_line(list, way, way.size(), kGlow, 5.0F * scale);
        const auto count =
            static_cast<std::size_t>(std::lround(hand.share * static_cast<float>(way.size() - 1)));
        draw_line(list, way, count + 1, kInk, 5.0F * scale);
    }
    draw_hand(list, hand, scale);
}

/// Around a button of a panel; the mouse is beside it, where it hides no other.
void draw_on_button(ImDrawList& list, const LeadShown& lead, float scale) {
    const auto [left, top, right, bottom] = lead.button;
    if (right <= left) return;
    const float gap = 4.0F * scale;
    const ImVec2 low{left - gap, top - gap};
    const ImVec2 high{right + gap, bottom + gap};
    const float round = 6.0F * scale;
    list.AddRect(low, high, kEdge, round, 0, 5.0F * scale);
    list.AddRect(low, high, lead.done ? accent() : kInk, round, 0, 2.5F * scale);
    if (lead.done) return;
    // The tip leaves the name free.
    const Hand hand = hand_on({{right - 4.0F * scale, bottom - 4.0F * scale}}, lead.time_s, scale);
    if (hand.pressed) list.AddRectFilled(low, high, kGlow, round);
    draw_hand(list, hand, scale);
}

/// Which step of the three it is, and a button that skips them.
void draw_steps(ViewerState& state) {
    const LeadShown& lead = *state.ui.lead;
    const float dot = 5.0F * state.ui.scale;
    const float side = ImGui::GetFrameHeight();
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    ImGui::SetNextWindowPos(
        {0.5F * room, ImGui::GetIO().DisplaySize.y - bottom_bar_height(state) - 0.6F * side},
        ImGuiCond_Always, {0.5F, 1.0F});
    ImGui::SetNextWindowBgAlpha(0.85F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.5F * side, 0.25F * side});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.75F * side);
    ImGui::Begin("First touch", nullptr,
                 kBareWindow | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar(2);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text);
    constexpr int kSteps = 3;
    for (int k = 0; k < kSteps; ++k) {
        const ImVec2 middle{at.x + dot + 4.0F * dot * static_cast<float>(k), at.y + 0.5F * side};
        const int step = static_cast<int>(lead.step);
        if (k < step || (k == step && lead.done))
            list.AddCircleFilled(middle, dot, accent(), 20);
        else if (k == step)
            list.AddCircleFilled(middle, dot, text, 20);
        else
            list.AddCircle(middle, dot, text, 20, 1.2F * state.ui.scale);
    }
    ImGui::Dummy({10.0F * dot + 0.5F * side, side});
    ImGui::SameLine();
    if (icon_button("skip", Icon::close, "Skip (any key)")) state.commands.push(SkipLead{});
    ImGui::End();
}

}  // namespace

void draw_lead(ViewerState& state, const glm::dmat4& clip_from_grid) {
    if (!state.ui.lead) return;
    draw_steps(state);
    LeadShown& lead = *state.ui.lead;
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float scale = state.ui.scale;
    if (lead.step == LeadStep::choose) {
        draw_on_button(list, lead, scale);
        lead.button = {};  // unless the next picture has it
        return;
    }
    const ReliefScreen screen(state, clip_from_grid);
    std::vector<ImVec2> way;
    for (const Vec3& place : lead.places)
        if (const auto at = screen.at(place)) way.push_back(*at);
    if (way.size() != lead.places.size() || way.empty()) return;
    list.PushClipRect(screen.low(), screen.high());
    draw_on_relief(list, lead, way, scale);
    list.PopClipRect();
}

}  // namespace dibhr
