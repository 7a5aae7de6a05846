// What the replies tell over time: homing (when poses may be trusted, when a person needs a hint)
// and the buttons without their bounce (README.md: Homing and lamp, Buttons).
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
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

/// A button counts as pressed or released once it has been so, in every reply, for kSteady.
class ButtonDebounce {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// README.md, Buttons.
    static constexpr std::chrono::milliseconds kSteady{8};

    /// Takes Reply::buttons of a reply that came at `at`; gives the steady ones, bits of Button.
    std::uint8_t add(std::uint8_t buttons, Time at) noexcept;

    [[nodiscard]] std::uint8_t steady() const noexcept { return steady_; }

    /// How often plus, forward, centre, minus went down, ever.
    [[nodiscard]] const std::array<std::uint32_t, 4>& presses() const noexcept { return presses_; }

    /// All buttons up: the device is gone. The presses stay counted. What is down in the first
    /// reply after it, as in the very first one, was not pressed but held: it counts when it goes
    /// down again.
    void release() noexcept;

  private:
    static constexpr std::size_t kButtons = 4;

    std::uint8_t steady_{0};
    bool begins_{true};                   // the next reply is a link's first
    std::uint8_t held_{0};                // bits that have been down since then
    std::uint8_t changing_{0};            // bits that differ from steady_ ...
    std::array<Time, kButtons> since_{};  // ... from these replies on
    std::array<std::uint32_t, kButtons> presses_{};
};

}  // namespace dibhr::falcon
