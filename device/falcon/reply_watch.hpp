// What the replies tell over time of homing: when poses may be trusted, when a person needs a hint
// (README.md: Homing and lamp).
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "device/falcon/exchange.hpp"
#include "device/falcon/packet.hpp"

namespace dibhr::falcon {

/// How many of the bits of Reply::homed are on.
[[nodiscard]] int homed_axes(std::uint8_t homed) noexcept;

/// What a person does now, when that many axes are homed.
[[nodiscard]] std::string how_to_home(int axes);

/// By more than an encoder's or a hanging grip's tremble.
[[nodiscard]] bool moved_between(const Counts& a, const Counts& b) noexcept;

class HomingWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// A new link: nothing is known.
    void begin(Time now) noexcept;
    void add(const Reply& reply, Time at) noexcept;

    /// From the second reply in a row with all bits on: the counters jump as the last one comes.
    [[nodiscard]] bool ready() const noexcept { return full_replies_ >= 2; }
    /// Another one after each homing and each link; kNoEpoch while not ready.
    [[nodiscard]] Epoch epoch() const noexcept { return ready() ? epoch_ : kNoEpoch; }
    /// Neither a motion nor a homed axis for 20 s.
    [[nodiscard]] bool idle(Time now) const noexcept;

  private:
    void look_for_motion(const Reply& reply, Time at) noexcept;

    int full_replies_{0};  // in a row; stops at 2
    Epoch epoch_{kNoEpoch};
    Reply last_place_{};
    bool placed_{false};
    Time quiet_since_{};
};

}  // namespace dibhr::falcon
