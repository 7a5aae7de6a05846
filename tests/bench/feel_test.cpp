// Whether the measures of how a recording feels are right for simple surfaces.
#include "tests/bench/feel.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/listed_media.hpp"
#include "tests/support/pressing_finger.hpp"

namespace dibhr::bench {

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr int kColumns = 120;
constexpr int kRows = 40;
constexpr double kHighest = 255.0;  // a level is a pixel
constexpr double kFrame_s = 1.0 / 30.0;
constexpr int kFrames = 120;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kPress_newton = 0.5 * kPaperPitch_mm * test::kPressed_px;

using Level = std::function<double(int frame, int i, int j)>;

Feel feel(const Level& level, const FeelOptions& options = {}) {
    std::vector<DepthImage> frames;
    for (int k = 0; k < kFrames; ++k)
        frames.push_back(
            image_of(kColumns, kRows, kHighest, [&](int i, int j) { return level(k, i, j); }));
    return feel_of(std::make_unique<test::ListedMedia>(std::move(frames), kFrame_s), options);
}

/// Without cleaning, so that the measures show what the scene does.
const FeelOptions kRaw{.cleaning = {.preset = CleaningPreset::raw}};

double lost_share(const FeelNumbers& numbers, Cause cause) {
    return 1e-3 * static_cast<double>(numbers.lost[cause]) / numbers.seconds;
}

/// Whether all lost contact has this cause, and equals the missing contact.
bool all_lost_to(Cause cause, const FeelNumbers& numbers) {
    const double missed = 1.0 - numbers.contact;
    return missed > 0.0 && std::fabs(lost_share(numbers, cause) - missed) < 1e-9;
}

/// A share of pixels, each at another time.
bool chosen(int i, int j, int frame, int period) {
    return (i * 7 + j * 13 + frame) % period == 0;
}

}  // namespace

TEST_CASE("a flat plane is always in contact, without buzz, steps or sticking", "[feel][long]") {
    const Feel flat = feel([](int, int, int) { return 100.0; });
    for (const Way way : {Way::rest_quiet, Way::rest_anywhere}) {
        CHECK(flat[way].contact == 1.0);
        CHECK(flat[way].buzz_newton < 1e-9);
        CHECK(flat[way].step_p999 < 1e-9);
        CHECK(flat[way].seconds > 12 * 2.9);
        for (const Cause cause : kCauses) CHECK(flat[way].lost[cause] == 0);
    }
    CHECK(flat[Way::slide].contact == 1.0);
    CHECK(flat[Way::slide].stuck == 0.0);
    CHECK(flat[Way::slide].step_p99 < 1e-3 * kPress_newton);
    CHECK(flat[Way::slide].seconds > 12 * 1.0);
}

TEST_CASE("a plane that drops by 100 px moved: contact is lost until the hand has followed",
          "[feel][long]") {
    const Feel dropping = feel([](int frame, int, int) { return frame < 50 ? 150.0 : 50.0; });
    const FeelNumbers& rest = dropping[Way::rest_anywhere];
    CHECK(all_lost_to(Cause::moved, rest));
    // The hand is 12 px above it after 250 ms times the logarithm of 100 / 12. Half of the
    // fingers begin too late to feel that.
    const double lost_s = 0.25 * std::log(100.0 / 12.0);
    CHECK_THAT((1.0 - rest.contact) * 3.0, WithinAbs(lost_s, 0.05));
}

TEST_CASE("what falls and comes back is flicker, of a pixel or of all around it", "[feel][long]") {
    const Feel sparkling =
        feel([](int frame, int i, int j) { return chosen(i, j, frame, 20) ? 20.0 : 150.0; }, kRaw);
    CHECK(all_lost_to(Cause::flicker, sparkling[Way::rest_anywhere]));
    const Feel blinking = feel([](int frame, int, int) { return frame % 20 < 2 ? 20.0 : 150.0; });
    CHECK(all_lost_to(Cause::flicker_wide, blinking[Way::rest_anywhere]));
}

TEST_CASE("what falls where there is no data is a hole", "[feel][long]") {
    const Level holed = [](int frame, int i, int j) {
        return chosen(i, j, frame, 20) ? kNone : 150.0;
    };
    CHECK(all_lost_to(Cause::hole, feel(holed, kRaw)[Way::rest_anywhere]));
    CHECK(feel(holed)[Way::rest_anywhere].contact == 1.0);
}

TEST_CASE("what had data and has none any more is gone", "[feel][long]") {
    const Feel leaving = feel([](int frame, int, int) { return frame < 50 ? 150.0 : kNone; }, kRaw);
    CHECK(all_lost_to(Cause::gone, leaving[Way::rest_anywhere]));
}

TEST_CASE("what is made up beside data that moves was never seen", "[feel][long]") {
    const Feel beside = feel(
        [](int frame, int i, int) {
            if (i % 10 < 5) return kNone;
            return frame % 40 < 20 ? 200.0 : 20.0;
        },
        {.spots = 24});
    const FeelNumbers& rest = beside[Way::rest_anywhere];
    CHECK(rest.lost[Cause::unseen] > 0);
    CHECK(rest.lost[Cause::moved] > 0);
    const double lost = lost_share(rest, Cause::unseen) + lost_share(rest, Cause::moved);
    CHECK_THAT(lost, WithinAbs(1.0 - rest.contact, 1e-9));
}

TEST_CASE("what cleaning takes away is told from holes", "[feel][long]") {
    // Pixels that stand still while all around them fall now and then, and so are spikes there.
    const Level blinking = [](int frame, int i, int j) {
        return frame % 20 < 2 && (i % 3 != 0 || j % 3 != 0) ? 20.0 : 150.0;
    };
    FeelOptions options{.cleaning = {.preset = CleaningPreset::gentle}, .spots = 60};
    CHECK(feel(blinking, options)[Way::rest_anywhere].lost[Cause::cleaning] > 0);
    options.cleaning = kRaw.cleaning;
    CHECK(feel(blinking, options)[Way::rest_anywhere].lost[Cause::cleaning] == 0);
}

TEST_CASE("buzz is what is above 30 Hz, and steps are those of the force", "[feel][long]") {
    // A surface that rises and falls by 1 px, by turns a frame: a triangle of 15 Hz.
    const Feel quick = feel([](int frame, int, int) { return 100.0 + frame % 2; }, kRaw);
    const FeelNumbers& rest = quick[Way::rest_anywhere];
    const double newton_per_px = kPress_newton / test::kPressed_px;
    CHECK(rest.contact == 1.0);
    CHECK_THAT(rest.step_p99, WithinRel(newton_per_px * test::kFingerTick_s / kFrame_s, 0.1));
    double square_newton = 0.0;
    for (const double harmonic : {1.0, 3.0, 5.0, 7.0}) {
        const double passed = 1.0 / std::sqrt(1.0 + std::pow(30.0 / (15.0 * harmonic), 4.0));
        const double amplitude_newton =
            newton_per_px * 4.0 / std::pow(std::numbers::pi * harmonic, 2.0) * passed;
        square_newton += amplitude_newton * amplitude_newton / 2.0;
    }
    CHECK_THAT(rest.buzz_newton, WithinRel(std::sqrt(square_newton), 0.05));
}

TEST_CASE("a finger that slides sticks where the surface is rough", "[feel][long]") {
    const Feel rough =
        feel([](int, int i, int j) { return 100.0 + ((i * 7919 + j * 104729) % 97) % 15; }, kRaw);
    REQUIRE(rough[Way::slide].seconds > 0.0);
    CHECK(rough[Way::slide].stuck > 0.2);
    CHECK(rough[Way::slide].step_p99 > 0.05);
}

TEST_CASE("slides on smooth ground and near cliffs are told apart, and add up", "[feel][long]") {
    // A wall one pixel thin that stands up after a while, on ground that is smooth beside it.
    const Feel walled =
        feel([](int frame, int i, int) { return frame > 45 && i == kColumns / 2 ? 140.0 : 100.0; },
             kRaw);
    const Feel plane = feel([](int, int, int) { return 100.0; }, kRaw);
    CHECK(plane.slide_cliffs.seconds == 0.0);
    CHECK(plane.slide_smooth.seconds == plane[Way::slide].seconds);
    CHECK(walled.slide_cliffs.seconds > 0.0);
    CHECK(walled.slide_smooth.stuck == 0.0);
    CHECK(walled.slide_cliffs.stuck > 0.0);
    CHECK(walled.slide_smooth.buzz_newton < walled[Way::slide].buzz_newton);
    CHECK(walled.slide_smooth.step_p99 < walled.slide_cliffs.step_p99);
    CHECK_THAT(walled.slide_smooth.seconds + walled.slide_cliffs.seconds,
               WithinAbs(walled[Way::slide].seconds, 1e-9));
}

TEST_CASE("a cliff is a slope above 3 within 6 px", "[feel]") {
    const auto near = [](double slope, Vec2 place) {
        const DepthImage ramp = image_of(kColumns, kRows, kHighest, [&](int i, int) {
            return i <= 60 ? 100.0 : 100.0 + slope;  // of one cell, in columns 60 to 61
        });
        return is_near_cliff(DepthSurface(ramp, ramp, 0.0, {.relief_px = kHighest}), place);
    };
    CHECK(near(3.1, Vec2(60.5, 20.5)));
    CHECK_FALSE(near(2.9, Vec2(60.5, 20.5)));
    CHECK(near(3.1, Vec2(54.6, 20.5)));
    CHECK_FALSE(near(3.1, Vec2(54.4, 20.5)));
    CHECK(near(3.1, Vec2(66.4, 20.5)));
    CHECK_FALSE(near(3.1, Vec2(66.6, 20.5)));
    CHECK_FALSE(near(3.1, Vec2(0.0, 0.0)));  // at the picture's rim
    CHECK_FALSE(near(3.1, Vec2(kColumns - 1, kRows - 1)));
}

TEST_CASE("contact beside holes leaves out the time without data", "[feel][long]") {
    const Feel holed =
        feel([](int frame, int i, int j) { return chosen(i, j, frame, 20) ? kNone : 150.0; }, kRaw);
    CHECK(holed[Way::rest_anywhere].contact < 1.0);
    CHECK_THAT(contact_beside_holes(holed[Way::rest_anywhere]), WithinAbs(1.0, 1e-3));
    const Feel dropping = feel([](int frame, int, int) { return frame < 50 ? 150.0 : 50.0; });
    CHECK(contact_beside_holes(dropping[Way::rest_anywhere]) ==
          dropping[Way::rest_anywhere].contact);
}

TEST_CASE("the quieter half changes less than anywhere", "[feel][long]") {
    const Feel half = feel(
        [](int frame, int i, int) { return i < kColumns / 2 ? 100.0 : 100.0 + 30.0 * (frame % 2); },
        kRaw);
    CHECK(half[Way::rest_quiet].buzz_newton < 1e-9);
    CHECK(half[Way::rest_anywhere].buzz_newton > 0.05);
}

TEST_CASE("the same seed gives the same numbers", "[feel][long]") {
    const Level sparkling = [](int frame, int i, int j) {
        return chosen(i, j, frame, 20) ? 20.0 : 150.0;
    };
    const Feel one = feel(sparkling, kRaw);
    const Feel again = feel(sparkling, kRaw);
    for (const Way way : kWays) {
        CHECK(one[way].buzz_newton == again[way].buzz_newton);
        CHECK(one[way].contact == again[way].contact);
    }
}

}  // namespace dibhr::bench
