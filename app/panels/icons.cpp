// The pictures on buttons.
#include "app/panels/icons.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dibhr {

namespace {

void draw_restore(ImDrawList& list, ImVec2 centre, float r, ImU32 colour) {
    constexpr float kPi = std::numbers::pi_v<float>;
    list.PathArcTo(centre, r, -0.75F * kPi, 0.9F * kPi, 20);
    list.PathStroke(colour, 0, std::max(1.5F, r * 0.28F));
    const ImVec2 tip{centre.x + r * std::cos(-0.75F * kPi), centre.y + r * std::sin(-0.75F * kPi)};
    list.AddTriangleFilled({tip.x - r * 0.6F, tip.y + r * 0.5F},
                           {tip.x - r * 0.5F, tip.y - r * 0.6F},
                           {tip.x + r * 0.6F, tip.y + r * 0.3F}, colour);
}

void draw_loop(ImDrawList& list, ImVec2 centre, float r, ImU32 colour) {
    const float thick = std::max(1.5F, r * 0.25F);
    const ImVec2 low{centre.x - r, centre.y - r * 0.55F};
    const ImVec2 high{centre.x + r, centre.y + r * 0.65F};
    list.AddRect(low, high, colour, r * 0.5F, 0, thick);
    list.AddTriangleFilled({centre.x - r * 0.35F, low.y - r * 0.55F},
                           {centre.x - r * 0.35F, low.y + r * 0.55F}, {centre.x + r * 0.45F, low.y},
                           colour);
}

void draw_step(ImDrawList& list, ImVec2 centre, float r, float way, ImU32 colour) {
    list.AddTriangleFilled({centre.x - way * r * 0.8F, centre.y - r * 0.8F},
                           {centre.x - way * r * 0.8F, centre.y + r * 0.8F},
                           {centre.x + way * r * 0.4F, centre.y}, colour);
    const float near = centre.x + way * r * 0.55F;
    const float far = centre.x + way * r * 0.85F;
    list.AddRectFilled({std::min(near, far), centre.y - r * 0.8F},
                       {std::max(near, far), centre.y + r * 0.8F}, colour);
}

/// A folder, half open.
void draw_folder(ImDrawList& list, ImVec2 c, float r, ImU32 colour) {
    const float thick = std::max(1.2F, r * 0.2F);
    const ImVec2 back[] = {{c.x - r, c.y + r * 0.8F},          {c.x - r, c.y - r * 0.8F},
                           {c.x - r * 0.35F, c.y - r * 0.8F},  {c.x - r * 0.05F, c.y - r * 0.45F},
                           {c.x + r * 0.75F, c.y - r * 0.45F}, {c.x + r * 0.75F, c.y - r * 0.05F}};
    list.AddPolyline(back, 6, colour, 0, thick);
    const ImVec2 front[] = {{c.x - r, c.y + r * 0.8F},
                            {c.x - r * 0.55F, c.y - r * 0.05F},
                            {c.x + r * 1.15F, c.y - r * 0.05F},
                            {c.x + r * 0.7F, c.y + r * 0.8F}};
    list.AddConvexPolyFilled(front, 4, colour);
}

/// A magnifier.
void draw_magnifier(ImDrawList& list, ImVec2 c, float r, ImU32 colour) {
    const ImVec2 glass{c.x - r * 0.25F, c.y - r * 0.25F};
    list.AddCircle(glass, r * 0.68F, colour, 24, std::max(1.3F, r * 0.22F));
    list.AddLine({glass.x + r * 0.5F, glass.y + r * 0.5F}, {c.x + r * 0.95F, c.y + r * 0.95F},
                 colour, std::max(1.8F, r * 0.34F));
}

/// A brush with its tip at the lower left.
void draw_brush_icon(ImDrawList& list, ImVec2 c, float r, ImU32 colour) {
    list.AddLine({c.x + r * 0.95F, c.y - r * 0.95F}, {c.x - r * 0.05F, c.y + r * 0.05F}, colour,
                 std::max(1.6F, r * 0.3F));
    const ImVec2 tip[] = {{c.x - r * 0.3F, c.y - r * 0.2F},
                          {c.x + r * 0.2F, c.y + r * 0.3F},
                          {c.x - r * 0.2F, c.y + r * 0.8F},
                          {c.x - r * 1.0F, c.y + r * 0.95F},
                          {c.x - r * 0.7F, c.y + r * 0.3F}};
    list.AddConvexPolyFilled(tip, 5, colour);
}

/// A ruler with its marks on the upper edge.
void draw_ruler_icon(ImDrawList& list, ImVec2 c, float r, ImU32 colour) {
    const float thick = std::max(1.2F, r * 0.2F);
    list.AddRect({c.x - r * 1.15F, c.y - r * 0.6F}, {c.x + r * 1.15F, c.y + r * 0.6F}, colour,
                 r * 0.12F, 0, thick);
    constexpr int kMarks = 4;
    for (int k = 1; k <= kMarks; ++k) {
        const float x = c.x + r * 1.1F * (2.0F * static_cast<float>(k) / (kMarks + 1) - 1.0F);
        list.AddLine({x, c.y - r * 0.6F}, {x, c.y + (k % 2 == 0 ? r * 0.1F : -r * 0.1F)}, colour,
                     thick);
    }
}

/// A film camera.
void draw_camera(ImDrawList& list, ImVec2 c, float r, ImU32 colour) {
    list.AddRectFilled({c.x - r * 1.05F, c.y - r * 0.6F}, {c.x + r * 0.4F, c.y + r * 0.6F}, colour,
                       r * 0.2F);
    list.AddTriangleFilled({c.x + r * 1.1F, c.y - r * 0.6F}, {c.x + r * 0.5F, c.y},
                           {c.x + r * 1.1F, c.y + r * 0.6F}, colour);
}

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, ImVec2 centre, float r, ImU32 colour) {
    switch (icon) {
        case Icon::play:
            list.AddTriangleFilled({centre.x - r * 0.6F, centre.y - r},
                                   {centre.x - r * 0.6F, centre.y + r}, {centre.x + r, centre.y},
                                   colour);
            break;
        case Icon::pause:
            list.AddRectFilled({centre.x - r * 0.75F, centre.y - r * 0.9F},
                               {centre.x - r * 0.2F, centre.y + r * 0.9F}, colour);
            list.AddRectFilled({centre.x + r * 0.2F, centre.y - r * 0.9F},
                               {centre.x + r * 0.75F, centre.y + r * 0.9F}, colour);
            break;
        case Icon::step_back:
            draw_step(list, centre, r, -1.0F, colour);
            break;
        case Icon::step_forward:
            draw_step(list, centre, r, 1.0F, colour);
            break;
        case Icon::loop:
            draw_loop(list, centre, r, colour);
            break;
        case Icon::restore:
            draw_restore(list, centre, r * 0.8F, colour);
            break;
        case Icon::open:
            draw_folder(list, centre, r, colour);
            break;
        case Icon::record:
            // Not red: red says that a recording runs.
            list.AddCircle(centre, r, colour, 24, std::max(1.2F, r * 0.18F));
            list.AddCircleFilled(centre, r * 0.6F, colour, 24);
            break;
        case Icon::explain:
            draw_magnifier(list, centre, r, colour);
            break;
        case Icon::paint:
            draw_brush_icon(list, centre, r, colour);
            break;
        case Icon::ruler:
            draw_ruler_icon(list, centre, r, colour);
            break;
        case Icon::clip:
            draw_camera(list, centre, r, colour);
            break;
        case Icon::close:
            list.AddLine({centre.x - r * 0.7F, centre.y - r * 0.7F},
                         {centre.x + r * 0.7F, centre.y + r * 0.7F}, colour, r * 0.28F);
            list.AddLine({centre.x - r * 0.7F, centre.y + r * 0.7F},
                         {centre.x + r * 0.7F, centre.y - r * 0.7F}, colour, r * 0.28F);
            break;
    }
}

}  // namespace dibhr
