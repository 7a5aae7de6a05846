// The times of key presses and of mouse buttons, which GLFW does not pass on.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace dibhr {

/// The X server's time stamps of the presses, and of the mouse buttons' releases, that wait to be
/// polled.
class EventTimes {
  public:
    using Time = std::chrono::steady_clock::time_point;
    enum class Kind : std::uint8_t { key, mouse_button, mouse_release };

    struct Press {
        Kind kind{Kind::key};
        unsigned code{0};  ///< the server's key code; or the button, 1: the left one
        std::uint32_t server_ms{0};
    };

    /// Call it right before events are polled.
    void collect();
    /// The time of the press that GLFW has just reported; call it in the order of the presses. The
    /// begin of the server's millisecond; now, without an X server or with one of another clock.
    [[nodiscard]] Time of(Kind kind, unsigned code);

  private:
    std::vector<Press> presses_{};
};

}  // namespace dibhr
