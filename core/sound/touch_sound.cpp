// Synthesis of what touch sounds like.
#include "core/sound/touch_sound.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace dibhr {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTicks_hz = 1000.0;

// What is felt as texture; slower is the shape of things.
constexpr double kLowestTexture_hz = 30.0;
constexpr double kForceHeard_per_newton = 0.9;
constexpr double kHeightHeard_per_mm = 0.6;
constexpr double kLoudestTexture = 0.6;  // over an edge the force may leap by newtons
constexpr double kFirmlyPressed_newton = 0.5;

constexpr double kScrapeHeard = 0.8;
constexpr double kHalfScraping_mm_per_s = 60.0;  // at which it is half as loud as it gets
constexpr double kLowestScraping_hz = 150.0;
constexpr double kHighestScraping = 0.4;  // of the rate
constexpr double kBandDamping = 1.25;     // 1 / Q: more than an octave wide

constexpr double kTapHeard = 0.8;
constexpr double kSoftestTap = 0.15;
constexpr double kHardTap_mm_per_s = 250.0;
constexpr double kReleaseHeard = 0.3;  // of a tap
constexpr double kHardRelease_newton = 2.0;
constexpr double kBurst_s = 0.002;
constexpr int kChatter_ticks = 30;  // a contact that flickers taps less

constexpr double kLongestStep_mm = 3.0;  // in a tick; more is a jump, which is no motion
constexpr double kSpeedSmoothing_ticks = 5.0;
constexpr double kPressedFor_ticks = 30.0;
constexpr double kStrongest_newton = 20.0;

constexpr double kGain = 7.0;  // a slow stroke over sandpaper: about -30 dB at half the volume

constexpr double kJitter_ticks = 1.0;  // that ticks may come too late
constexpr double kLookAhead_ticks = 4.0;
constexpr double kTooFarBehind_ticks = 25.0;
constexpr double kPaceGain = 0.002;  // of a tick behind: nobody hears the pitch change
constexpr double kMostPace = 0.02;
constexpr double kGate_s = 0.004;
constexpr double kVolumeFade_s = 0.02;
constexpr double kPatience_s = 0.02;
constexpr double kNothing = 1e-15;  // smaller numbers make a processor slow

// Of a bar clamped at one end, softened: the higher ones are nearer.
constexpr std::array kRatios{1.0, 2.3, 4.1, 6.3};
constexpr std::array kShares{0.5, 0.28, 0.14, 0.08};
constexpr double kFadesFaster = 0.7;  // the power of the ratio by which higher ones fade sooner

bool is_touch(const SoundTick& tick) noexcept {
    return is_finite(tick.proxy_mm) && std::isfinite(tick.force_newton);
}

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

double without_denormals(double value) noexcept {
    return std::abs(value) < kNothing ? 0.0 : value;
}

}  // namespace

TouchSound::TouchSound(double rate_hz) noexcept
    : rate_hz_(held(rate_hz, 8000.0, 192'000.0)),
      force_(high_pass(kLowestTexture_hz, rate_hz_)),
      height_(high_pass(kLowestTexture_hz, rate_hz_)) {
    fill_weights();
    tune_modes();
}

void TouchSound::choose(const SoundChoice& choice) noexcept {
    const SoundMaterial before = choice_.material;
    choice_ = held(choice);
    if (!(choice_.material == before)) tune_modes();
}

void TouchSound::add(const SoundTick& tick) noexcept {
    unheard_s_ = 0.0;
    ++newest_;
    const auto& last = heard_[static_cast<std::size_t>(newest_ - 1) & (kHeard - 1)];
    Heard& now = heard_[static_cast<std::size_t>(newest_) & (kHeard - 1)];
    now = {0.0, last.height_mm, 0.0, 0.0};
    force_on_ = tick.force_on && is_touch(tick);
    if (!is_touch(tick)) {
        contact_ = false;
        return;
    }
    const Vec3 step = tick.proxy_mm - proxy_mm_;
    const double way_mm = glm::length(step);
    const bool moved = newest_ > 0 && way_mm < kLongestStep_mm;  // false for what is not finite
    proxy_mm_ = tick.proxy_mm;
    const double speed = moved ? way_mm * kTicks_hz : speed_mm_per_s_;
    now.tap = tap_of(tick);
    speed_mm_per_s_ += (speed - speed_mm_per_s_) / kSpeedSmoothing_ticks;
    if (tick.contact && contact_ && moved) height_mm_ += step.z;
    contact_ = tick.contact;
    now.height_mm = height_mm_;
    if (!contact_) return;
    now.force_newton = std::clamp(tick.force_newton, 0.0, kStrongest_newton);
    now.speed_mm_per_s = speed_mm_per_s_;
    pressed_newton_ = std::max(now.force_newton, pressed_newton_ * (1.0 - 1.0 / kPressedFor_ticks));
}

/// Before the rest of the tick counts: how fast it was until now.
double TouchSound::tap_of(const SoundTick& tick) noexcept {
    ++ticks_since_change_;
    if (tick.contact == contact_) return 0.0;
    const double settled = std::min(1.0, ticks_since_change_ / double{kChatter_ticks});
    ticks_since_change_ = 0;
    if (tick.contact) {
        pressed_newton_ = 0.0;
        const double hard = std::min(1.0, speed_mm_per_s_ / kHardTap_mm_per_s);
        return settled * (kSoftestTap + (1.0 - kSoftestTap) * hard);
    }
    return settled * kReleaseHeard * std::min(1.0, pressed_newton_ / kHardRelease_newton);
}

void TouchSound::render(std::span<float> samples) noexcept {
    const double block_s = static_cast<double>(samples.size()) / rate_hz_;
    patience_s_ = kPatience_s + 2.0 * block_s;
    settle(block_s * kTicks_hz);
    for (float& sample : samples) sample = static_cast<float>(next_sample());
    for (Mode& mode : modes_) {
        mode.y1 = without_denormals(mode.y1);
        mode.y2 = without_denormals(mode.y2);
    }
    for (double* state :
         {&force_.s1, &force_.s2, &height_.s1, &height_.s2, &band_.s1, &band_.s2, &burst_})
        *state = without_denormals(*state);
}

/// How far behind the newest tick: no farther than the block needs, or it would be heard late. A
/// little too far or too near is made up for by the pace.
void TouchSound::settle(double block_ticks) noexcept {
    const double most = static_cast<double>(kHeard) - 8.0 - kTooFarBehind_ticks;
    const double wanted = std::min(block_ticks + kJitter_ticks, most);
    const double behind = static_cast<double>(newest_) - at_;
    if (behind > wanted + kTooFarBehind_ticks) at_ = static_cast<double>(newest_) - wanted;
    if (behind >= wanted) waits_ = false;
    const double change = std::clamp(kPaceGain * (behind - wanted), -kMostPace, kMostPace);
    pace_ = (1.0 + change) * kTicks_hz / rate_hz_;
}

void TouchSound::advance() noexcept {
    if (waits_) return;
    const auto reached = static_cast<std::int64_t>(std::floor(at_));
    const auto last = static_cast<double>(newest_);
    waits_ = at_ + pace_ > last;
    at_ = std::min(at_ + pace_, last);
    const auto now = static_cast<std::int64_t>(std::floor(at_));
    for (std::int64_t tick = reached + 1; tick <= now; ++tick) reach(heard(tick));
}

void TouchSound::reach(const Heard& tick) noexcept {
    impulse_ += tick.tap;
    burst_ = std::max(burst_, tick.tap);
    const double firmly = std::min(1.0, tick.force_newton / kFirmlyPressed_newton);
    const double speed = tick.speed_mm_per_s;
    scrape_ = firmly * speed / (speed + kHalfScraping_mm_per_s);
    const double centre_hz = std::clamp(speed / choice_.material.grain_mm, kLowestScraping_hz,
                                        kHighestScraping * rate_hz_);
    band_.g = std::tan(kPi * centre_hz / rate_hz_);
}

double TouchSound::next_sample() noexcept {
    advance();
    unheard_s_ += 1.0 / rate_hz_;
    const bool open = force_on_ && unheard_s_ < patience_s_;
    gate_ = std::clamp(gate_ + (open ? 1.0 : -1.0) / (kGate_s * rate_hz_), 0.0, 1.0);
    if (gate_ <= 0.0) {
        be_quiet();
        return 0.0;
    }
    const Heard felt = between(at_ - kLookAhead_ticks);
    if (std::exchange(opens_, false)) rest_ = felt;
    const double firmly = std::clamp(felt.force_newton / kFirmlyPressed_newton, 0.0, 1.0);
    const double rubbing =
        kForceHeard_per_newton * force_.next(felt.force_newton - rest_.force_newton) +
        kHeightHeard_per_mm * firmly * height_.next(felt.height_mm - rest_.height_mm);
    const double texture = kLoudestTexture * std::tanh(rubbing / kLoudestTexture);
    burst_ -= burst_ / (kBurst_s * rate_hz_);
    const double scraping =
        kScrapeHeard * choice_.material.hiss * band_.next((scrape_ + burst_) * noise());
    double ringing = 0.0;
    for (Mode& mode : modes_) ringing += mode.next(impulse_);
    impulse_ = 0.0;
    volume_ += (choice_.volume * choice_.material.loudness - volume_) / (kVolumeFade_s * rate_hz_);
    return gate_ * std::tanh(kGain * volume_ * (texture + scraping + kTapHeard * ringing));
}

/// What rang before the force went off is not heard when it is on again.
void TouchSound::be_quiet() noexcept {
    for (Mode& mode : modes_) mode.y1 = mode.y2 = 0.0;
    force_.be_quiet();
    height_.be_quiet();
    band_.s1 = band_.s2 = 0.0;
    impulse_ = burst_ = scrape_ = 0.0;
    opens_ = true;
    volume_ = choice_.volume * choice_.material.loudness;
}

void TouchSound::tune_modes() noexcept {
    for (std::size_t k = 0; k < kModes; ++k) {
        const double angle = 2.0 * kPi * kRatios[k] * choice_.material.frequency_hz / rate_hz_;
        const double decay_s = choice_.material.decay_s / std::pow(kRatios[k], kFadesFaster);
        const double radius = std::exp(-std::log(1000.0) / (decay_s * rate_hz_));
        Mode& mode = modes_[k];
        mode = angle < 0.9 * kPi
                   ? Mode{kShares[k] * std::sin(angle), 2.0 * radius * std::cos(angle),
                          -radius * radius, mode.y1, mode.y2}
                   : Mode{};
    }
}

const TouchSound::Heard& TouchSound::heard(std::int64_t tick) const noexcept {
    const std::int64_t oldest =
        std::max<std::int64_t>(0, newest_ + 1 - static_cast<std::int64_t>(kHeard));
    const std::int64_t there = std::clamp(tick, oldest, std::max(oldest, newest_));
    return heard_[static_cast<std::size_t>(there) & (kHeard - 1)];
}

TouchSound::Heard TouchSound::between(double place) const noexcept {
    const double whole = std::floor(place);
    const auto& weights =
        weights_[static_cast<std::size_t>(std::lround((place - whole) * double{kPlaces}))];
    const std::int64_t first = static_cast<std::int64_t>(whole) + 1 - std::int64_t{kTaps / 2};
    Heard sum;
    for (std::size_t k = 0; k < kTaps; ++k) {
        const Heard& tick = heard(first + static_cast<std::int64_t>(k));
        sum.force_newton += weights[k] * tick.force_newton;
        sum.height_mm += weights[k] * tick.height_mm;
    }
    return sum;
}

/// Lanczos's: flat up to 400 Hz, and nearly nothing of the ticks' own beat above 600 Hz.
void TouchSound::fill_weights() noexcept {
    constexpr double kHalf = 0.5 * kTaps;
    const auto sinc = [](double x) {
        return std::abs(x) < 1e-9 ? 1.0 : std::sin(kPi * x) / (kPi * x);
    };
    for (std::size_t place = 0; place <= kPlaces; ++place) {
        std::array<double, kTaps>& weights = weights_[place];
        double sum = 0.0;
        for (std::size_t k = 0; k < kTaps; ++k) {
            const double way =
                static_cast<double>(k) + 1.0 - kHalf - static_cast<double>(place) / double{kPlaces};
            weights[k] = std::abs(way) < kHalf ? sinc(way) * sinc(way / kHalf) : 0.0;
            sum += weights[k];
        }
        for (double& weight : weights) weight /= sum;
    }
}

double TouchSound::noise() noexcept {
    random_ ^= random_ << 13U;  // Marsaglia's xorshift
    random_ ^= random_ >> 17U;
    random_ ^= random_ << 5U;
    return static_cast<double>(random_) / 2147483648.0 - 1.0;
}

double TouchSound::Filter::next(double in) noexcept {
    const double out = b0 * in + s1;
    s1 = b1 * in - a1 * out + s2;
    s2 = b2 * in - a2 * out;
    return out;
}

double TouchSound::Mode::next(double in) noexcept {
    const double out = gain * in + a1 * y1 + a2 * y2;
    y2 = y1;
    y1 = out;
    return out;
}

double TouchSound::Band::next(double in) noexcept {
    const double band = (s1 + g * (in - s2)) / (1.0 + g * (kBandDamping + g));
    const double low = s2 + g * band;
    s1 = 2.0 * band - s1;
    s2 = 2.0 * low - s2;
    return kBandDamping * band;
}

/// Butterworth's, by the bilinear transform.
TouchSound::Filter TouchSound::high_pass(double cutoff_hz, double rate_hz) noexcept {
    const double w = std::tan(kPi * cutoff_hz / rate_hz);
    const double scale = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
    return {scale, -2.0 * scale, scale, 2.0 * (w * w - 1.0) * scale,
            (1.0 - std::numbers::sqrt2 * w + w * w) * scale};
}

}  // namespace dibhr
