// Touch for the two motors of a game pad: what is heard of the ticks, as strengths. Ticks in,
// numbers out; no device, no clock.
#pragma once

#include "core/sound/heard_ticks.hpp"
#include "core/sound/rubbing.hpp"
#include "core/sound/sound_tick.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// How strongly the motors turn, 0 .. 1 each.
struct Rumble {
    double low{0.0};   ///< the heavy, slow one
    double high{0.0};  ///< the light, fast one

    bool operator==(const Rumble&) const = default;
};

/// A motor takes tens of milliseconds to turn faster or slower, so it is given not the sound but
/// how loud that is:
/// - low: taps and releases as hard as they are, and where the force changes quickly;
/// - high: texture and scraping, as loud as the material lets them be.
/// What is felt shows in the next strength and fades within a tenth of a second. No function
/// allocates.
class TouchRumble {
  public:
    TouchRumble() noexcept;

    /// Loudness and hiss count.
    void choose(const SoundMaterial& material) noexcept;

    /// The next tick, a millisecond after the last. One whose force is off, or that is not finite,
    /// stops both motors.
    void add(const SoundTick& tick) noexcept;

    /// How strongly now, so long after the last question [s]. Both 0 when ticks stay away for
    /// longer than 20 ms.
    [[nodiscard]] Rumble after(double span_s) noexcept;

  private:
    void feel(const HeardTick& tick) noexcept;
    void be_quiet() noexcept;

    double loudness_, hiss_;
    HeardTicks ticks_{};
    Texture texture_;
    double unheard_s_{0.0};    ///< since the last tick came in
    double knock_{0.0};        ///< of the last tap, fading
    double slow_newton_{0.0};  ///< the force, as it changes slowly
    double jolt_newton_{0.0};  ///< how far the force is from that
    double rubbed_{0.0};       ///< of the texture, fading
    double scraping_{0.0};
};

}  // namespace dibhr
