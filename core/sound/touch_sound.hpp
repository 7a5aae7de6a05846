// The sound of touch: taps, scraping and texture, made sample by sample of what is felt. Ticks in,
// samples out; no recorded sounds, no device, no clock.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/sound/sound_tick.hpp"

namespace dibhr {

/// How something sounds when it is touched.
struct SoundMaterial {
    double frequency_hz{600.0};  ///< lowest of the resonances that a tap rings
    double decay_s{0.05};        ///< until that has faded by 60 dB
    double loudness{0.5};        ///< of all, 0 .. 1
    double hiss{0.3};            ///< of scraping, 0 .. 1
    double grain_mm{0.4};        ///< between what scrapes: the hiss is around speed / grain

    bool operator==(const SoundMaterial&) const = default;
};

/// What a person chooses.
struct SoundChoice {
    SoundMaterial material{};
    double volume{0.5};  ///< 0 .. 1

    bool operator==(const SoundChoice&) const = default;
};

/// Three sounds, added and softly held to [-1, 1]:
/// - a tap when contact begins, by the proxy's speed then, and a quieter one when it ends: an
///   impulse into the resonances of the material, those of a bar of which one end is free;
/// - texture: force and height of the proxy as they are at 1 kHz, above 30 Hz. A bump every
///   `period` is heard at speed / period, as it is felt;
/// - scraping: noise around speed / grain, louder with speed and force.
/// What is in a tick is heard five milliseconds and a block later, a tap one millisecond and a
/// block. No function but the constructor takes long, none allocates.
class TouchSound {
  public:
    /// Of so many samples a second, held to 8000 .. 192000.
    explicit TouchSound(double rate_hz) noexcept;

    void choose(const SoundChoice& choice) noexcept;

    /// The next tick. What is not finite counts as no touch at all.
    void add(const SoundTick& tick) noexcept;

    /// The next samples, one channel in [-1, 1]; of one block about as many as of another. Silent
    /// 5 ms after a tick whose force is off, and when ticks stay away for longer than 20 ms and
    /// two blocks.
    void render(std::span<float> samples) noexcept;

  private:
    /// A tick as it is heard.
    struct Heard {
        double force_newton{0.0};  ///< in contact
        double height_mm{0.0};     ///< of the proxy, summed up while in contact
        double speed_mm_per_s{0.0};
        double tap{0.0};  ///< 0 .. 1
    };

    /// Second order, transposed direct form II.
    struct Filter {
        double b0{1.0}, b1{0.0}, b2{0.0}, a1{0.0}, a2{0.0};
        double s1{0.0}, s2{0.0};

        [[nodiscard]] double next(double in) noexcept;
        void be_quiet() noexcept { s1 = s2 = 0.0; }
    };

    /// Rings down after an impulse.
    struct Mode {
        double gain{0.0}, a1{0.0}, a2{0.0};
        double y1{0.0}, y2{0.0};

        [[nodiscard]] double next(double in) noexcept;
    };

    /// Noise around a frequency that may change at any sample: a state-variable filter with
    /// trapezoidal integration, the band-pass output, of gain 1 at that frequency.
    struct Band {
        double g{0.1};
        double s1{0.0}, s2{0.0};

        [[nodiscard]] double next(double in) noexcept;
    };

    static constexpr std::size_t kModes = 4;
    static constexpr std::size_t kTaps = 8;  // of a place between ticks
    static constexpr std::size_t kPlaces = 256;
    static constexpr std::size_t kHeard = 512;  // ticks: half a second
    static_assert((kHeard & (kHeard - 1)) == 0, "a power of two");

    [[nodiscard]] static Filter high_pass(double cutoff_hz, double rate_hz) noexcept;
    void fill_weights() noexcept;
    void tune_modes() noexcept;
    [[nodiscard]] double tap_of(const SoundTick& tick) noexcept;
    [[nodiscard]] const Heard& heard(std::int64_t tick) const noexcept;
    /// Force and height at a place between ticks.
    [[nodiscard]] Heard between(double place) const noexcept;
    void settle(double block_ticks) noexcept;
    void advance() noexcept;
    void reach(const Heard& tick) noexcept;
    [[nodiscard]] double noise() noexcept;
    [[nodiscard]] double next_sample() noexcept;
    void be_quiet() noexcept;

    double rate_hz_;
    SoundChoice choice_{};
    // Of the ticks as they come in.
    std::array<Heard, kHeard> heard_{};
    std::int64_t newest_{-1};  ///< number of the last one
    Vec3 proxy_mm_{0.0};
    bool contact_{false};
    bool force_on_{false};
    int ticks_since_change_{0};  ///< of contact
    double height_mm_{0.0};
    double speed_mm_per_s_{0.0};  ///< over a few milliseconds
    double pressed_newton_{0.0};  ///< most of the last tens of milliseconds
    // Of the samples as they go out.
    double at_{0.0};         ///< the tick that taps are heard of
    double pace_{0.0};       ///< ticks a sample
    bool waits_{true};       ///< for ticks
    double unheard_s_{0.0};  ///< since the last tick came in
    double patience_s_{0.0};
    double gate_{0.0};  ///< 0: silent, 1: open
    double impulse_{0.0};
    double burst_{0.0};  ///< the noise of an impact
    double scrape_{0.0};
    double volume_{0.0};
    // Where force and height were when the gate opened: being there is no sound.
    bool opens_{true};
    Heard rest_{};
    std::uint32_t random_{0x9E3779B9U};
    std::array<Mode, kModes> modes_{};
    Filter force_, height_;
    std::array<std::array<double, kTaps>, kPlaces + 1> weights_{};
    Band band_{};
};

}  // namespace dibhr
