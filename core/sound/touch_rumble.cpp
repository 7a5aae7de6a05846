// Envelopes of the sound of touch.
#include "core/sound/touch_rumble.hpp"

#include <algorithm>
#include <cmath>

namespace dibhr {

namespace {

constexpr double kKnock_ticks = 25.0;      // a motor needs some time to be felt at all
constexpr double kSlowForce_ticks = 30.0;  // a hand presses more slowly
constexpr double kRubbed_ticks = 15.0;
constexpr double kKnockGain = 1.2;
constexpr double kJoltGain_per_newton = 0.25;
constexpr double kRubbingGain = 3.0;
constexpr double kLeastStrength = 0.02;  // no motor turns for it

double share_of(double value) noexcept {
    return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
}

double strength(double felt) noexcept {
    const double strength = std::tanh(felt);
    return strength < kLeastStrength ? 0.0 : strength;
}

}  // namespace

TouchRumble::TouchRumble() noexcept : loudness_(0.0), hiss_(0.0), texture_(kSoundTicks_hz) {
    choose({});
}

void TouchRumble::choose(const SoundMaterial& material) noexcept {
    loudness_ = share_of(material.loudness);
    hiss_ = share_of(material.hiss);
}

void TouchRumble::add(const SoundTick& tick) noexcept {
    since_tick_s_ = 0.0;
    ticks_.add(tick);
    if (ticks_.force_on()) {
        update_levels(ticks_.at(ticks_.newest()));
    } else {
        reset();
    }
}

void TouchRumble::update_levels(const TickFeatures& tick) noexcept {
    knock_ = std::max(tick.tap, knock_ - knock_ / kKnock_ticks);
    slow_newton_ += (tick.force_newton - slow_newton_) / kSlowForce_ticks;
    jolt_newton_ = std::abs(tick.force_newton - slow_newton_);
    rubbed_ = std::max(std::abs(texture_.next(tick)), rubbed_ - rubbed_ / kRubbed_ticks);
    scraping_ = scraping_of(tick);
}

Rumble TouchRumble::after(double span_s) noexcept {
    since_tick_s_ += span_s;
    if (since_tick_s_ > kSoundTimeout_s) reset();
    const double rubbing = rubbed_ + kScrapingGain * hiss_ * scraping_;
    return {.low = strength(kKnockGain * knock_ + kJoltGain_per_newton * jolt_newton_),
            .high = strength(kRubbingGain * loudness_ * rubbing)};
}

void TouchRumble::reset() noexcept {
    texture_.reset();
    knock_ = slow_newton_ = jolt_newton_ = rubbed_ = scraping_ = 0.0;
}

}  // namespace dibhr
