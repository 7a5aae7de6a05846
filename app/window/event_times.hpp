// When keys and the mouse's button went down, which GLFW does not pass on.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace dibhr {

/// Of presses that wait to be polled: as the X server has stamped them.
class EventTimes {
  public:
    using Time = std::chrono::steady_clock::time_point;
    enum class Kind : std::uint8_t { key, mouse_button };

    struct Press {
        Kind kind{Kind::key};
        unsigned code{0};  ///< the server's, of the key; the button, the left one is 1
        std::uint32_t server_ms{0};
    };

    /// To be called right before events are polled.
    void look();
    /// Of the press that GLFW has just told of; presses are asked for in their order. The server's
    /// milliseconds begin; now where there is no X server, or its clock is not this machine's.
    [[nodiscard]] Time of(Kind kind, unsigned code);

  private:
    std::vector<Press> presses_{};
};

}  // namespace dibhr
