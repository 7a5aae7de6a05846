// The four buttons of the grip without their bounce.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace dibhr::falcon {

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
