// Synthesis of the sound of touch.
#include "core/sound/touch_sound.hpp"

#include <algorithm>
#include <cmath>

namespace dibhr {

namespace {

constexpr double kLowestScraping_hz = 150.0;
constexpr double kHighestScraping = 0.4;  // of the rate

constexpr double kTapGain = 0.8;
constexpr double kBurst_s = 0.002;
constexpr double kGain = 7.0;  // a slow stroke over sandpaper: about -30 dB at half the volume

constexpr double kJitter_ticks = 1.0;  // how late ticks may come
constexpr double kTooFarBehind_ticks = 25.0;
constexpr double kPaceGain = 0.002;  // a tick behind: an inaudible change of pitch
constexpr double kMostPace = 0.02;
constexpr double kGate_s = 0.004;
constexpr double kVolumeFade_s = 0.02;

// Of a free bar (Euler and Bernoulli's), over the lowest; the shares are chosen.
constexpr std::array kRatios{1.0, 2.756, 5.404, 8.933};
constexpr std::array kShares{0.5, 0.28, 0.14, 0.08};
constexpr double kFadesFaster = 0.7;  // the power of the ratio by which higher ones fade sooner

double held(double value, double lowest, double highest) noexcept {
    return std::isfinite(value) ? std::clamp(value, lowest, highest) : lowest;
}

SoundChoice held(SoundChoice choice) noexcept {
    SoundMaterial& material = choice.material;
    material.frequency_hz = held(material.frequency_hz, 20.0, 20'000.0);
    material.decay_s = held(material.decay_s, 0.001, 10.0);
    material.loudness = held(material.loudness, 0.0, 1.0);
    material.hiss = held(material.hiss, 0.0, 1.0);
    material.grain_mm = held(material.grain_mm, 0.001, 1000.0);
    choice.volume = held(choice.volume, 0.0, 1.0);
    return choice;
}

}  // namespace

TouchSound::TouchSound(double rate_hz) noexcept
    : rate_hz_(held(rate_hz, 8000.0, 192'000.0)), texture_(rate_hz_) {
    tune_resonances();
}

void TouchSound::choose(const SoundChoice& choice) noexcept {
    const SoundMaterial before = choice_.material;
    choice_ = held(choice);
    if (!(choice_.material == before)) tune_resonances();
}

void TouchSound::tune_resonances() noexcept {
    const SoundMaterial& material = choice_.material;
    for (std::size_t k = 0; k < resonances_.size(); ++k)
        resonances_[k].tune(kRatios[k] * material.frequency_hz,
                            material.decay_s / std::pow(kRatios[k], kFadesFaster), kShares[k],
                            rate_hz_);
}

void TouchSound::add(const SoundTick& tick) noexcept {
    since_tick_s_ = 0.0;
    ticks_.add(tick);
}

void TouchSound::render(std::span<float> samples) noexcept {
    const double block_s = static_cast<double>(samples.size()) / rate_hz_;
    timeout_s_ = kSoundTimeout_s + 2.0 * block_s;
    adjust_pace(block_s * kSoundTicks_hz);
    for (float& sample : samples) sample = static_cast<float>(next_sample());
}

/// Keeps the place behind the newest tick no farther than the block needs, so that the sound is not
/// late. Small differences are corrected by the pace.
void TouchSound::adjust_pace(double block_ticks) noexcept {
    constexpr double kMost = TickHistory::kKept - 2.0 * kTooFarBehind_ticks;
    const double wanted = std::min(block_ticks + kJitter_ticks, kMost);
    const auto newest = static_cast<double>(ticks_.newest());
    const double behind = newest - at_;
    if (behind > wanted + kTooFarBehind_ticks) at_ = newest - wanted;
    if (behind >= wanted) waiting_ = false;
    const double change = std::clamp(kPaceGain * (behind - wanted), -kMostPace, kMostPace);
    pace_ = (1.0 + change) * kSoundTicks_hz / rate_hz_;
}

void TouchSound::advance() noexcept {
    if (waiting_) return;
    const auto before = static_cast<std::int64_t>(std::floor(at_));
    const auto newest = static_cast<double>(ticks_.newest());
    waiting_ = at_ + pace_ > newest;
    at_ = std::min(at_ + pace_, newest);
    const auto now = static_cast<std::int64_t>(std::floor(at_));
    for (std::int64_t tick = before + 1; tick <= now; ++tick) apply_tick(ticks_.at(tick));
}

void TouchSound::apply_tick(const TickFeatures& tick) noexcept {
    impulse_ += tick.tap;
    burst_ = std::max(burst_, tick.tap);
    scraping_ = scraping_of(tick);
    hiss_.tune(std::clamp(tick.speed_mm_per_s / choice_.material.grain_mm, kLowestScraping_hz,
                          kHighestScraping * rate_hz_),
               rate_hz_);
}

double TouchSound::next_sample() noexcept {
    advance();
    since_tick_s_ += 1.0 / rate_hz_;
    const bool open = ticks_.force_on() && since_tick_s_ < timeout_s_;
    gate_ = std::clamp(gate_ + (open ? 1.0 : -1.0) / (kGate_s * rate_hz_), 0.0, 1.0);
    if (gate_ <= 0.0) {
        reset();
        return 0.0;
    }
    const double texture = texture_.next(ticks_.between(at_ - TickHistory::kLookAhead_ticks));
    burst_ = flush_denormal(burst_ - burst_ / (kBurst_s * rate_hz_));
    const double hiss =
        kScrapingGain * choice_.material.hiss * hiss_.next((scraping_ + burst_) * noise());
    double ringing = 0.0;
    for (Resonance& resonance : resonances_) ringing += resonance.next(impulse_);
    impulse_ = 0.0;
    volume_ += (choice_.volume * choice_.material.loudness - volume_) / (kVolumeFade_s * rate_hz_);
    return gate_ * std::tanh(kGain * volume_ * (texture + hiss + kTapGain * ringing));
}

/// A ring from before the force went off must not sound when it is on again.
void TouchSound::reset() noexcept {
    for (Resonance& resonance : resonances_) resonance.reset();
    texture_.reset();
    hiss_.reset();
    impulse_ = burst_ = scraping_ = 0.0;
    volume_ = choice_.volume * choice_.material.loudness;
}

double TouchSound::noise() noexcept {
    random_ ^= random_ << 13U;  // Marsaglia's xorshift
    random_ ^= random_ >> 17U;
    random_ ^= random_ << 5U;
    return static_cast<double>(random_) / 2147483648.0 - 1.0;
}

}  // namespace dibhr
