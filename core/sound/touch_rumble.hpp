// Touch for the two motors of a game pad: ticks in, strengths out; no device, no clock.
#pragma once

#include "core/sound/rubbing.hpp"
#include "core/sound/sound_tick.hpp"
#include "core/sound/tick_history.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// How strongly the motors turn, 0 .. 1 each.
struct Rumble {
    double low{0.0};   ///< the heavy, slow one
    double high{0.0};  ///< the light, fast one

    bool operator==(const Rumble&) const = default;
};

/// A motor takes tens of milliseconds to turn faster or slower, so it gets the loudness of the
/// sound:
/// - low: taps and releases as hard as they are, and where the force changes quickly;
/// - high: texture and scraping, as loud as the material lets them be.
/// A tick acts on the next strength and fades within a tenth of a second. No function allocates.
class TouchRumble {
  public:
    TouchRumble() noexcept;

    /// Only loudness and hiss are used.
    void choose(const SoundMaterial& material) noexcept;

    /// The next tick, a millisecond after the last. One whose force is off, or that is not finite,
    /// stops both motors.
    void add(const SoundTick& tick) noexcept;

    /// The strengths now, `span_s` after the last call. Both 0 when no tick came for longer than
    /// 20 ms.
    [[nodiscard]] Rumble after(double span_s) noexcept;

  private:
    void update_levels(const TickFeatures& tick) noexcept;
    void reset() noexcept;

    double loudness_, hiss_;
    TickHistory ticks_{};
    Texture texture_;
    double since_tick_s_{0.0};  ///< since the last tick came in
    double knock_{0.0};         ///< of the last tap, fading
    double slow_newton_{0.0};   ///< the force, as it changes slowly
    double jolt_newton_{0.0};   ///< difference of the force from `slow_newton_`
    double rubbed_{0.0};        ///< of the texture, fading
    double scraping_{0.0};
};

}  // namespace dibhr
