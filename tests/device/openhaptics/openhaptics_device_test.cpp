// A Touch with the stand-in library, without faults.
#include "device/openhaptics/openhaptics_device.hpp"

#include <dlfcn.h>

#include "device/openhaptics/driver_thread.hpp"
#include "device/openhaptics/survey.hpp"
#include "tests/device/openhaptics/touch_desk.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/device/usb_folder.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::openhaptics;
using Catch::Matchers::WithinAbs;
using test::let_pass;

void check_calls(ArmPage& page) {
    CAPTURE(page.first_wrong);
    CHECK(page.wrong_calls == 0);
}

}  // namespace

TEST_CASE("a ready device touches, and its force arrives in the device's axes", "[openhaptics]") {
    TouchDesk desk;
    CHECK_FALSE(desk.loop.device.can_touch());
    desk.pressed_newton = {0.1, 0.2, 0.6};
    REQUIRE(desk.press());
    CHECK(desk.stage() == Stage::ready);
    CHECK(desk.loop.device.status().serial == "SIM-1");
    CHECK(desk.loop.device.status().driver == "2024.9.19");
    desk.tick_for(milliseconds(20));
    // Rows of the image count down.
    const Vec3 felt = desk.bench.felt_newton();
    CHECK_THAT(felt.x, WithinAbs(0.1, 1e-9));
    CHECK_THAT(felt.y, WithinAbs(-0.2, 1e-9));
    CHECK_THAT(felt.z, WithinAbs(0.6, 1e-9));
    check_calls(desk.bench.page());
}

TEST_CASE("the middle of the usable workspace is the middle of the image", "[openhaptics]") {
    TouchDesk desk;
    desk.pressed_newton = Vec3{0.0};
    REQUIRE(desk.loop.tick_until_ready());
    const DepthSurface& surface = desk.loop.surface();
    const Vec3 middle{0.5 * (surface.columns() - 1), 0.5 * (surface.rows() - 1),
                      0.5 * surface.ceiling()};
    CHECK(glm::distance(desk.loop.reading.goal_in_grid, middle) < 1e-6);
    desk.bench.move_to({3.0, 10.0, 2.0});
    desk.tick_for(milliseconds(20));
    const Vec3 way = (desk.loop.reading.goal_in_grid - middle) * desk.loop.kPitch_mm;
    CHECK(glm::distance(way, Vec3{3.0, -10.0, 2.0}) < 1e-6);
}

TEST_CASE("no force is stronger than the motors hold for ever, or than the user allows",
          "[openhaptics]") {
    TouchDesk desk;
    REQUIRE(desk.loop.tick_until_ready());
    CHECK(desk.loop.reading.limits->max_force_newton == 0.88);
    CHECK(desk.loop.reading.limits->max_stiffness_newton_per_mm == 0.4);
    desk.loop.force_newton = {0.0, 3.0, 4.0};
    desk.loop.tick_for(milliseconds(100));
    const Vec3 felt = desk.bench.felt_newton();
    CHECK_THAT(glm::length(felt), WithinAbs(0.88, 1e-9));
    CHECK_THAT(-felt.z / felt.y, WithinAbs(4.0 / 3.0, 1e-6));
    desk.loop.device.tuning().publish({.max_force_newton = 0.25});
    desk.loop.tick_for(milliseconds(100));
    CHECK_THAT(glm::length(desk.bench.felt_newton()), WithinAbs(0.25, 1e-9));
}

TEST_CASE("limits that no device can have are replaced by those of the Touch", "[openhaptics]") {
    const double reported = GENERATE(0.0, -1.0, 1e9, std::nan(""));
    TouchDesk desk("", [reported](ArmPage& page) {
        page.arms[0].continuous_newton = reported;
        page.arms[0].stiffness = reported;
    });
    REQUIRE(desk.loop.tick_until_ready());
    CHECK(desk.loop.reading.limits->max_force_newton == 0.88);
    CHECK(desk.loop.reading.limits->max_stiffness_newton_per_mm == 0.4);
}

TEST_CASE("the default device is found under each name that a driver gives it", "[openhaptics]") {
    const bool by_null = GENERATE(true, false);
    TouchDesk desk("", [by_null](ArmPage& page) {
        page.default_by_null = by_null;
        page.default_by_name = !by_null;
    });
    CHECK(desk.begins_to_press());
    CHECK(desk.loop.device.status().serial == "SIM-1");
}

TEST_CASE("of two devices the named one touches, and the other one is not opened",
          "[openhaptics]") {
    TouchDesk desk("Second");
    CHECK(desk.tick_until(
        [&] { return desk.loop.reading.ready && glm::length(desk.bench.felt_newton(1)) > 0.1; }));
    CHECK(desk.loop.device.status().serial == "SIM-2");
    CHECK(desk.bench.arm(0).frames == 0);
    CHECK_FALSE(desk.bench.arm(0).open);
    check_calls(desk.bench.page());
}

TEST_CASE("the stylus's buttons come without their bounce", "[openhaptics]") {
    TouchDesk desk;
    desk.loop.device.tuning().publish({.clutch_buttons = 1, .force_off_buttons = 2});
    REQUIRE(desk.begins_to_press());
    const auto hold = [&](int buttons) {
        desk.bench.arm().buttons = buttons;
        desk.tick_for(milliseconds(30));
    };
    hold(1);
    CHECK_FALSE(desk.loop.reading.ready);  // the clutch
    CHECK(glm::length(desk.bench.felt_newton()) == 0.0);
    hold(2);
    CHECK(desk.loop.reading.force_off);
    hold(0);
    CHECK(desk.loop.reading.ready);
    CHECK(desk.loop.device.status().presses == ButtonPresses{1, 1, 0, 0});
}

TEST_CASE("neither a tick of the loop nor one of the servo thread allocates", "[openhaptics]") {
    test::EnvironmentVariable none(kPageVariable, nullptr);
    ArmBench bench;
    const test::EnvironmentVariable page(kPageVariable, bench.file().c_str());
    const LoadedLibrary library = load_hd_library(STAND_IN_LIBRARY);
    REQUIRE(library.loaded);
    const HdHandle handle = library.functions.init_device(nullptr);
    ArmBuffers buffers;
    ArmWatch watch;
    ButtonDebounce buttons;
    Servo servo(library.functions, {handle, Vec3{0.0}, specification_of().limits}, buffers, watch,
                buttons);
    library.functions.enable(kHdForceOutput);
    servo.allow_force(true);
    bench.page().raised = 0x201;  // an error, too
    bench.page().raised_times = 3;
    int allocations = 0;
    for (int k = 0; k < 1000; ++k) {
        const Epoch epoch = buffers.poses.front().epoch;
        buffers.forces.publish({{0.0, 0.0, 0.5}, Clock::now(), epoch});
        allocations += test::allocations_in([&] { (void)servo.tick(); });
        let_pass(milliseconds(1));
    }
    CHECK(allocations <= 1);  // the stand-in's own, for the errors that it keeps
    CHECK(strongest(bench.sent_since({})) == 0.5);
    library.functions.disable(kHdForceOutput);
    library.functions.disable_device(handle);

    TouchDesk desk;
    REQUIRE(desk.begins_to_press());
    allocations = 0;
    for (int k = 0; k < 200; ++k) {
        allocations += test::allocations_in([&] { desk.loop.tick(); });
        let_pass(milliseconds(1));
    }
    CHECK(allocations == 0);
}

TEST_CASE("a force that the haptic thread wanted 20 ms ago is not sent any more", "[openhaptics]") {
    TouchDesk desk;
    REQUIRE(desk.press());
    const auto stopped = Clock::now();
    let_pass(milliseconds(300));
    CHECK(desk.bench.felt_newton() == Vec3{0.0});
    CHECK(strongest(desk.bench.sent_since(stopped + milliseconds(22))) == 0.0);
    CHECK(strongest(desk.bench.sent_since(stopped)) > 0.5);
    CHECK(desk.press());
}

TEST_CASE("its end is zero force, the force output off, and a closed device", "[openhaptics]") {
    ArmBench bench;
    const test::EnvironmentVariable page(kPageVariable, bench.file().c_str());
    {
        test::TickingDevice<OpenhapticsDevice> loop(options_for());
        REQUIRE(loop.tick_until_ready());
        loop.force_newton = {0.0, 0.0, 0.6};
        loop.tick_for(milliseconds(100));
        CHECK(glm::length(bench.felt_newton()) > 0.5);
    }
    CHECK_FALSE(bench.arm().open);
    CHECK_FALSE(bench.arm().output);
    CHECK(bench.page().closings == 1);
    CHECK(length_of(bench.sent_since({}).back()) == 0.0);
    check_calls(bench.page());
}

TEST_CASE("a survey opens the device, tells of it, and never switches its force on",
          "[openhaptics]") {
    ArmBench bench;
    const test::EnvironmentVariable page(kPageVariable, bench.file().c_str());
    const Status status = survey_device(options_for());
    CHECK(answers(status));
    CHECK(status.stage == Stage::ready);
    CHECK(status.model == "Touch");
    CHECK_FALSE(bench.arm().open);
    check_calls(bench.page());
    bench.arm().attached = false;
    const Status none = survey_device(options_for());
    CHECK_FALSE(answers(none));
    CHECK(none.sentence.find("no Touch answers") != std::string::npos);
}

TEST_CASE("a device that does not answer is attached where the USB or another program has it",
          "[openhaptics]") {
    const test::TemporaryFolder folder;
    ConnectionOptions options = options_for();
    options.usb_devices = folder.path();
    Status status;
    for (const Stage stage : {Stage::no_library, Stage::broken_library, Stage::looking}) {
        status.stage = stage;
        CHECK_FALSE(is_attached(status, options));
    }
    status.stage = Stage::cannot_open;
    CHECK(is_attached(status, options));
    const auto [maker, product, is_touch] = GENERATE(table<const char*, const char*, bool>(
        {{"2988", "0304", true}, {"0301", "2988", true}, {"0301", "0304", false}}));
    test::add_usb_device(folder / "1-1", maker, product);
    status.stage = Stage::no_library;
    CHECK(is_attached(status, options) == is_touch);
}
