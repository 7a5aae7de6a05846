// Parameters that change in contact.
#include "core/haptics/parameter_glide.hpp"

#include <cmath>

#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

using Values = ParameterGlide::Values;

constexpr double kTick_s = 0.001;

Values random_values(test::Dice& dice) {
    Values values;
    for (const TouchNumber& number : touch_numbers()) {
        number.in(values.parameters) = dice.uniform(number.lowest, number.highest);
    }
    keep_in_range(values.parameters);
    values.limits.max_force_newton = dice.uniform(0.0, 8.0);
    return values;
}

}  // namespace

TEST_CASE("every number goes straight to where it is to be, in a tenth of a second", "[glide]") {
    test::Dice dice(31);
    for (int n = 0; n < 50; ++n) {
        ParameterGlide glide;
        Values from = random_values(dice);
        Values to = random_values(dice);
        to.parameters.coupling.pixel_pitch_mm = from.parameters.coupling.pixel_pitch_mm;
        to.parameters.coupling.damping_cutoff_hz = from.parameters.coupling.damping_cutoff_hz;
        to.parameters.shape.bump_size_px = from.parameters.shape.bump_size_px;
        CHECK(glide.towards(from, kTick_s, false) == from);  // nothing was felt before
        for (int k = 1; k < 100; ++k) {
            Values now = glide.towards(to, kTick_s, false);
            for (const TouchNumber& number : touch_numbers()) {
                CAPTURE(n, k, number.name);
                const double begin = number.in(from.parameters);
                const double way = number.in(to.parameters) - begin;
                CHECK_THAT(number.in(now.parameters), WithinAbs(begin + 0.01 * k * way, 1e-9));
            }
            const Friction& friction = now.parameters.friction;
            CHECK(friction.dynamic_coefficient <= friction.static_coefficient + 1e-12);
        }
        static_cast<void>(glide.towards(to, kTick_s, false));
        CHECK(glide.towards(to, kTick_s, false) == to);
    }
}

TEST_CASE("a slider that is dragged takes the numbers along without a step", "[glide]") {
    ParameterGlide glide;
    Values target;
    double stiffness =
        glide.towards(target, kTick_s, true).parameters.coupling.stiffness_newton_per_mm;
    for (int k = 0; k < 1000; ++k) {
        double& wanted = target.parameters.coupling.stiffness_newton_per_mm;
        if (k % 17 == 0) wanted = k % 2 == 0 ? 1.0 : 0.1;  // from end to end at 60 Hz
        const double now =
            glide.towards(target, kTick_s, false).parameters.coupling.stiffness_newton_per_mm;
        CHECK(std::abs(now - stiffness) <= 0.0091);
        stiffness = now;
    }
}

TEST_CASE("where the force begins from zero, and for what is no force, there is no way",
          "[glide]") {
    ParameterGlide glide;
    Values target;
    static_cast<void>(glide.towards(target, kTick_s, true));
    target.parameters.shape.relief_px = 10.0;
    CHECK(glide.towards(target, kTick_s, true) == target);
    target.parameters.shape.relief_px = 20.0;
    target.parameters.algorithm = Algorithm::pga;
    target.parameters.coupling.pixel_pitch_mm = 1.0;
    target.parameters.shape.bump_size_px = 64.0;
    target.parameters.coupling.damping_cutoff_hz = 50.0;
    target.limits.ramp_s = 2.0;
    const Values& now = glide.towards(target, kTick_s, false);
    CHECK(now.parameters.algorithm == Algorithm::pga);
    CHECK(now.parameters.coupling.pixel_pitch_mm == 1.0);
    CHECK(now.parameters.shape.bump_size_px == 64.0);
    CHECK(now.parameters.coupling.damping_cutoff_hz == 50.0);
    CHECK(now.limits.ramp_s == 2.0);
    CHECK(now.parameters.shape.relief_px < 11.0);
    CHECK(now == glide.now());
}
