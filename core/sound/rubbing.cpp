// Texture and scraping.
#include "core/sound/rubbing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dibhr {

namespace {

constexpr double kLowestTexture_hz = 30.0;  // slower is the shape of things
constexpr double kForceGain_per_newton = 0.9;
constexpr double kHeightGain_per_mm = 0.6;
constexpr double kLoudestTexture = 0.6;
constexpr double kFirmlyPressed_newton = 0.5;
constexpr double kHalfScraping_mm_per_s = 60.0;  // scraping reaches half of its loudness

double firmness_of(const TickFeatures& tick) noexcept {
    return std::clamp(tick.force_newton / kFirmlyPressed_newton, 0.0, 1.0);
}

}  // namespace

double scraping_of(const TickFeatures& tick) noexcept {
    const double speed = tick.speed_mm_per_s;
    return firmness_of(tick) * speed / (speed + kHalfScraping_mm_per_s);
}

Texture::Texture(double rate_hz) noexcept
    : force_(kLowestTexture_hz, rate_hz), height_(kLowestTexture_hz, rate_hz) {}

double Texture::next(const TickFeatures& tick) noexcept {
    if (std::exchange(begins_, false)) origin_ = tick;
    const double rubbing =
        kForceGain_per_newton * force_.next(tick.force_newton - origin_.force_newton) +
        kHeightGain_per_mm * firmness_of(tick) * height_.next(tick.height_mm - origin_.height_mm);
    return kLoudestTexture * std::tanh(rubbing / kLoudestTexture);
}

void Texture::reset() noexcept {
    force_.reset();
    height_.reset();
    begins_ = true;
}

}  // namespace dibhr
