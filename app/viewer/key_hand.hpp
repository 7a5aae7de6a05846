// The hand by keyboard: keys move a pointer over the relief, which touches as the mouse's does.
#pragma once

#include <chrono>
#include <glm/vec2.hpp>
#include <optional>

#include "app/window/window.hpp"
#include "render/camera.hpp"

namespace dibhr {

/// The keys that are down at a moment.
struct HandKeys {
    int right{0}, down{0};  ///< -1, 0 or 1
    bool press{false};
    bool slowly{false};

    [[nodiscard]] bool any() const { return right != 0 || down != 0 || press; }
    [[nodiscard]] static HandKeys of(const Window& window);
};

/// While it is on: arrows move the hand, slowly with Shift; Space presses, and Enter keeps pressing
/// until it is hit again; Page up and Page down are the mouse's wheel. With Ctrl the arrows turn
/// the view, with Ctrl and Shift they move it.
class KeyHand {
  public:
    using Time = EventTimes::Time;

    [[nodiscard]] bool on() const { return place_px_.has_value(); }
    /// Begins at that place of the relief, or in its middle.
    void begin(glm::dvec2 place_px, glm::ivec2 viewport);
    void end();

    /// Takes a key; false: it means nothing to the hand.
    bool take(const KeyPress& press, glm::ivec2 viewport, Camera& camera);
    /// Where the hand points now, and whether it presses. on() must be true.
    [[nodiscard]] Pointer follow(const HandKeys& keys, Time now, glm::ivec2 viewport);
    /// Steps of the wheel since the last call.
    [[nodiscard]] double take_wheel();

  private:
    void move(glm::dvec2 by_px, glm::ivec2 viewport);

    std::optional<glm::dvec2> place_px_{};  // of the relief; nothing: off
    Time followed_{};
    bool tapped_{false};    // since the last follow()
    Time pressed_until_{};  // a tap is felt for some time, however late the window follows
    bool keeps_pressing_{false};
    double wheel_steps_{0.0};
};

}  // namespace dibhr
