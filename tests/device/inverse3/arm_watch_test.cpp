// When an arm's poses may be trusted, and when a service is deaf or slow.
#include "device/inverse3/arm_watch.hpp"

#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::inverse3;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using Obeys = ForceEchoWatch::Obeys;

Arm usable_arm() {
    Arm arm;
    arm.id = DeviceId("049D");
    arm.position_m = Vec3{0.0, -0.15, 0.18};
    arm.calibrated = true;
    return arm;
}

/// States once a millisecond.
struct States {
    ArmWatch watch{};
    ArmWatch::Time now{milliseconds(1000)};
    Arm arm{usable_arm()};

    void come(int count = 1) {
        for (; count > 0; --count) watch.add(arm, now += milliseconds(1));
    }
};

Obeys hears_after(Vec3 sent, const std::optional<Vec3>& told, milliseconds span) {
    ForceEchoWatch hearing;
    for (milliseconds t{0}; t <= span; t += milliseconds(1)) {
        hearing.add(sent, told, ForceEchoWatch::Time(t));
    }
    return hearing.obeys();
}

}  // namespace

TEST_CASE("a pose may be trusted from the second good state in a row", "[inverse3]") {
    States states;
    CHECK(states.watch.epoch() == kNoEpoch);
    states.come();
    CHECK(states.watch.epoch() == kNoEpoch);
    states.come();
    CHECK(states.watch.epoch() != kNoEpoch);
}

TEST_CASE("whatever keeps an arm from touching has its stage, and a new epoch follows it",
          "[inverse3]") {
    States states;
    states.come(5);
    const Epoch before = states.watch.epoch();
    const Arm good = states.arm;
    SECTION("no power") {
        states.arm.powered = false;
        states.come();
        CHECK(states.watch.stage() == Stage::no_power);
    }
    SECTION("not calibrated") {
        states.arm.calibrated = false;
        states.come();
        CHECK(states.watch.stage() == Stage::not_calibrated);
    }
    SECTION("locked") {
        states.arm.locked = true;
        states.come();
        CHECK(states.watch.stage() == Stage::locked);
    }
    SECTION("in use by another program") {
        states.arm.in_use = true;
        states.come();
        CHECK(states.watch.stage() == Stage::in_use);
    }
    SECTION("no position") {
        states.arm.position_m.reset();
        states.come();
        CHECK(states.watch.stage() == Stage::not_understood);
    }
    SECTION("a message without it") {
        states.watch.add_gap();
        CHECK(states.watch.stage() == Stage::ready);  // of the last one that came
    }
    SECTION("exchanged axes") {
        states.arm.config = ArmConfig{.basis = ShortWord("XZY")};
        states.come();
        CHECK(states.watch.stage() == Stage::other_frame);
        states.arm.config = ArmConfig{.basis = ShortWord("XYZ")};
        states.come();
    }
    SECTION("a jump of 3 cm in a millisecond") {
        states.arm.position_m->x += 0.05;
        states.come();
        CHECK(states.watch.jumped());
        CHECK(states.watch.epoch() == kNoEpoch);
        states.come(5);
        CHECK(states.watch.epoch() != before);
        return;
    }
    SECTION("another preset") {
        states.arm.config = ArmConfig{.preset = ShortWord("defaults")};
        states.come(3);
        REQUIRE(states.watch.epoch() == before);
        states.arm.config = ArmConfig{.preset = ShortWord("arm_front")};
        states.come();
    }
    CHECK(states.watch.epoch() == kNoEpoch);
    states.arm.position_m = good.position_m;
    states.arm.powered = states.arm.calibrated = true;
    states.arm.locked = states.arm.in_use = false;
    states.come(5);
    CHECK(states.watch.stage() == Stage::ready);
    CHECK(states.watch.epoch() != kNoEpoch);
    CHECK(states.watch.epoch() != before);
}

TEST_CASE("a hand that rests is no frozen pose, nor one that is stopped and whose speed lags",
          "[inverse3]") {
    States states;
    states.arm.velocity_m_per_s = Vec3{0.009, 0.0, 0.0};
    states.come(1000);
    CHECK(states.watch.stage() == Stage::ready);
    for (double speed = 1.0; speed > 1e-4; speed *= 0.7) {
        states.arm.velocity_m_per_s = Vec3{speed, 0.0, 0.0};
        states.come();
        CHECK(states.watch.stage() == Stage::ready);
    }
}

TEST_CASE("a fast hand is no jump", "[inverse3]") {
    States states;
    states.come(5);
    const Epoch before = states.watch.epoch();
    for (int k = 0; k < 20; ++k) {
        states.arm.position_m->x += 0.003;  // 3 m/s
        states.come();
    }
    CHECK(states.watch.epoch() == before);
}

TEST_CASE("a use that begins as we begin to drive is ours, until it has ended once", "[inverse3]") {
    States states;
    states.come(5);
    states.watch.force_sent(states.now, false);
    states.arm.in_use = true;
    states.come(5);
    CHECK(states.watch.stage() == Stage::ready);
    states.arm.in_use = false;
    states.come(2000);
    states.arm.in_use = true;
    states.come();
    CHECK(states.watch.stage() == Stage::in_use);
}

TEST_CASE("a service that was in use before we drive is another program's", "[inverse3]") {
    States states;
    states.arm.in_use = true;
    states.come(5);
    states.watch.force_sent(states.now, true);
    states.come(5);
    CHECK(states.watch.stage() == Stage::in_use);
}

TEST_CASE("a service that tells back no force is deaf after a quarter of a second", "[inverse3]") {
    CHECK(hears_after({0.0, 0.0, 1.0}, Vec3{0.0}, milliseconds(240)) == Obeys::unknown);
    CHECK(hears_after({0.0, 0.0, 1.0}, Vec3{0.0}, milliseconds(260)) == Obeys::no);
    // A force reduced by the service's filters counts as taken.
    CHECK(hears_after({0.0, 0.0, 1.0}, Vec3{0.0, 0.0, 0.3}, milliseconds(1)) == Obeys::yes);
}

TEST_CASE("of weak forces, and where none is told back, nothing is concluded", "[inverse3]") {
    CHECK(hears_after({0.0, 0.0, 0.1}, Vec3{0.0}, milliseconds(5000)) == Obeys::unknown);
    CHECK(hears_after({0.0, 0.0, 1.0}, std::nullopt, milliseconds(5000)) == Obeys::unknown);
}

TEST_CASE("a service that says in use whenever it is pushed means us, each time", "[inverse3]") {
    States states;
    states.come(5);
    states.watch.force_sent(states.now, false);
    states.come(3000);
    for (int push = 0; push < 3; ++push) {
        states.watch.force_sent(states.now, true);
        states.arm.in_use = true;
        states.come(500);
        CHECK(states.watch.stage() == Stage::ready);
        states.watch.force_sent(states.now, false);
        states.arm.in_use = false;
        states.come(500);
    }
}
