// Small digital filters for the sound of touch, a sample at a time, without allocation.
#pragma once

#include <cmath>
#include <numbers>

namespace dibhr {

/// 0 for an inaudible value: denormal numbers make a processor slow.
[[nodiscard]] inline double flush_denormal(double value) noexcept {
    constexpr double kNothing = 1e-15;
    return std::abs(value) < kNothing ? 0.0 : value;
}

/// Removes frequencies below a cutoff: Butterworth, second order, by the bilinear transform, in the
/// transposed direct form II.
class HighPass {
  public:
    HighPass(double cutoff_hz, double rate_hz) noexcept {
        const double w = std::tan(std::numbers::pi * cutoff_hz / rate_hz);
        b0_ = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
        a1_ = 2.0 * (w * w - 1.0) * b0_;
        a2_ = (1.0 - std::numbers::sqrt2 * w + w * w) * b0_;
    }

    [[nodiscard]] double next(double in) noexcept {
        const double out = b0_ * in + s1_;
        s1_ = flush_denormal(-2.0 * b0_ * in - a1_ * out + s2_);
        s2_ = flush_denormal(b0_ * in - a2_ * out);
        return out;
    }
    void reset() noexcept { s1_ = s2_ = 0.0; }

  private:
    double b0_{1.0}, a1_{0.0}, a2_{0.0};
    double s1_{0.0}, s2_{0.0};
};

/// Rings down after an impulse, from an amplitude of `share`.
class Resonance {
  public:
    /// `decay_s`: until it has faded by 60 dB. A running ring goes on. Silent for a frequency that
    /// is too high for the sample rate.
    void tune(double frequency_hz, double decay_s, double share, double rate_hz) noexcept {
        const double angle = 2.0 * std::numbers::pi * frequency_hz / rate_hz;
        if (angle > 0.9 * std::numbers::pi) {
            *this = {};
            return;
        }
        const double radius = std::exp(-std::log(1000.0) / (decay_s * rate_hz));
        gain_ = share * std::sin(angle);
        a1_ = 2.0 * radius * std::cos(angle);
        a2_ = -radius * radius;
    }

    [[nodiscard]] double next(double in) noexcept {
        const double out = gain_ * in + a1_ * y1_ + a2_ * y2_;
        y2_ = y1_;
        y1_ = flush_denormal(out);
        return out;
    }
    void reset() noexcept { y1_ = y2_ = 0.0; }

  private:
    double gain_{0.0}, a1_{0.0}, a2_{0.0};
    double y1_{0.0}, y2_{0.0};
};

/// Passes more than an octave around a frequency, at gain 1: a state-variable filter by trapezoidal
/// integration, which may be tuned at any sample.
class BandPass {
  public:
    /// Below half the rate.
    void tune(double centre_hz, double rate_hz) noexcept {
        g_ = std::tan(std::numbers::pi * centre_hz / rate_hz);
    }

    [[nodiscard]] double next(double in) noexcept {
        constexpr double kDamping = 1.25;  // 1 / Q
        const double band = (s1_ + g_ * (in - s2_)) / (1.0 + g_ * (kDamping + g_));
        const double low = s2_ + g_ * band;
        s1_ = flush_denormal(2.0 * band - s1_);
        s2_ = flush_denormal(2.0 * low - s2_);
        return kDamping * band;
    }
    void reset() noexcept { s1_ = s2_ = 0.0; }

  private:
    double g_{0.1};
    double s1_{0.0}, s2_{0.0};
};

}  // namespace dibhr
