// An arm with the stand-in for its maker's library, without faults.
#include "device/forcedimension/forcedimension_device.hpp"

#include <glm/geometric.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "device/forcedimension/models.hpp"
#include "device/forcedimension/survey.hpp"
#include "tests/device/forcedimension/arm_bench.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/device/usb_folder.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::forcedimension;
using Catch::Matchers::WithinAbs;
using test::add_usb_device;
using test::let_pass;

}  // namespace

TEST_CASE("an arm touches, and its force arrives in its own axes", "[forcedimension]") {
    Page& page = page_with_omega();
    ArmBench bench(page);
    bench.pressed_newton = {0.5, 0.25, 2.0};
    REQUIRE(bench.press());
    bench.tick_for(milliseconds(50));
    CHECK(bench.status().stage == Stage::ready);
    CHECK(bench.status().serial == "1234");
    const Unit& unit = page.units[0];
    // Out of the image is towards the user (x); right is y, up (down in the grid) is z.
    CHECK_THAT(unit.newton[0], WithinAbs(2.0, 1e-9));
    CHECK_THAT(unit.newton[1], WithinAbs(0.5, 1e-9));
    CHECK_THAT(unit.newton[2], WithinAbs(-0.25, 1e-9));
    CHECK(page.wrong_calls == 0);
}

TEST_CASE("the arm's origin is the middle of the image, and its axes are the hand's",
          "[forcedimension]") {
    Page& page = page_with_omega();
    ArmBench bench(page);
    bench.pressed_newton = Vec3{0.0};
    REQUIRE(bench.reaches(Stage::ready));
    REQUIRE(bench.tick_until([&] { return bench.loop.reading.ready; }));
    const DepthSurface& surface = bench.loop.surface();
    const Vec3 middle{0.5 * (surface.columns() - 1), 0.5 * (surface.rows() - 1),
                      0.5 * surface.ceiling()};
    CHECK(glm::distance(bench.loop.reading.goal_in_grid, middle) < 1e-6);
    page.units[0].position_m[1] = 0.003;  // right
    page.units[0].position_m[2] = 0.002;  // up
    bench.tick_for(milliseconds(20));
    const Vec3 way = bench.loop.reading.goal_in_grid - middle;
    CHECK_THAT(way.x * bench.loop.kPitch_mm, WithinAbs(3.0, 1e-9));
    CHECK_THAT(way.y * bench.loop.kPitch_mm, WithinAbs(-2.0, 1e-9));
    CHECK_THAT(way.z, WithinAbs(0.0, 1e-9));
}

TEST_CASE("the watchdog is 20 ms, the library limits the force, too, and the arm holds its weight",
          "[forcedimension]") {
    Page& page = page_with_omega();
    page.units[0].holds_weight = false;
    ArmBench bench(page);
    REQUIRE(bench.press());
    CHECK(page.units[0].watchdog == 160);
    CHECK_THAT(bench.status().watchdog_ms, WithinAbs(20.0, 1e-12));
    CHECK(bench.status().unguarded.empty());
    CHECK_THAT(page.units[0].max_newton, WithinAbs(12.0, 1e-12));
    CHECK(page.units[0].holds_weight);
    CHECK(page.threshold_calls == 0);
    CHECK(page.velocity_calls == 0);
}

TEST_CASE("an arm without a haptic loop is still held up, and pushes nobody", "[forcedimension]") {
    Page& page = page_with_omega();
    const auto options = options_for();
    ForceDimensionDevice device(options, load_calls(options.library));
    let_pass(std::chrono::seconds(2));
    CHECK(device.status().stage == Stage::ready);
    CHECK(page.units[0].force_on);
    CHECK(page.units[0].cause == 0);  // the watchdog had no reason
    CHECK(page.units[0].square_newton(page.units[0].newton_at_ns) == 0.0);
}

TEST_CASE("the end is a zero force, then the stop, then the end of the connection",
          "[forcedimension]") {
    Page& page = page_with_omega();
    auto bench = std::make_unique<ArmBench>(page);
    REQUIRE(bench->press());
    bench.reset();
    CHECK_FALSE(page.units[0].force_on);
    CHECK_FALSE(page.units[0].open);
    const auto call = [&page](std::size_t back) {
        return std::string(page.last_calls[(page.calls - 1 - back) % kCallsKept].load());
    };
    CHECK(call(0) == "drdClose");
    CHECK(call(1) == "dhdStop");
    CHECK(call(2) == "dhdSetForceAndTorqueAndGripperForce");
    CHECK(page.wrong_calls == 0);
}

TEST_CASE("no force is longer than was allowed, nor than the type of arm stands",
          "[forcedimension]") {
    Page& page = page_with_omega();
    const auto [type, most] =
        GENERATE(table<int, double>({{kOmega3, 12.0}, {63, 20.0}, {108, 12.0}, {210, 4.0}}));
    CAPTURE(type);
    page.units[0].type = type;
    ArmBench bench(page);
    bench.loop.device.tuning().publish({.max_force_newton = 50.0});
    REQUIRE(bench.tick_until([&] { return bench.loop.reading.ready; }));
    bench.loop.force_newton = {0.0, 30.0, 40.0};
    bench.loop.tick_for(milliseconds(50));
    CHECK_THAT(bench.newton(), WithinAbs(most, 1e-9));
    CHECK_THAT(bench.loop.reading.limits->max_force_newton, WithinAbs(most, 1e-9));
    bench.loop.device.tuning().publish({.max_force_newton = 1.5});
    bench.loop.tick_for(milliseconds(50));
    CHECK_THAT(bench.newton(), WithinAbs(1.5, 1e-9));
}

TEST_CASE("a serial chooses among several arms, and the others get no force", "[forcedimension]") {
    Page& page = page_with_omega();
    page.units[1].plugged = true;
    page.units[1].serial = 77;
    ConnectionOptions options = options_for();
    options.serial = "77";
    ArmBench bench(page, options);
    REQUIRE(bench.tick_until([&] { return bench.newton(1) > 1.9; }));
    CHECK(bench.newton(0) == 0.0);
    CHECK_FALSE(page.units[0].force_on);
    CHECK_FALSE(page.units[0].open);
}

TEST_CASE("closing the gripper, and every button, comes without its bounce", "[forcedimension]") {
    Page& page = page_with_omega();
    page.units[0].gripper = true;
    ArmBench bench(page);
    bench.loop.device.tuning().publish({.clutch_buttons = 1, .force_off_buttons = 2});
    REQUIRE(bench.tick_until([&] { return bench.loop.reading.ready; }));
    CHECK(page.units[0].emulates_button);
    page.units[0].buttons = 1;
    bench.tick_for(milliseconds(60));
    CHECK_FALSE(bench.loop.reading.ready);  // the clutch
    page.units[0].buttons = 2;
    bench.tick_for(milliseconds(60));
    CHECK(bench.loop.reading.force_off);
    page.units[0].buttons = 0;
    bench.tick_for(milliseconds(60));
    CHECK(bench.loop.reading.ready);
    CHECK(bench.status().presses == ButtonPresses{1, 1, 0, 0});
}

TEST_CASE("a tick allocates nothing with an arm", "[forcedimension]") {
    Page& page = page_with_omega();
    ArmBench bench(page);
    REQUIRE(bench.press());
    int allocations = 0;
    for (int k = 0; k < 200; ++k) {
        allocations += test::allocations_in([&] { bench.loop.tick(); });
        let_pass(milliseconds(1));
    }
    CHECK(allocations == 0);
}

TEST_CASE("a Falcon belongs to dibhr's own driver, and is never opened through the library",
          "[forcedimension]") {
    const test::TemporaryFolder folder;
    add_usb_device(folder / "1-1", "0403", "cb48");
    Page& page = fresh_page();
    page.units[0].plugged = true;
    page.units[0].type = kFalcon;
    ConnectionOptions options = options_for();
    options.usb_devices = folder.path();
    const bool has_arm = GENERATE(true, false);
    if (has_arm) {
        page.units[1].plugged = true;
        page.units[1].type = 108;
    }
    CHECK(survey_arms(options).arms.size() == (has_arm ? 1U : 0U));
    ArmBench bench(page, options);
    CHECK(bench.tick_until([&] { return bench.newton(1) > 1.9; }, milliseconds(5000)) == has_arm);
    CHECK_FALSE(page.units[0].was_opened);
}

TEST_CASE("a library that cannot be used is trouble only where an arm is attached",
          "[forcedimension]") {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "libdrd.so.3") << "no library";
    ConnectionOptions options = options_for((folder / "libdrd.so.3").string());
    options.usb_devices = folder.path();
    const bool has_arm = GENERATE(true, false);
    if (has_arm) add_usb_device(folder / "1-1", "1451", "0402");
    const Survey survey = survey_arms(options);
    CHECK(survey.trouble == has_arm);
    CHECK(survey.arms.empty());
    CHECK(survey.sentence.starts_with(options.library + " is not a library"));
}

TEST_CASE("beside a Falcon, why an arm cannot be opened is told as without one",
          "[forcedimension]") {
    const test::TemporaryFolder folder;
    add_usb_device(folder / "1-1", "0403", "cb48");
    Page& page = fresh_page();
    page.units[0].plugged = true;
    page.units[0].type = kFalcon;
    ConnectionOptions options = options_for();
    options.usb_devices = folder.path();
    const Survey none = survey_arms(options);
    CHECK_FALSE(none.trouble);
    const bool in_use = GENERATE(true, false);
    if (in_use) {
        page.units[1].plugged = true;
        page.units[1].in_use = true;
    } else {
        add_usb_device(folder / "1-2", "1451", "0402");  // without permission
    }
    const Survey survey = survey_arms(options);
    CHECK(survey.trouble);
    CHECK(survey.sentence.find(in_use ? "end that one" : "you may not open it") !=
          std::string::npos);
    CHECK_FALSE(page.units[0].was_opened);
}

TEST_CASE("a Falcon that the system does not list is closed again at once", "[forcedimension]") {
    Page& page = fresh_page();
    page.units[0].plugged = true;
    page.units[0].type = kFalcon;
    ArmBench bench(page);
    bench.tick_for(milliseconds(3000));
    CHECK(bench.status().stage == Stage::looking);
    CHECK_FALSE(page.units[0].open);
    CHECK(page.units[0].watchdog == 0);
    CHECK_FALSE(page.units[0].force_on);
}

TEST_CASE("nominal dynamics leave every type of arm stable at the default stiffness",
          "[forcedimension]") {
    for (const int type : {kOmega3, 63, 104, 108, 203, 206, 210}) {
        CAPTURE(type);
        const DeviceLimits limits = at_delay(limits_of(model_of(type)), Tuning::delay_s(1));
        const Coupling held = held_coupling({}, limits);
        const Coupling stable =
            stable_coupling(held, held.stiffness_newton_per_mm, limits.dynamics);
        CHECK(stability_margin(stable, limits.dynamics) > 0.0);
        CHECK(limits == usable(limits));
    }
}
