// The watch over an arm's samples, without clock or library.
#include "device/openhaptics/arm_watch.hpp"

#include <cmath>

#include "device/openhaptics/faults.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::openhaptics;
using std::chrono::milliseconds;

ArmSample good() {
    ArmSample sample;
    sample.calibration = kHdCalibrated;
    sample.may_output = true;
    return sample;
}

struct Watched {
    ArmWatch watch{};
    ArmWatch::Time now{};

    void add(const ArmSample& sample, int times = 1, milliseconds step = milliseconds(1)) {
        for (int k = 0; k < times; ++k) watch.add(sample, now += step);
    }
};

}  // namespace

TEST_CASE("the first hundred samples of a link are no pose", "[openhaptics]") {
    Watched arm;
    arm.add(good(), ArmWatch::kSettling - 1);
    CHECK(arm.watch.stage() == Stage::starting);
    CHECK(arm.watch.epoch() == kNoEpoch);
    arm.add(good(), 2);
    CHECK(arm.watch.stage() == Stage::ready);
    CHECK(arm.watch.epoch() == 1);
}

TEST_CASE("a gap, a jump and a force output that was off begin a new epoch", "[openhaptics]") {
    Watched arm;
    arm.add(good(), 200);
    REQUIRE(arm.watch.epoch() == 1);
    SECTION("a gap") {
        arm.add(good(), 1, milliseconds(20));
        CHECK(arm.watch.epoch() == kNoEpoch);
    }
    SECTION("a jump") {
        ArmSample jumped = good();
        jumped.position_m.x = 0.04;
        arm.add(jumped);
        CHECK(arm.watch.epoch() == kNoEpoch);
        arm.add(jumped, 2);
        CHECK(arm.watch.epoch() == 2);
        return;
    }
    SECTION("force output off") {
        ArmSample off = good();
        off.may_output = false;
        arm.add(off);
        CHECK(arm.watch.epoch() == kNoEpoch);
        CHECK(arm.watch.stage() == Stage::ready);
    }
    arm.add(good(), 2);
    CHECK(arm.watch.epoch() == 2);
}

TEST_CASE("a new link goes on with the epochs of the last one", "[openhaptics]") {
    Watched arm;
    arm.add(good(), 200);
    arm.watch.begin();
    CHECK(arm.watch.epoch() == kNoEpoch);
    arm.add(good(), 200);
    CHECK(arm.watch.epoch() == 2);
}

TEST_CASE("the force that motors stand falls with their warmth, and never rises with it",
          "[openhaptics]") {
    Watched arm;
    double last = 1.0;
    for (double heat = -0.5; heat < 1.5; heat += 0.01) {
        ArmSample sample = good();
        sample.warmest = heat;
        arm.add(sample);
        CHECK(arm.watch.force_share() <= last);
        CHECK(arm.watch.force_share() >= 0.0);
        last = arm.watch.force_share();
        if (heat < ArmWatch::kWarm) CHECK(last == 1.0);
    }
    CHECK(last == 0.0);
}

TEST_CASE("errors that end the link are told from those that end the force", "[openhaptics]") {
    for (const unsigned code : {0x302U, 0x303U, 0x304U, 0x500U, 0x501U, 0x300U, 0x104U, 0x999U})
        CHECK(class_of(code) == FaultClass::link);
    for (const unsigned code : {0x200U, 0x201U, 0x202U, 0x203U, 0x204U})
        CHECK(class_of(code) == FaultClass::force);
    for (const unsigned code : {0x100U, 0x101U, 0x102U, 0x103U, 0x400U, 0x401U, 0x402U})
        CHECK(class_of(code) == FaultClass::call);
    CHECK(class_of(kHdSuccess) == FaultClass::none);
    CHECK(name_of({FaultClass::link, 0x302, -28}) == "communication error 0x302 (-28)");
    CHECK(name_of({FaultClass::link, 0x777, 0}) == "error 0x777 (0)");
}
