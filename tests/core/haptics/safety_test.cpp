// The safety stage and the coupling: which force may reach a hand.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

/// A stage whose ramp is over and whose last force was `force`.
SafetyStage warmed_up(Vec3 force, const SafetyLimits& limits) {
    SafetyStage stage;
    for (int k = 0; k < 2000; ++k) static_cast<void>(stage.limit(force, {}, limits));
    return stage;
}

struct Reason {
    SafetyCut cut;
    void (*apply)(SafetyInput&, Vec3&);
};

/// Sends zero force.
const std::vector<Reason>& reasons_to_cut() {
    static const std::vector<Reason> reasons{
        {SafetyCut::off, [](SafetyInput& input, Vec3&) { input.force_enabled = false; }},
        {SafetyCut::device_not_ready,
         [](SafetyInput& input, Vec3&) { input.device_ready = false; }},
        {SafetyCut::late_tick, [](SafetyInput& input, Vec3&) { input.dt_s = 0.021; }},
        {SafetyCut::goal_jump,
         [](SafetyInput& input, Vec3&) { input.goal_step_mm = 1e4 * input.dt_s + 0.1; }},
        {SafetyCut::not_finite, [](SafetyInput&, Vec3& force) { force.x = std::nan(""); }},
    };
    return reasons;
}

}  // namespace

TEST_CASE("no force longer than the limit is ever sent, and none that is not finite", "[safety]") {
    const SafetyLimits limits;
    SafetyStage stage;
    test::Dice dice(41);
    const double odd[] = {0.0,
                          1e308,
                          -1e308,
                          std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::quiet_NaN(),
                          5e-324};
    for (int k = 0; k < 20000; ++k) {
        Vec3 force(dice.uniform(-20.0, 20.0), dice.uniform(-20.0, 20.0), dice.uniform(-20.0, 20.0));
        if (k % 7 == 0) force[k % 3] = odd[(k / 7) % 6];
        SafetyInput input;
        input.dt_s = k % 11 == 0 ? dice.uniform(-0.01, 0.05) : 0.001;
        const Vec3 sent = stage.limit(force, input, limits);
        REQUIRE(is_finite(sent));
        REQUIRE(glm::length(sent) <= limits.max_force_newton * (1.0 + 1e-12));
    }
}

TEST_CASE("the sent force changes by no more than the limit per millisecond, except to zero",
          "[safety]") {
    const SafetyLimits limits;
    SafetyStage stage;
    test::Dice dice(43);
    Vec3 last(0.0);
    int cuts_of_force = 0;  // by more than the limit
    for (int k = 0; k < 20000; ++k) {
        Vec3 force(dice.uniform(-9.0, 9.0), dice.uniform(-9.0, 9.0), dice.uniform(-9.0, 9.0));
        SafetyInput input;
        input.dt_s = dice.uniform(0.0001, 0.010);
        // Long enough between two of them for the force to come back.
        const bool cut = dice.uniform(0.0, 1.0) < 0.005;
        if (cut) {
            const auto& reasons = reasons_to_cut();
            const double any = dice.uniform(0.0, static_cast<double>(reasons.size()));
            reasons[static_cast<std::size_t>(any)].apply(input, force);
        }
        const Vec3 sent = stage.limit(force, input, limits);
        const double most_newton =
            limits.max_change_newton_per_ms * std::min(1e3 * input.dt_s, 3.0) + 1e-12;
        CAPTURE(k, cut, input.dt_s);
        if (cut) {
            REQUIRE(sent == Vec3(0.0));
            cuts_of_force += glm::length(last) > most_newton ? 1 : 0;
        } else {
            REQUIRE(glm::length(sent - last) <= most_newton);
        }
        last = sent;
    }
    CHECK(cuts_of_force > 20);
}

TEST_CASE("a late tick earns neither a larger step of the force nor a longer way of the goal",
          "[safety]") {
    const SafetyLimits limits;
    SafetyInput input;
    input.dt_s = 0.015;
    SafetyStage stage = warmed_up(Vec3(0.0), limits);
    CHECK(glm::length(stage.limit({0.0, 0.0, 4.0}, input, limits)) <=
          3.0 * limits.max_change_newton_per_ms + 1e-12);
    input.goal_step_mm = 31.0;
    CHECK(stage.limit({0.0, 0.0, 4.0}, input, limits) == Vec3(0.0));
    CHECK(stage.last_cut() == SafetyCut::goal_jump);
}

TEST_CASE("a force within all limits passes unchanged", "[safety]") {
    const SafetyLimits limits;
    SafetyStage stage = warmed_up({1.0, 0.0, 2.0}, limits);
    CHECK(stage.limit({1.1, 0.0, 2.1}, {}, limits) == Vec3(1.1, 0.0, 2.1));
    CHECK(stage.last_cut() == SafetyCut::none);
}

TEST_CASE("a force that is too long keeps its direction", "[safety]") {
    const SafetyLimits limits;
    const Vec3 force(30.0, -40.0, 120.0);
    SafetyStage stage = warmed_up(force, limits);
    const Vec3 sent = stage.limit(force, {}, limits);
    CHECK_THAT(glm::length(sent), WithinAbs(limits.max_force_newton, 1e-9));
    CHECK_THAT(glm::length(glm::cross(sent, force)), WithinAbs(0.0, 1e-6));
}

TEST_CASE("a force from zero is zero at once, and the force ramps up from there", "[safety]") {
    const SafetyLimits limits;
    const Vec3 force(0.0, 0.0, 2.0);
    SafetyStage stage = warmed_up(force, limits);
    SafetyInput again;
    again.from_zero = true;
    double last = stage.limit(force, again, limits).z;
    CHECK_THAT(last, WithinAbs(0.0, 1e-12));
    for (int k = 1; k <= 500; ++k) {
        const double now = stage.limit(force, {}, limits).z;
        REQUIRE(now >= last);
        REQUIRE(now <= 2.0 * (k + 0.5) / 500.0);
        last = now;
    }
    CHECK_THAT(last, WithinAbs(2.0, 1e-9));
}

TEST_CASE("each reason to stop sends zero at once, says why, and ramps up again", "[safety]") {
    const Reason reason = GENERATE(from_range(reasons_to_cut()));
    const SafetyLimits limits;
    const Vec3 force(0.0, 0.0, 2.0);
    SafetyStage stage = warmed_up(force, limits);
    SafetyInput input;
    Vec3 asked = force;
    reason.apply(input, asked);
    CHECK(stage.limit(asked, input, limits) == Vec3(0.0));
    CHECK(stage.last_cut() == reason.cut);
    CHECK(std::string(name_of(reason.cut)) != "");
    CHECK(glm::length(stage.limit(force, {}, limits)) <= 2.0 * 0.001 / limits.ramp_s + 1e-12);
}

TEST_CASE(
    "at a standstill the force goes straight to zero in 40 ms, also where its change is limited",
    "[safety]") {
    SafetyLimits limits;
    limits.max_change_newton_per_ms = GENERATE(0.5, 0.01);
    const Vec3 force(1.2, -1.0, 3.4);
    SafetyStage stage = warmed_up(force, limits);
    SafetyInput input;
    input.standstill = true;
    for (int k = 1; k <= 60; ++k) {
        CAPTURE(k);
        const Vec3 sent = stage.limit(force, input, limits);
        CHECK_THAT(glm::distance(sent, force * std::max(0.0, 1.0 - k / 40.0)),
                   WithinAbs(0.0, 1e-9));
        CHECK(stage.last_cut() == SafetyCut::standstill);
    }
    CHECK(glm::length(stage.limit(force, {}, limits)) <= 4.0 * 0.001 / limits.ramp_s + 1e-12);
}

TEST_CASE("a force that was cut at a standstill stays off until that is over", "[safety]") {
    const SafetyLimits limits;
    SafetyStage stage = warmed_up({0.0, 0.0, 3.0}, limits);
    SafetyInput input;
    input.standstill = true;
    CHECK(stage.limit({0.0, 0.0, 3.0}, input, limits).z > 2.5);
    stage.drop_to_zero();  // as without a surface
    CHECK(stage.limit({0.0, 0.0, 3.0}, input, limits) == Vec3(0.0));
    CHECK(stage.limit({0.0, 0.0, 3.0}, input, limits) == Vec3(0.0));
}

TEST_CASE("every reason to stop has a name of its own, up to the last", "[safety]") {
    std::set<std::string> names;
    constexpr auto kLast = static_cast<std::size_t>(kLastSafetyCut);
    for (std::size_t k = 0; k <= kLast; ++k) names.insert(name_of(static_cast<SafetyCut>(k)));
    CHECK(names.size() == kLast + 1);
    CHECK(std::string(name_of(static_cast<SafetyCut>(kLast + 1))) == name_of(SafetyCut::none));
}

TEST_CASE("the spring force is stiffness times the way from goal to proxy, in millimetres",
          "[coupling]") {
    Proxy proxy;
    proxy.contact = true;
    proxy.position = {10.0, 20.0, 100.0};
    Coupling coupling;
    coupling.stiffness_newton_per_mm = 0.7;
    coupling.pixel_pitch_mm = 0.2;
    CHECK_THAT(coupling_force(proxy, {10.0, 20.0, 90.0}, Vec3(0.0), coupling).z,
               WithinAbs(1.4, 1e-12));
    coupling.damping_newton_s_per_m = 5.0;
    const Vec3 damped = coupling_force(proxy, {10.0, 20.0, 90.0}, {100.0, 0.0, 0.0}, coupling);
    CHECK_THAT(damped.x, WithinAbs(-5.0 * 0.02, 1e-12));  // 100 px/s = 20 mm/s
    proxy.contact = false;
    CHECK(coupling_force(proxy, {10.0, 20.0, 90.0}, {100.0, 0.0, 0.0}, coupling) == Vec3(0.0));
}

TEST_CASE("a goal that is not a number is refused: the last state stands and the force is zero",
          "[touch]") {
    const DepthImage image = test::flat(40, 40, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    TouchRenderer renderer;
    for (int k = 0; k < 600; ++k) renderer.update(surface, {20.0, 20.0, 90.0}, {}, {}, {});
    const Touch before = renderer.update(surface, {20.0, 20.0, 90.0}, {}, {}, {});
    REQUIRE(glm::length(before.sent_force_newton) > 0.1);
    const Touch refused = renderer.update(surface, {20.0, std::nan(""), 90.0}, {}, {}, {});
    CHECK(refused.goal == before.goal);
    CHECK(refused.proxy.position == before.proxy.position);
    CHECK(refused.spring_force_newton == Vec3(0.0));
    CHECK(refused.sent_force_newton == Vec3(0.0));
    CHECK(refused.cut == SafetyCut::not_finite);
    CHECK(is_finite(renderer.update(surface, {20.5, 20.0, 90.0}, {}, {}, {}).proxy.position));
}

TEST_CASE("starting inside the surface, the force fades in", "[touch]") {
    const DepthImage image = test::flat(40, 40, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    TouchRenderer renderer;
    const Touch first = renderer.update(surface, {20.0, 20.0, 50.0}, {}, {}, {});
    CHECK(first.proxy.contact);
    CHECK(first.sent_force_newton == Vec3(0.0));
    const Touch second = renderer.update(surface, {20.0, 20.0, 50.0}, {}, {}, {});
    CHECK(glm::length(second.sent_force_newton) <= 4.0 * 0.002);
}
