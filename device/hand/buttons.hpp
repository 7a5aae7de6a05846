// The grip's buttons without their bounce.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace dibhr {

/// Most buttons of a device: bits of HandReading::buttons.
inline constexpr std::size_t kDeviceButtonCount = 4;
/// Number of presses of each button since the start.
using ButtonPresses = std::array<std::uint32_t, kDeviceButtonCount>;
/// Time of the last press of each button, on the steady clock.
using ButtonPressTimes = std::array<std::chrono::steady_clock::time_point, kDeviceButtonCount>;

/// The state of a button changes once every reading has shown the new state for kSteady.
class ButtonDebounce {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// falcon/README.md, Buttons: longer than their bounce, shorter than a finger.
    static constexpr std::chrono::milliseconds kSteady{8};

    /// Adds the bits of a reading received at `at`; returns the debounced bits.
    std::uint8_t add(std::uint8_t buttons, Time at) noexcept;

    [[nodiscard]] std::uint8_t steady() const noexcept { return steady_; }

    /// Number of presses of each button since construction; bit 0 first.
    [[nodiscard]] const ButtonPresses& presses() const noexcept { return presses_; }

    /// Time of the reading with which the last press of each button began.
    [[nodiscard]] const ButtonPressTimes& pressed_at() const noexcept { return pressed_at_; }

    /// The device is lost: all buttons count as up, the number of presses stays. A button that is
    /// down in the first reading afterwards (or ever) was held, not pressed: its next press counts.
    void release() noexcept;

  private:
    std::uint8_t steady_{0};
    bool begins_{true};         // the next reading is the first one of a link
    std::uint8_t held_{0};      // bits that have been down since that first reading
    std::uint8_t changing_{0};  // bits that differ from steady_ ...
    ButtonPressTimes since_{};  // ... and since when
    ButtonPresses presses_{};
    ButtonPressTimes pressed_at_{};
};

}  // namespace dibhr
