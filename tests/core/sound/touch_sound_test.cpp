// The sound of touch: of real haptic ticks, and bounds for any ticks.
#include "core/sound/touch_sound.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "tests/core/sound/touched_plane.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double kRate_hz = 48'000.0;
constexpr std::size_t kBlock = 256;
constexpr double kBlock_s = kBlock / kRate_hz;
constexpr double kHeard = 1e-4;  // -80 dB

/// Plays ticks in blocks, as a sound device does: one that is filled at some moment is played from
/// that moment on.
class Listener {
  public:
    explicit Listener(const SoundChoice& choice = {}) { sound_.choose(choice); }

    /// What came in a span of time, and the blocks that were filled in it.
    void hear(SoundListener& ticks, double span_s = 0.001) {
        for (SoundTick tick; ticks.pop(tick);) sound_.add(tick);
        now_s_ += span_s;
        while (static_cast<double>(samples.size() + kBlock) <= now_s_ * kRate_hz) {
            samples.resize(samples.size() + kBlock);
            sound_.render(std::span(samples).last(kBlock));
        }
    }

    [[nodiscard]] double now_s() const { return now_s_; }
    /// The time at which a sample is played: a block is filled as a whole.
    [[nodiscard]] static double time_s(std::size_t sample) {
        return static_cast<double>(sample) / kRate_hz + kBlock_s;
    }
    /// The samples that are played between two moments.
    [[nodiscard]] std::span<const float> between(double from_s, double to_s) const {
        const auto index = [this](double t_s) {
            return static_cast<std::size_t>(
                std::clamp((t_s - kBlock_s) * kRate_hz, 0.0, static_cast<double>(samples.size())));
        };
        return std::span(samples).subspan(index(from_s), index(to_s) - index(from_s));
    }

    std::vector<float> samples{};

  private:
    TouchSound sound_{kRate_hz};
    double now_s_{0.0};
};

double loudest(std::span<const float> samples) {
    double most = 0.0;
    for (const float sample : samples) most = std::max(most, double{std::abs(sample)});
    return most;
}

double level(std::span<const float> samples) {
    double sum = 0.0;
    for (const float sample : samples) sum += double{sample} * double{sample};
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, samples.size())));
}

/// The power at a frequency, by Goertzel's algorithm through Hann's window.
double power_at(std::span<const float> samples, double hz) {
    const double pi = std::numbers::pi;
    const double turn = 2.0 * std::cos(2.0 * pi * hz / kRate_hz);
    double s1 = 0.0;
    double s2 = 0.0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const double place = static_cast<double>(k) / static_cast<double>(samples.size());
        const double s0 = samples[k] * (0.5 - 0.5 * std::cos(2.0 * pi * place)) + turn * s1 - s2;
        s2 = std::exchange(s1, s0);
    }
    return s1 * s1 + s2 * s2 - turn * s1 * s2;
}

/// Of the spectrum from 20 Hz on.
double peak_hz(std::span<const float> samples, double highest_hz = 3000.0) {
    double best_hz = 0.0;
    double best = 0.0;
    for (double hz = 20.0; hz < highest_hz; hz *= 1.01) {
        const double power = power_at(samples, hz);
        if (power > best) {
            best = power;
            best_hz = hz;
        }
    }
    return best_hz;
}

/// A touched plane, with a listener of its ticks.
struct Touching : TouchedPlane {
    explicit Touching(double period_px = 0.0, const SoundChoice& choice = {})
        : TouchedPlane(period_px), listener(choice) {}
    void pass(int count, Vec3 px_per_s = Vec3{0.0}) {
        TouchedPlane::pass(count, px_per_s, [this] { listener.hear(ticks); });
    }
    void press() {
        TouchedPlane::press([this] { listener.hear(ticks); });
    }

    Listener listener;
};

}  // namespace

TEST_CASE("a bump every period is heard at speed / period, whatever else is heard", "[sound]") {
    const auto [hiss, period_px, px_per_s] = GENERATE(table<double, double, double>(
        {{0.3, 8.0, 400.0}, {1.0, 8.0, 1600.0}, {0.3, 12.0, 3000.0}, {1.0, 9.0, 3600.0}}));
    CAPTURE(hiss, period_px, px_per_s);
    SoundChoice choice;
    choice.material.hiss = hiss;
    Touching touching(period_px, choice);
    touching.press();
    touching.pass(200, {px_per_s, 0.0, 0.0});
    const double from_s = touching.listener.now_s();
    touching.pass(600, {px_per_s, 0.0, 0.0});
    const auto heard = touching.listener.between(from_s, touching.listener.now_s());
    REQUIRE(level(heard) > 0.01);
    CHECK_THAT(peak_hz(heard), WithinRel(px_per_s / period_px, 0.05));
}

TEST_CASE("scraping over what is smooth is noise, higher and louder the faster it is", "[sound]") {
    const auto scraped = [](double px_per_s) {
        Touching touching;
        touching.press();
        touching.pass(200, {px_per_s, 0.0, 0.0});
        const double from_s = touching.listener.now_s();
        touching.pass(400, {px_per_s, 0.0, 0.0});
        const auto heard = touching.listener.between(from_s, touching.listener.now_s());
        return std::vector<float>(heard.begin(), heard.end());
    };
    const auto slow = scraped(500.0);
    const auto fast = scraped(4000.0);
    CHECK(level(scraped(0.0)) < kHeard);
    CHECK(level(slow) > kHeard);
    CHECK(level(fast) > 1.5 * level(slow));
    const auto high_share = [](const std::vector<float>& heard) {
        double high = 0.0;
        double all = 0.0;
        for (double hz = 100.0; hz < 8000.0; hz *= 1.06) {
            const double power = hz * power_at(heard, hz);
            all += power;
            if (hz > 1000.0) high += power;
        }
        return high / all;
    };
    CHECK(high_share(fast) > high_share(slow) + 0.1);
}

TEST_CASE("a contact is heard within 15 ms, a block of the device's included", "[sound]") {
    const int waited = GENERATE(60, 61, 62, 63, 64);  // the block does not wait for the contact
    Touching touching;
    touching.pass(waited);
    while (!touching.bench.state.front().touch.proxy.contact) touching.pass(1, {0.0, 0.0, -700.0});
    const double contact_s = touching.listener.now_s();
    touching.pass(60);
    const auto& samples = touching.listener.samples;
    const auto first = std::find_if(samples.begin(), samples.end(),
                                    [](float sample) { return std::abs(sample) > kHeard; });
    REQUIRE(first != samples.end());
    const double heard_s =
        Listener::time_s(static_cast<std::size_t>(first - samples.begin())) - contact_s;
    CHECK(heard_s > -0.001);
    CHECK(heard_s < 0.015);
}

TEST_CASE("20 ms after the force is off, and until it is on again, there is silence", "[sound]") {
    Touching touching(8.0);
    touching.press();
    touching.pass(300, {1600.0, 0.0, 0.0});
    const double off_s = touching.listener.now_s();
    REQUIRE(level(touching.listener.between(off_s - 0.1, off_s)) > 0.01);
    touching.bench.handed.force_enabled = false;
    touching.bench.hand_over();
    touching.pass(300, {1600.0, 0.0, 0.0});
    touching.pass(100, {0.0, 0.0, 500.0});
    touching.pass(100, {0.0, 0.0, -500.0});  // a tap that is not felt
    const auto after = touching.listener.between(off_s + 0.02, touching.listener.now_s());
    CHECK(after.size() > 20'000);
    CHECK_THAT(loudest(after), WithinAbs(0.0, 0.0));
    touching.bench.handed.force_enabled = true;
    touching.bench.hand_over();
    touching.pass(700, {-1600.0, 0.0, 0.0});
    const double now_s = touching.listener.now_s();
    CHECK(level(touching.listener.between(now_s - 0.1, now_s)) > 0.01);
}

TEST_CASE("where no force may act nothing is heard, nor in the air, nor of a hand that lies still",
          "[sound]") {
    Touching powerless;
    powerless.bench.handed.limits.max_force_newton = 0.0;
    powerless.bench.hand_over();
    powerless.press();
    CHECK_THAT(loudest(powerless.listener.samples), WithinAbs(0.0, 0.0));
    Touching touching(8.0);
    touching.pass(300, {1600.0, 0.0, 0.0});
    CHECK_THAT(loudest(touching.listener.samples), WithinAbs(0.0, 0.0));
    touching.press();
    touching.pass(500);
    const double now_s = touching.listener.now_s();
    CHECK(loudest(touching.listener.between(now_s - 0.1, now_s)) < kHeard);
}

TEST_CASE("a tap rings at its material's frequency, as long as that does, the louder the faster",
          "[sound]") {
    const auto tapped = [](const SoundMaterial& material, double px_per_s) {
        Touching touching(0.0, {material, 0.5});
        touching.pass(50);
        while (!touching.bench.state.front().touch.proxy.contact)
            touching.pass(1, {0.0, 0.0, -px_per_s});
        const double contact_s = touching.listener.now_s();
        touching.pass(300);
        const auto heard = touching.listener.between(contact_s, contact_s + 0.3);
        return std::vector<float>(heard.begin(), heard.end());
    };
    const auto lasts_s = [](const std::vector<float>& heard) {
        const double least = 0.01 * loudest(heard);
        const auto last = std::find_if(heard.rbegin(), heard.rend(),
                                       [=](float sample) { return std::abs(sample) > least; });
        return static_cast<double>(heard.rend() - last) / kRate_hz;
    };
    const SoundMaterial wood{.frequency_hz = 750.0, .decay_s = 0.1};
    const SoundMaterial stone{.frequency_hz = 1900.0, .decay_s = 0.3};
    CHECK_THAT(peak_hz(tapped(wood, 1500.0)), WithinRel(750.0, 0.05));
    CHECK_THAT(peak_hz(tapped(stone, 1500.0)), WithinRel(1900.0, 0.05));
    CHECK(lasts_s(tapped(stone, 1500.0)) > 2.0 * lasts_s(tapped(wood, 1500.0)));
    CHECK(loudest(tapped(wood, 1500.0)) > 1.5 * loudest(tapped(wood, 300.0)));
}

TEST_CASE("letting go is heard, more quietly than a tap", "[sound]") {
    Touching touching;
    touching.press();
    const double pressed_s = touching.listener.now_s();
    touching.pass(100, {0.0, 0.0, 700.0});
    const double tap = loudest(touching.listener.between(0.0, 0.2));
    const double release = loudest(touching.listener.between(pressed_s, touching.listener.now_s()));
    CHECK(release > kHeard);
    CHECK(release < tap);
}

TEST_CASE("loudness and volume are what they say, and 0 is silence", "[sound]") {
    const auto heard = [](double loudness, double volume) {
        SoundMaterial material;
        material.loudness = loudness;
        Touching touching(8.0, {material, volume});
        touching.press();
        touching.pass(200, {1600.0, 0.0, 0.0});
        return level(touching.listener.samples);
    };
    CHECK_THAT(heard(0.0, 1.0), WithinAbs(0.0, 0.0));
    CHECK_THAT(heard(1.0, 0.0), WithinAbs(0.0, 0.0));
    CHECK(heard(0.5, 0.5) > heard(0.25, 0.5));
    CHECK(heard(0.5, 1.0) > heard(0.5, 0.5));
}

TEST_CASE("neither a tick that is heard nor its sound allocates, also when nobody listens",
          "[sound]") {
    Touching touching(8.0);
    touching.press();
    touching.listener.samples.reserve(100'000);
    CHECK(allocations_in([&] { touching.pass(300, {1600.0, 0.0, 0.0}); }) == 0);
    CHECK(allocations_in([&] { run_ticks(touching.tick, 2000); }) == 0);
    touching.pass(1);
    CHECK(touching.ticks.missed() > 0);
}

TEST_CASE("whatever ticks, materials and blocks come, samples are in [-1, 1]", "[sound]") {
    const double rate_hz =
        GENERATE(8000.0, 44'100.0, 192'000.0, 0.0, std::numeric_limits<double>::quiet_NaN());
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    std::mt19937 random(7);
    const auto any = [&random] {
        static constexpr double kAny[]{
            0.0,    -1.0,       1.0,  1e-320,
            0.3,    1e3,        1e9,  1e308,
            -1e308, kInfinite,  -0.0, -2.5,
            1e-5,   -kInfinite, 17.0, std::numeric_limits<double>::quiet_NaN()};
        return kAny[random() % std::size(kAny)];
    };
    TouchSound sound(rate_hz);
    std::vector<float> block(5000);
    double most = 0.0;
    bool finite = true;
    for (int k = 0; k < 400; ++k) {
        if (k % 7 == 0) sound.choose({{any(), any(), any(), any(), any()}, any()});
        if (k % 50 == 0) sound.choose({{.loudness = 1.0, .hiss = 1.0}, 1.0});
        for (std::size_t ticks = random() % 40; ticks > 0; --ticks)
            sound.add({{any(), any(), any()}, any(), random() % 3 != 0, random() % 9 != 0});
        const auto heard = std::span(block).first(random() % (k % 10 == 0 ? 5000 : 600));
        sound.render(heard);
        most = std::max(most, loudest(heard));
        finite = finite && std::all_of(heard.begin(), heard.end(),
                                       [](float sample) { return std::isfinite(sample); });
    }
    CHECK(finite);
    CHECK(most <= 1.0);
    CHECK(most > 0.01);
    // And nothing of it lasts.
    sound.choose({});
    for (int k = 0; k < 100; ++k) {
        sound.add({Vec3{0.0}, 0.0, false, true});
        sound.render(std::span(block).first(kBlock));
    }
    CHECK(loudest(std::span(block).first(kBlock)) < 0.01);
}

TEST_CASE("the same ticks sound the same, bit for bit", "[sound]") {
    const auto heard = [] {
        Touching touching(8.0);
        touching.press();
        touching.pass(300, {1600.0, 0.0, 0.0});
        return touching.listener.samples;
    };
    const bool same = heard() == heard();
    CHECK(same);
}

TEST_CASE("a device whose clock goes otherwise is neither late nor without sound", "[sound]") {
    const double drift = GENERATE(0.998, 1.0, 1.002);
    CAPTURE(drift);
    const auto ring = std::make_unique<SoundRing>();
    SoundListener ticks(*ring);
    Listener listener;
    const auto tick = [](bool contact) {
        return SoundTick{{0.0, 0.0, contact ? 0.0 : 5.0}, contact ? 1.0 : 0.0, contact, true};
    };
    for (int k = 0; k < 20'000; ++k) {  // by then the clocks are 40 ms apart
        ring->push(tick(false));
        listener.hear(ticks, 0.001 * drift);
    }
    const double contact_s = listener.now_s();
    for (int k = 0; k < 60; ++k) {
        ring->push(tick(true));
        listener.hear(ticks, 0.001 * drift);
    }
    CHECK(loudest(listener.between(contact_s - 1.0, contact_s - 0.001)) < kHeard);
    CHECK(loudest(listener.between(contact_s, contact_s + 0.016)) > kHeard);
}

TEST_CASE("when ticks stay away the sound fades, and comes back with them", "[sound]") {
    Touching touching(8.0);
    touching.press();
    touching.pass(300, {1600.0, 0.0, 0.0});
    const auto silent = std::make_unique<SoundRing>();
    SoundListener none(*silent);
    const double stopped_s = touching.listener.now_s();
    for (int k = 0; k < 200; ++k) touching.listener.hear(none);
    const double back_s = touching.listener.now_s();
    CHECK_THAT(loudest(touching.listener.between(stopped_s + 0.05, back_s)), WithinAbs(0.0, 0.0));
    touching.pass(300, {1600.0, 0.0, 0.0});
    CHECK(level(touching.listener.between(back_s + 0.05, touching.listener.now_s())) > 0.01);
}
