// The features of ticks, and their interpolation.
#include "core/sound/tick_history.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace dibhr {

namespace {

constexpr double kSoftestTap = 0.15;
constexpr double kHardTap_mm_per_s = 250.0;
constexpr double kHardestRelease = 0.3;
constexpr double kHardRelease_newton = 2.0;
constexpr int kChatter_ticks = 30;  // a contact that flickers taps less

constexpr double kLongestStep_mm = 3.0;  // in a tick; more is a jump, which is no motion
constexpr double kSpeedSmoothing_ticks = 5.0;
constexpr double kPressedFor_ticks = 30.0;
constexpr double kStrongest_newton = 20.0;

std::size_t slot_of(std::int64_t tick) noexcept {
    static_assert((TickHistory::kKept & (TickHistory::kKept - 1)) == 0, "a power of two");
    return static_cast<std::size_t>(tick) & (TickHistory::kKept - 1);
}

/// sin(pi x) / (pi x)
double sinc(double x) noexcept {
    const double angle = std::numbers::pi * x;
    return std::abs(angle) < 1e-9 ? 1.0 : std::sin(angle) / angle;
}

}  // namespace

/// The weights are Lanczos's kernel.
TickHistory::TickHistory() noexcept {
    constexpr double kHalf = 0.5 * kNeighbours;
    for (std::size_t place = 0; place <= kPlaces; ++place) {
        std::array<double, kNeighbours>& weights = weights_[place];
        double sum = 0.0;
        for (std::size_t k = 0; k < kNeighbours; ++k) {
            const double way =
                static_cast<double>(k) + 1.0 - kHalf - static_cast<double>(place) / double{kPlaces};
            weights[k] = std::abs(way) < kHalf ? sinc(way) * sinc(way / kHalf) : 0.0;
            sum += weights[k];
        }
        for (double& weight : weights) weight /= sum;
    }
}

void TickHistory::add(const SoundTick& tick) noexcept {
    const double height_mm = newest_ < 0 ? 0.0 : at(newest_).height_mm;
    TickFeatures& now = kept_[slot_of(++newest_)];
    now = {.height_mm = height_mm};
    const bool is_touch = is_finite(tick.proxy_mm) && std::isfinite(tick.force_newton);
    force_on_ = tick.force_on && is_touch;
    if (!is_touch) {
        contact_ = false;
        return;
    }
    const Vec3 step = tick.proxy_mm - proxy_mm_;
    const double way_mm = glm::length(step);
    const bool moved = newest_ > 0 && way_mm < kLongestStep_mm;  // false for what is not finite
    proxy_mm_ = tick.proxy_mm;
    now.tap = tap_of(tick);  // by how fast it was until now
    if (moved)
        speed_mm_per_s_ += (way_mm * kSoundTicks_hz - speed_mm_per_s_) / kSpeedSmoothing_ticks;
    if (tick.contact && contact_ && moved) now.height_mm += step.z;
    contact_ = tick.contact;
    if (!contact_) return;
    now.force_newton = std::clamp(tick.force_newton, 0.0, kStrongest_newton);
    now.speed_mm_per_s = speed_mm_per_s_;
    pressed_newton_ = std::max(now.force_newton, pressed_newton_ * (1.0 - 1.0 / kPressedFor_ticks));
}

double TickHistory::tap_of(const SoundTick& tick) noexcept {
    ticks_since_change_ = std::min(ticks_since_change_ + 1, kChatter_ticks);
    if (tick.contact == contact_) return 0.0;
    const double settled = ticks_since_change_ / double{kChatter_ticks};
    ticks_since_change_ = 0;
    if (tick.contact) {
        pressed_newton_ = 0.0;
        const double hard = std::min(1.0, speed_mm_per_s_ / kHardTap_mm_per_s);
        return settled * (kSoftestTap + (1.0 - kSoftestTap) * hard);
    }
    return settled * kHardestRelease * std::min(1.0, pressed_newton_ / kHardRelease_newton);
}

const TickFeatures& TickHistory::at(std::int64_t tick) const noexcept {
    const std::int64_t newest = std::max<std::int64_t>(0, newest_);
    const std::int64_t oldest =
        std::max<std::int64_t>(0, newest + 1 - static_cast<std::int64_t>(kKept));
    return kept_[slot_of(std::clamp(tick, oldest, newest))];
}

TickFeatures TickHistory::between(double place) const noexcept {
    const double whole = std::floor(place);
    const auto& weights =
        weights_[static_cast<std::size_t>(std::lround((place - whole) * double{kPlaces}))];
    const std::int64_t first = static_cast<std::int64_t>(whole) + 1 - std::int64_t{kNeighbours / 2};
    TickFeatures sum;
    for (std::size_t k = 0; k < kNeighbours; ++k) {
        const TickFeatures& tick = at(first + static_cast<std::int64_t>(k));
        sum.force_newton += weights[k] * tick.force_newton;
        sum.height_mm += weights[k] * tick.height_mm;
    }
    return sum;
}

}  // namespace dibhr
