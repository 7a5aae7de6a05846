// Touching and turning with the mouse.
#include "app/viewer/mouse.hpp"

#include <cmath>

namespace dibhr {

namespace {

constexpr double kOrbit_rad_per_px = 0.006;
constexpr double kZoomPerStep = 1.12;

bool inside(glm::dvec2 p, glm::ivec2 size) {
    return p.x >= 0.0 && p.y >= 0.0 && p.x < size.x && p.y < size.y;
}

}  // namespace

PointerUse ReliefMouse::use(const Pointer& pointer, double wheel_steps, bool over_panel,
                            glm::ivec2 viewport, Camera& camera) {
    const bool over_relief = !over_panel && inside(pointer.position_px, viewport);
    const bool any = pointer.left || pointer.right || pointer.middle;
    if (!any) drag_ = Drag::none;
    if (any && drag_ == Drag::none) {
        drag_ = !over_relief                                         ? Drag::panel
                : pointer.left                                       ? Drag::touch
                : pointer.middle || (pointer.right && pointer.shift) ? Drag::pan
                                                                     : Drag::orbit;
        last_px_ = pointer.position_px;  // how the pointer came here turns nothing
    }
    const glm::dvec2 moved = pointer.position_px - last_px_;
    last_px_ = pointer.position_px;
    if (drag_ == Drag::orbit)
        camera.orbit(moved.x * kOrbit_rad_per_px, moved.y * kOrbit_rad_per_px);
    if (drag_ == Drag::pan) camera.pan(moved.x, -moved.y, viewport.y);
    const bool touching = drag_ == Drag::touch && pointer.left;
    if (!touching && over_relief && std::abs(wheel_steps) > 0.0)
        camera.zoom(std::pow(kZoomPerStep, wheel_steps));
    const bool free = drag_ == Drag::none && over_relief;
    return {free || touching, touching, touching ? wheel_steps : 0.0};
}

}  // namespace dibhr
