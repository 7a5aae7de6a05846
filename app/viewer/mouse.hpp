// What the mouse does over the relief: it touches, and it moves the view.
#pragma once

#include <glm/vec2.hpp>

#include "app/viewer/hand_pointer.hpp"
#include "app/window/window.hpp"
#include "render/camera.hpp"

namespace dibhr {

/// Follows the buttons from picture to picture: a press belongs to where it began.
class ReliefMouse {
  public:
    /// Turns, shifts and zooms the camera; gives back what is left for the hand. `over_panel`: the
    /// panels have the pointer. `viewport` is the relief's part of the window, from its upper left.
    PointerUse use(const Pointer& pointer, double wheel_steps, bool over_panel, glm::ivec2 viewport,
                   Camera& camera);

  private:
    enum class Drag { none, panel, touch, orbit, pan };

    Drag drag_{Drag::none};
    glm::dvec2 last_px_{0.0};
};

}  // namespace dibhr
