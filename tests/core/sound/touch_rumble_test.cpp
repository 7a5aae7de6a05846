// Touch in the motors of a game pad: the effect of real haptic ticks, and bounds for any ticks.
#include "core/sound/touch_rumble.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "tests/core/sound/touched_plane.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// A touched plane, and a pad's strengths every ten milliseconds.
struct Rumbling : TouchedPlane {
    explicit Rumbling(double period_px = 0.0, const SoundMaterial& material = {})
        : TouchedPlane(period_px) {
        rumble.choose(material);
    }
    void feel() {
        for (SoundTick felt; ticks.pop(felt);) rumble.add(felt);
        if (++passed % 10 == 0) told.push_back(rumble.after(0.01));
    }
    void pass(int count, Vec3 px_per_s = Vec3{0.0}) {
        TouchedPlane::pass(count, px_per_s, [this] { feel(); });
    }
    void press() {
        TouchedPlane::press([this] { feel(); });
    }
    /// Only strengths after this call are checked.
    void look() { told.clear(); }
    [[nodiscard]] Rumble most() const {
        Rumble most;
        for (const Rumble& now : told) {
            most.low = std::max(most.low, now.low);
            most.high = std::max(most.high, now.high);
        }
        return most;
    }

    TouchRumble rumble{};
    int passed{0};
    std::vector<Rumble> told{};
};

}  // namespace

TEST_CASE("a tap turns the heavy motor within 10 ms, the harder the faster, and it stops again",
          "[sound]") {
    const auto tapped = [](double px_per_s) {
        Rumbling rumbling;
        rumbling.pass(50);
        while (!rumbling.contact()) rumbling.pass(1, {0.0, 0.0, -px_per_s});
        rumbling.look();
        rumbling.pass(10);
        CHECK(rumbling.most().low > 0.1);
        rumbling.pass(50);
        const double low = rumbling.most().low;
        rumbling.pass(1000);
        CHECK(rumbling.told.back() == Rumble{});
        return low;
    };
    CHECK(tapped(2000.0) > 1.3 * tapped(300.0));
}

TEST_CASE("texture turns the light motor, more than the heavy one, the rougher the faster",
          "[sound]") {
    const auto rubbed = [](double roughness_px) {
        Rumbling rumbling(12.0);
        rumbling.bench.handed.parameters.shape.roughness_px = roughness_px;
        rumbling.bench.hand_over();
        rumbling.press();
        rumbling.pass(200, {1600.0, 0.0, 0.0});
        rumbling.look();
        rumbling.pass(500, {1600.0, 0.0, 0.0});
        return rumbling.most();
    };
    const Rumble fine = rubbed(0.5);
    const Rumble rough = rubbed(4.0);
    CHECK(fine.high > 0.05);
    CHECK(rough.high > 1.2 * fine.high);
    CHECK(rough.high > rough.low);
}

TEST_CASE("scraping over what is smooth turns the light motor as the material hisses", "[sound]") {
    const auto scraped = [](const SoundMaterial& material, double px_per_s) {
        Rumbling rumbling(0.0, material);
        rumbling.press();
        rumbling.pass(200, {px_per_s, 0.0, 0.0});
        rumbling.look();
        rumbling.pass(300, {px_per_s, 0.0, 0.0});
        return rumbling.most().high;
    };
    const double slow = scraped({}, 500.0);
    CHECK(slow > 0.0);
    CHECK(scraped({}, 4000.0) > 1.3 * slow);
    CHECK(scraped({.hiss = 1.0}, 500.0) > 1.3 * slow);
    CHECK_THAT(scraped({.loudness = 0.0}, 4000.0), WithinAbs(0.0, 0.0));
}

TEST_CASE("nothing turns in the air, of a hand that lies still, or where no force may act",
          "[sound]") {
    Rumbling rumbling(8.0);
    rumbling.pass(300, {1600.0, 0.0, 0.0});
    CHECK(rumbling.most() == Rumble{});
    rumbling.press();
    rumbling.pass(500);
    rumbling.look();
    rumbling.pass(100);
    CHECK(rumbling.most() == Rumble{});
    Rumbling powerless(8.0);
    powerless.bench.handed.limits.max_force_newton = 0.0;
    powerless.bench.hand_over();
    powerless.press();
    powerless.pass(300, {1600.0, 0.0, 0.0});
    CHECK(powerless.most() == Rumble{});
}

TEST_CASE("both motors stop with the tick whose force is off, and turn again with the force",
          "[sound]") {
    Rumbling rumbling(8.0);
    rumbling.press();
    rumbling.pass(300, {1600.0, 0.0, 0.0});
    CHECK(rumbling.told.back().high > 0.05);
    rumbling.bench.handed.force_enabled = false;
    rumbling.bench.hand_over();
    rumbling.look();
    rumbling.pass(300, {1600.0, 0.0, 0.0});
    CHECK(rumbling.most() == Rumble{});
    rumbling.bench.handed.force_enabled = true;
    rumbling.bench.hand_over();
    rumbling.pass(500, {-1600.0, 0.0, 0.0});
    CHECK(rumbling.told.back().high > 0.05);
}

TEST_CASE("both motors stop 20 ms after the last tick", "[sound]") {
    TouchRumble rumble;
    rumble.add({Vec3{0.0}, 1.0, false, true});
    rumble.add({Vec3{0.0}, 1.0, true, true});
    CHECK(rumble.after(0.01).low > 0.1);
    CHECK(rumble.after(0.01).low > 0.1);
    CHECK(rumble.after(0.01) == Rumble{});
}

TEST_CASE("what rumbles allocates nothing", "[sound]") {
    Rumbling rumbling(8.0);
    rumbling.press();
    rumbling.told.reserve(10'000);
    CHECK(allocations_in([&] { rumbling.pass(300, {1600.0, 0.0, 0.0}); }) == 0);
}

TEST_CASE("whatever ticks and materials come, motors turn between 0 and 1, and stop", "[sound]") {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    std::mt19937 random(11);
    const auto any = [&random] {
        static constexpr double kAny[]{
            0.0,  -1.0, 1.0,        1e-320, 0.3,
            1e3,  1e9,  1e308,      -1e308, kInfinite,
            -0.0, -2.5, -kInfinite, 17.0,   std::numeric_limits<double>::quiet_NaN()};
        return kAny[random() % std::size(kAny)];
    };
    TouchRumble rumble;
    Rumble most;
    for (int k = 0; k < 20'000; ++k) {
        if (k % 70 == 0) rumble.choose({any(), any(), any(), any(), any()});
        rumble.add({{any(), any(), any()}, any(), random() % 3 != 0, random() % 9 != 0});
        const Rumble now = rumble.after(0.001);
        most.low = std::max(most.low, now.low);
        most.high = std::max(most.high, now.high);
        REQUIRE((now.low >= 0.0 && now.low <= 1.0));
        REQUIRE((now.high >= 0.0 && now.high <= 1.0));
    }
    CHECK(most.low > 0.1);
    CHECK(most.high > 0.1);
    rumble.choose({});
    for (int k = 0; k < 1000; ++k) rumble.add({Vec3{0.0}, 0.0, false, true});
    CHECK(rumble.after(0.001) == Rumble{});
}
