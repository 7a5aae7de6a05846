// The grip's buttons without their bounce.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace dibhr {

/// How many buttons a grip has at most: bits of HandReading::buttons.
inline constexpr std::size_t kGripButtonCount = 4;
/// How often each went down since the start.
using ButtonPresses = std::array<std::uint32_t, kGripButtonCount>;
/// When each went down last, on the steady clock.
using ButtonPressTimes = std::array<std::chrono::steady_clock::time_point, kGripButtonCount>;

/// A button counts as pressed or released once it has been so, in every reading, for kSteady.
class ButtonDebounce {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// falcon/README.md, Buttons: longer than their bounce, shorter than a finger.
    static constexpr std::chrono::milliseconds kSteady{8};

    /// Takes the bits of a reading that came at `at`; gives the steady ones.
    std::uint8_t add(std::uint8_t buttons, Time at) noexcept;

    [[nodiscard]] std::uint8_t steady() const noexcept { return steady_; }

    /// How often each went down, ever; bit 0 first.
    [[nodiscard]] const ButtonPresses& presses() const noexcept { return presses_; }

    /// The reading that each press began with.
    [[nodiscard]] const ButtonPressTimes& pressed_at() const noexcept { return pressed_at_; }

    /// All buttons up: the device is gone. The presses stay counted. What is down in the first
    /// reading after it, as in the very first one, was not pressed but held: it counts when it goes
    /// down again.
    void release() noexcept;

  private:
    std::uint8_t steady_{0};
    bool begins_{true};         // the next reading is a link's first
    std::uint8_t held_{0};      // bits that have been down since then
    std::uint8_t changing_{0};  // bits that differ from steady_ ...
    ButtonPressTimes since_{};  // ... from these readings on
    ButtonPresses presses_{};
    ButtonPressTimes pressed_at_{};
};

}  // namespace dibhr
