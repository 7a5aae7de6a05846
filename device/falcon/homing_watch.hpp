// Follows homing over the replies: when poses are valid, and when the user needs a hint (README.md:
// Homing and lamp).
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "device/falcon/packet.hpp"
#include "device/falcon/thread_buffers.hpp"

namespace dibhr::falcon {

/// How many of the bits of Reply::homed are on.
[[nodiscard]] int homed_axes(std::uint8_t homed) noexcept;

/// What the user has to do now, with so many axes homed.
[[nodiscard]] std::string how_to_home(int axes);

/// By more than the noise of an encoder or the tremble of a hanging grip.
[[nodiscard]] bool moved_between(const Counts& a, const Counts& b) noexcept;

class HomingWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Resets for a new link.
    void begin(Time now) noexcept;
    void add(const Reply& reply, Time at) noexcept;

    /// From the second reply in a row with all bits on: the counters jump with the last bit.
    [[nodiscard]] bool ready() const noexcept { return full_replies_ >= 2; }
    /// A new epoch after each homing and each new link; kNoEpoch while not ready.
    [[nodiscard]] Epoch epoch() const noexcept { return ready() ? epoch_ : kNoEpoch; }
    /// Neither a motion nor a homed axis for 20 s.
    [[nodiscard]] bool idle(Time now) const noexcept;

  private:
    void look_for_motion(const Reply& reply, Time at) noexcept;

    int full_replies_{0};  // in a row; stops at 2
    Epoch epoch_{kNoEpoch};
    Reply last_place_{};
    bool placed_{false};
    Time still_since_{};
};

}  // namespace dibhr::falcon
