// What the mouse does over the relief: it moves the view, and touches where no device does.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "app/window/window.hpp"
#include "core/haptics/surface.hpp"
#include "device/mouse_hand.hpp"
#include "render/camera.hpp"

namespace dibhr {

/// What the mouse does over the relief in one picture.
struct PointerUse {
    bool over_relief{false};  ///< neither over a panel nor outside the window
    bool pressed{false};      ///< left button, first pressed over the relief
    double wheel_steps{0.0};  ///< turned while pressed, > 0: deeper
};

/// Follows the buttons from picture to picture: a press belongs to where it began.
class ReliefMouse {
  public:
    /// Turns, shifts and zooms the camera; returns the input that is left for the virtual hand.
    /// `over_panel`: the panels use the pointer. `viewport`: size of the relief, at the upper left.
    PointerUse use(const Pointer& pointer, double wheel_steps, bool over_panel, glm::ivec2 viewport,
                   Camera& camera);

  private:
    enum class Drag { none, panel, touch, orbit, pan };

    Drag drag_{Drag::none};
    glm::dvec2 last_px_{0.0};
};

/// Turns the ray under the cursor into the virtual hand's target, on the surface that is seen.
class HandPointer {
  public:
    /// Beside the relief the target keeps the last height on the surface, so that a stroke over the
    /// edge continues.
    [[nodiscard]] MouseTarget target(const Camera::Ray& ray, const DepthSurface& surface,
                                     const PointerUse& use);

  private:
    MouseTarget last_{};
    double height_px_{0.0};
};

/// The first point of the surface (grid space) that a ray meets, entering the image's rectangle
/// through its side or from above; nothing when the ray misses it.
[[nodiscard]] std::optional<Vec3> surface_under(const Camera::Ray& ray,
                                                const DepthSurface& surface);

}  // namespace dibhr
