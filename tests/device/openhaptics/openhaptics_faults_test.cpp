// Faults of the arm and of the library: each gives the right stage, a plain sentence with the next
// step, no force within 25 ms, and a ramp afterwards.
#include <cmath>
#include <functional>

#include "device/openhaptics/arm_watch.hpp"
#include "tests/device/openhaptics/touch_desk.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::openhaptics;

constexpr milliseconds kGrace{25};
constexpr int kForEver = 1'000'000'000;

/// A fault, and how it is undone.
struct FaultCase {
    const char* name;
    std::function<void(ArmPage&)> begin;
    std::function<void(ArmPage&)> end;
    Stage stage;
    const char* next_step;  ///< a part of the sentence
};

FaultCase raised(const char* name, unsigned code, int internal_code, Stage stage,
                 const char* next_step) {
    return {name,
            [code, internal_code](ArmPage& page) {
                page.raised_internal = internal_code;
                page.raised_times = kForEver;
                page.raised = code;
            },
            [](ArmPage& page) { page.raised = 0; }, stage, next_step};
}

const std::vector<FaultCase>& faults() {
    static const std::vector<FaultCase> all{
        {"calibration lost", [](auto& p) { p.arms[0].calibration = 0x5002; },
         [](auto& p) { p.arms[0].in_inkwell = true; }, Stage::not_calibrated, "into the inkwell"},
        {"unplugged", [](auto& p) { p.arms[0].attached = false; },
         [](auto& p) { p.arms[0].attached = true; }, Stage::looking, "plug it in again"},
        {"hot motors", [](auto& p) { p.arms[0].heat = 1.0; }, [](auto& p) { p.arms[0].heat = 0.2; },
         Stage::hot, "let it rest"},
        {"a temperature that is no number", [](auto& p) { p.arms[0].heat = std::nan(""); },
         [](auto& p) { p.arms[0].heat = 0.2; }, Stage::hot, "let it rest"},
        {"a position that is no number", [](auto& p) { p.arms[0].position_mm[1] = std::nan(""); },
         [](auto& p) { p.arms[0].position_mm[1] = 0.0; }, Stage::not_understood,
         "plug it in again"},
        {"a position beyond any arm", [](auto& p) { p.arms[0].position_mm[0] = 1e6; },
         [](auto& p) { p.arms[0].position_mm[0] = 0.0; }, Stage::not_understood,
         "plug it in again"},
        {"callback stopped", [](auto& p) { p.calls_back = false; },
         [](auto& p) { p.calls_back = true; }, Stage::silent, "start dibhr again"},
        raised("warm motors", kHdWarmMotors, 0, Stage::force_cut, "let it rest"),
        raised("force too high", 0x201, 0, Stage::force_cut, "move more slowly"),
        raised("impulse", 0x202, 0, Stage::force_cut, "move more slowly"),
        raised("hand too fast", 0x203, 0, Stage::force_cut, "move more slowly"),
        raised("force error", 0x204, 0, Stage::force_cut, "move more slowly"),
        raised("unknown parameter", 0x100, 0, Stage::refused, "send us this line"),
        raised("frame error", 0x402, 0, Stage::refused, "send us this line"),
        raised("communication error", 0x302, -28, Stage::looking, "0x302 (-28)"),
        raised("device fault", 0x300, 0, Stage::looking, "plug it in again"),
        raised("timer error", 0x304, 0, Stage::looking, "plug it in again"),
        raised("scheduler full", 0x501, 0, Stage::looking, "plug it in again"),
        raised("an error that nobody knows", 0x777, 5, Stage::looking, "0x777 (5)"),
    };
    return all;
}

/// Forces rise again from zero: none of the first exceeds the ramp.
bool rises(const std::vector<SentForce>& sent) {
    const auto first =
        std::find_if(sent.begin(), sent.end(), [](auto& one) { return length_of(one) > 0.0; });
    return first != sent.end() && length_of(*first) < 0.05 && length_of(sent.back()) > 0.59;
}

}  // namespace

TEST_CASE("whatever keeps the device from touching takes the force off and says what to do",
          "[openhaptics_faults]") {
    const FaultCase& fault = GENERATE(from_range(faults()));
    CAPTURE(fault.name);
    TouchDesk desk;
    REQUIRE(desk.press());
    const auto began = Clock::now();
    fault.begin(desk.bench.page());
    CHECK(desk.tick_until([&] { return desk.bench.felt_newton() == Vec3{0.0}; }, kGrace));
    CHECK(desk.reaches(fault.stage));
    desk.tick_for(milliseconds(150));
    CHECK(desk.stage() == fault.stage);
    CAPTURE(desk.sentence());
    CHECK(desk.says(fault.next_step));
    CHECK(desk.sentence().find('\n') == std::string::npos);
    CHECK(strongest(desk.bench.sent_since(began + kGrace)) == 0.0);
    CHECK_FALSE(desk.loop.reading.ready);

    const auto ended = Clock::now();
    fault.end(desk.bench.page());
    CHECK(desk.press());
    desk.tick_for(milliseconds(20));
    CHECK(desk.stage() == Stage::ready);
    CHECK(rises(desk.bench.sent_since(ended)));
    CAPTURE(desk.bench.page().first_wrong);
    CHECK(desk.bench.page().wrong_calls == 0);
}

TEST_CASE("a position that stands still gives no force", "[openhaptics_faults]") {
    TouchDesk desk;
    REQUIRE(desk.press());
    SimulatedArm& arm = desk.bench.arm();
    double turned = 0.0;
    const bool by_velocity = GENERATE(true, false);
    CAPTURE(by_velocity);
    if (by_velocity) arm.velocity_mm_per_s[0] = 50.0;
    const auto stands = [&] {
        if (!by_velocity) arm.gimbal_rad[2] = turned += 0.005;  // a turn of the stylus
        return desk.stage() == Stage::stands_still;
    };
    CHECK(desk.tick_until(stands));
    CHECK(desk.says("into the inkwell"));
    CHECK(desk.bench.felt_newton() == Vec3{0.0});
    if (!by_velocity) CHECK(turned < StillEncoders::kTurn_rad + 0.15);  // 25 ms of turning
    const auto ended = Clock::now();
    arm.velocity_mm_per_s[0] = 0.0;
    desk.bench.move_to({0.2, 0.0, 0.0});
    CHECK(desk.press());
    desk.tick_for(milliseconds(20));
    CHECK(rises(desk.bench.sent_since(ended)));
}

TEST_CASE("a stylus that turns while its arm moves is no frozen arm", "[openhaptics_faults]") {
    TouchDesk desk;
    REQUIRE(desk.press());
    double turned = 0.0;
    for (int k = 0; k < 500; ++k) {
        desk.bench.arm().gimbal_rad[0] = turned += 0.01;
        if (k % 10 == 0) desk.bench.move_to({0.06 * (k / 10), 0.0, 0.0});
        desk.tick_for(milliseconds(1));
    }
    CHECK(desk.stage() == Stage::ready);
    CHECK(glm::length(desk.bench.felt_newton()) > 0.5);
}

TEST_CASE("warm motors get less force, and the user is told", "[openhaptics_faults]") {
    TouchDesk desk;
    desk.pressed_newton = {0.0, 0.0, 4.0};
    REQUIRE(desk.begins_to_press());
    desk.tick_for(milliseconds(800));
    CHECK(glm::length(desk.bench.felt_newton()) > 0.87);
    desk.bench.arm().heat = 0.85;
    desk.tick_for(milliseconds(50));
    CHECK(desk.loop.reading.ready);
    CHECK(glm::length(desk.bench.felt_newton()) < 0.45);
    CHECK(glm::length(desk.bench.felt_newton()) > 0.43);
    CHECK(desk.says("motors are warm"));
    desk.bench.arm().heat = 0.6;  // full force, and still told
    desk.tick_for(milliseconds(50));
    CHECK(desk.says("motors are warm"));
    desk.bench.arm().heat = 0.4;
    desk.tick_for(milliseconds(50));
    CHECK(desk.sentence() == "ready to touch");
}

TEST_CASE("each style of calibration is done at its time, and no force comes before it",
          "[openhaptics_faults]") {
    const int style = GENERATE(1, 2, 4, 6, 7);
    const unsigned asked = GENERATE(0x5001U, 0x5002U);
    CAPTURE(style, asked);
    TouchDesk desk("", [=](ArmPage& page) {
        page.arms[0].calibration_style = style;
        page.arms[0].calibration = asked;
    });
    REQUIRE(desk.reaches(Stage::not_calibrated));
    SimulatedArm& arm = desk.bench.arm();
    if (style == 1) {
        CHECK(desk.says("press the stylus's button"));
        CHECK(arm.frames > 0);
        desk.tick_for(milliseconds(300));
        CHECK(arm.calibrations == 0);
        arm.buttons = 1;
        desk.tick_for(milliseconds(50));
        arm.buttons = 0;
    } else if ((style & 2) != 0) {
        CHECK(desk.says("calibrates itself"));
        arm.calibration = 0x5001;  // it has moved far enough
    } else {
        CHECK(desk.says("into the inkwell"));
        arm.in_inkwell = true;
    }
    CHECK(strongest(desk.bench.sent_since({})) == 0.0);
    CHECK(desk.press());
    CHECK(arm.calibrations == 1);
    CAPTURE(desk.bench.page().first_wrong);
    CHECK(desk.bench.page().wrong_calls == 0);
}

TEST_CASE("why a device cannot be opened is told with the next step", "[openhaptics_faults]") {
    struct Refusal {
        unsigned code;
        Stage stage;
        const char* next_step;
    };
    const Refusal refusal = GENERATE(Refusal{0x301, Stage::cannot_open, "end that one"},
                                     Refusal{0x600, Stage::cannot_open, "accept its licence"},
                                     Refusal{0x302, Stage::looking, "plug in its cable"},
                                     Refusal{0x300, Stage::looking, "set it up once"});
    CAPTURE(refusal.code);
    TouchDesk desk("", [&](ArmPage& page) { page.arms[0].in_use_error = refusal.code; });
    REQUIRE(desk.reaches(refusal.stage));
    CHECK(desk.says(refusal.next_step));
    CHECK(state_of(desk.loop.device.status()).absent);
    desk.bench.arm().in_use_error = 0;
    CHECK(desk.press());
}

TEST_CASE(
    "a value that the library does not have is asked for once, and its lack takes no force off",
    "[openhaptics_faults]") {
    const unsigned unknown = GENERATE(as<unsigned>{}, kHdVelocity, kHdGimbalAngles, kHdEncoders,
                                      kHdMotorTemperature, kHdInkwellSwitch);
    CAPTURE(unknown);
    TouchDesk desk("", [unknown](ArmPage& page) { page.unknown = unknown; });
    REQUIRE(desk.press());
    // A stylus that turns says nothing of encoders that nobody reads.
    for (int k = 0; k < 300; ++k) {
        if (unknown == kHdEncoders) desk.bench.arm().gimbal_rad[0] = 0.01 * k;
        desk.tick_for(milliseconds(1));
    }
    CHECK(desk.stage() == Stage::ready);
    CHECK(desk.loop.device.status().errors == 0);
    CHECK(desk.loop.device.status().reports_heat == (unknown != kHdMotorTemperature));
    CHECK(glm::length(desk.bench.felt_newton()) > 0.59);
}

TEST_CASE("a library that refuses the position gives no force", "[openhaptics_faults]") {
    TouchDesk desk("", [](ArmPage& page) { page.unknown = kHdPosition; });
    REQUIRE(desk.reaches(Stage::refused));
    CHECK(desk.says("unknown parameter"));
    desk.tick_for(milliseconds(2000));
    CHECK(strongest(desk.bench.sent_since({})) == 0.0);
}

TEST_CASE("while a call of the servo thread does not return, no second servo is started",
          "[openhaptics_faults]") {
    TouchDesk desk;
    REQUIRE(desk.press());
    desk.bench.page().hangs = true;
    CHECK(desk.tick_until([&] { return desk.bench.felt_newton() == Vec3{0.0}; }, kGrace));
    REQUIRE(desk.tick_until([&] { return !desk.bench.arm().open; }));
    desk.tick_for(std::chrono::seconds(10));
    CHECK(desk.bench.page().openings == 1);
    CHECK(desk.stage() == Stage::looking);
    CHECK(desk.says("start dibhr again"));
    desk.bench.page().hangs = false;
    CHECK(desk.press());
    CHECK(desk.bench.page().openings == 2);
    CAPTURE(desk.bench.page().first_wrong);
    CHECK(desk.bench.page().wrong_calls == 0);
}

TEST_CASE("a device with an unknown name is named", "[openhaptics_faults]") {
    TouchDesk desk("Third");
    REQUIRE(desk.reaches(Stage::looking));
    CHECK(desk.says("no Touch with the name Third answers"));
}

TEST_CASE("a servo thread that is late makes springs softer", "[openhaptics_faults]") {
    TouchDesk desk("", [](ArmPage& page) { page.tick_us = 4000; });
    REQUIRE(desk.begins_to_press());
    desk.tick_for(milliseconds(500));
    CHECK(desk.loop.reading.limits->max_stiffness_newton_per_mm < 0.4);
    CHECK(desk.stage() == Stage::ready);
}

TEST_CASE("a library that does not return when it opens a device does not hold the program",
          "[openhaptics_faults]") {
    ArmBench bench;
    const test::EnvironmentVariable page(kPageVariable, bench.file().c_str());
    bench.page().opening_takes_ms = 10'000;
    const auto began = Clock::now();
    {
        test::TickingDevice<OpenhapticsDevice> loop(options_for());
        loop.tick_for(milliseconds(100));
        CHECK(loop.device.status().stage == Stage::opening);
    }
    CHECK(Clock::now() - began < milliseconds(2500));
    test::let_pass(std::chrono::seconds(12));  // the thread that was left ends
    CHECK_FALSE(bench.arm().open);
}
