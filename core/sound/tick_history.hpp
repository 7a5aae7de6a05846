// The last haptic ticks as features for sound, and their interpolation from 1 kHz to its rate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/sound/sound_tick.hpp"

namespace dibhr {

/// The features of a tick from which sound and rumble are made.
struct TickFeatures {
    double force_newton{0.0};    ///< while in contact
    double height_mm{0.0};       ///< of the proxy, summed up while in contact
    double speed_mm_per_s{0.0};  ///< of the proxy, while in contact
    double tap{0.0};             ///< 0 .. 1: contact begins in this tick or, quieter, ends
};

/// The last half second of ticks, numbered from 0.
class TickHistory {
  public:
    static constexpr std::size_t kKept = 512;

    TickHistory() noexcept;

    /// A tick that is not finite counts as no touch at all.
    void add(const SoundTick& tick) noexcept;

    /// Number of the last one; -1: none yet.
    [[nodiscard]] std::int64_t newest() const noexcept { return newest_; }
    /// Whether a force may act in the last tick.
    [[nodiscard]] bool force_on() const noexcept { return force_on_; }
    /// The nearest one that is kept.
    [[nodiscard]] const TickFeatures& at(std::int64_t tick) const noexcept;

    /// Force and height at a place between ticks, from four ticks before and four after: passes the
    /// ticks' content up to 400 Hz, and nearly nothing of their images above 600 Hz.
    [[nodiscard]] TickFeatures between(double place) const noexcept;
    static constexpr double kLookAhead_ticks = 4.0;

  private:
    static constexpr std::size_t kNeighbours = 8;
    static constexpr std::size_t kPlaces = 256;

    [[nodiscard]] double tap_of(const SoundTick& tick) noexcept;

    std::array<TickFeatures, kKept> kept_{};
    std::int64_t newest_{-1};
    Vec3 proxy_mm_{0.0};
    bool contact_{false};
    bool force_on_{false};
    int ticks_since_change_{0};   ///< of contact, up to kChatter_ticks
    double speed_mm_per_s_{0.0};  ///< over a few milliseconds
    double pressed_newton_{0.0};  ///< highest force of the last tens of milliseconds
    std::array<std::array<double, kNeighbours>, kPlaces + 1> weights_{};
};

}  // namespace dibhr
