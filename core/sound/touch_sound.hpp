// The sound of touch: taps, scraping and texture, computed sample by sample. Ticks in, samples out;
// no recorded sounds, no device, no clock.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/sound/filters.hpp"
#include "core/sound/rubbing.hpp"
#include "core/sound/tick_history.hpp"

namespace dibhr {

/// How a material sounds when it is touched.
struct SoundMaterial {
    double frequency_hz{600.0};  ///< lowest of the resonances that a tap rings
    double decay_s{0.05};        ///< until that resonance has faded by 60 dB
    double loudness{0.5};        ///< of the whole sound, 0 .. 1
    double hiss{0.3};            ///< of scraping, 0 .. 1
    double grain_mm{0.4};        ///< between what scrapes: the hiss is around speed / grain

    bool operator==(const SoundMaterial&) const = default;
};

/// The user's choice.
struct SoundChoice {
    SoundMaterial material{};
    double volume{0.5};  ///< 0 .. 1

    bool operator==(const SoundChoice&) const = default;
};

/// Three sounds, added and softly limited to [-1, 1]:
/// - a tap when contact begins, by the proxy's speed then, and a quieter one when it ends: an
///   impulse into the resonances of the material, which are a free bar's;
/// - texture: force and height of the proxy at 1 kHz, above 30 Hz. A bump every `period` sounds at
///   speed / period, the frequency that the hand feels;
/// - scraping: noise around speed / grain, louder with speed and force.
/// A tick sounds five milliseconds and a block later, a tap one millisecond and a block. No
/// function but the constructor takes long, none allocates.
class TouchSound {
  public:
    /// `rate_hz`: samples a second, limited to 8000 .. 192000.
    explicit TouchSound(double rate_hz) noexcept;

    void choose(const SoundChoice& choice) noexcept;

    /// The next tick. A tick that is not finite counts as no touch at all.
    void add(const SoundTick& tick) noexcept;

    /// The next samples, one channel in [-1, 1]; blocks have about the same size. Silent 5 ms after
    /// a tick whose force is off, and when no tick came for longer than 20 ms and two blocks.
    void render(std::span<float> samples) noexcept;

  private:
    void tune_resonances() noexcept;
    void adjust_pace(double block_ticks) noexcept;
    void advance() noexcept;
    void apply_tick(const TickFeatures& tick) noexcept;
    [[nodiscard]] double noise() noexcept;
    [[nodiscard]] double next_sample() noexcept;
    void reset() noexcept;

    double rate_hz_;
    SoundChoice choice_{};
    TickHistory ticks_{};
    double at_{0.0};            ///< the present place among the ticks, for taps
    double pace_{0.0};          ///< ticks a sample
    bool waiting_{true};        ///< for ticks
    double since_tick_s_{0.0};  ///< since the last tick came in
    double timeout_s_{0.0};
    double gate_{0.0};      ///< 0: silent, 1: open
    double impulse_{0.0};   ///< for the resonances
    double burst_{0.0};     ///< level of the noise of an impact
    double scraping_{0.0};  ///< level of the noise of sliding
    double volume_{0.0};
    std::uint32_t random_{0x9E3779B9U};
    std::array<Resonance, 4> resonances_{};
    Texture texture_;
    BandPass hiss_{};
};

}  // namespace dibhr
