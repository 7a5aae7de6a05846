// A Falcon from plug to force, through the real libusb: what the haptic thread and the window see.
#include "device/falcon/falcon_device.hpp"

#include <glm/geometric.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using namespace dibhr::falcon;
using dibhr::device_axes;
using dibhr::Vec3;
using dibhr::test::let_pass;
using std::chrono::milliseconds;

/// A homed unit and the device that has found it.
struct Homed {
    UsbBench bus{};
    Unit& unit{bus.plug()};
    std::optional<TickingFalcon> loop{};

    explicit Homed(ConnectionOptions options = {}) {
        start_firmware(unit);
        home(unit);
        loop.emplace(options);
        REQUIRE(loop->tick_until_ready());
    }
    Counts motors() {
        return unit.with([](FalconModel& model) { return model.board().motors(); });
    }
    /// Ticks until the unit's motors have received this command.
    bool told(const Counts& counts) {
        return loop->tick_until([&] { return motors() == counts; });
    }
};

/// What the README's formulas give for the unit where it stands.
Counts expected(Unit& unit, Vec3 force_newton) {
    const Geometry geometry;
    const auto encoders = unit.with([](FalconModel& model) { return model.board().encoders(); });
    const auto angles = angles_of_counts(encoders, geometry);
    const auto place = position_with(angles, {0.0, 0.0, 0.115}, geometry);
    const auto jacobian = jacobian_at(place.value(), geometry);
    const auto torques = torques_of(device_axes(force_newton), jacobian.value());
    return motor_counts(torques.value(), Motors{});
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a bare Falcon is loaded, homed by its person, and then touches", "[falcon]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    TickingFalcon loop(ConnectionOptions{}, any_firmware());
    loop.force_newton = {0.0, 0.0, 2.0};
    REQUIRE(loop.tick_until([&] { return loop.device.status().stage == Stage::homing; }));
    loop.tick_for(milliseconds(100));
    Status status = loop.device.status();
    CHECK(status.serial == "SIM00001");
    CHECK(holds(status.sentence, "pull the grip"));
    CHECK_FALSE(status.trouble);
    CHECK(status.replies > 0);
    CHECK_FALSE(loop.reading.ready);
    CHECK(log_of(unit).with_force == 0);
    const auto lamp = [&] {
        return unit.with([](FalconModel& model) { return model.board().lamp(); });
    };
    CHECK(lamp() == static_cast<unsigned>(Led::red));

    home(unit);
    REQUIRE(loop.tick_until_ready());
    REQUIRE(loop.tick_until([&] { return lamp() == static_cast<unsigned>(Led::green); }));
    CHECK(loop.device.status().stage == Stage::ready);
    CHECK(log_of(unit).force_before_homing == 0);
    loop.force_newton = {};
    CHECK(loop.tick_until([&] { return lamp() == static_cast<unsigned>(Led::blue); }));
    CHECK(unit.with([](FalconModel& model) { return model.board().homing(); }));
}

TEST_CASE("a Falcon that another program left homed is ready without asking its person",
          "[falcon]") {
    Homed homed;
    CHECK(homed.loop->device.status().load_try == 0);
    CHECK(homed.loop->device.can_touch());
}

TEST_CASE("a resting hand is pushed with exactly the counts of the force", "[falcon]") {
    Homed homed;
    homed.unit.with([](FalconModel& model) { model.board().hand().place({0.01, -0.02, 0.12}); });
    homed.unit.with([](FalconModel& model) { model.board().hold_commands(Moment(0)); });
    homed.loop->tick_for(milliseconds(20));
    // So small that the hand yields by less than a count.
    const Vec3 force{0.001, -0.0005, 0.0015};
    homed.loop->force_newton = force;
    const Counts counts = expected(homed.unit, force);
    CAPTURE(counts[0], counts[1], counts[2]);
    CHECK(counts != Counts{});
    CHECK(homed.told(counts));
    homed.loop->force_newton = {};
    CHECK(homed.told(Counts{}));
}

TEST_CASE("no force however large exceeds the motors' full scale", "[falcon]") {
    Homed homed;
    homed.loop->force_newton = Vec3{1e9, -1e9, 1e9};
    REQUIRE(homed.loop->tick_until([&] { return log_of(homed.unit).with_force > 10; }));
    CHECK(log_of(homed.unit).largest <= 4095);
}

TEST_CASE("a force that is not finite is sent as none", "[falcon]") {
    Homed homed;
    const double bad =
        GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
    homed.loop->force_newton = {0.0, bad, 1.0};
    homed.loop->tick_for(milliseconds(100));
    CHECK(log_of(homed.unit).with_force == 0);
}

TEST_CASE("the goal is where the grip is: right is right, up is up, out is up the relief",
          "[falcon]") {
    Homed homed;
    const auto goal_with_grip_at = [&](Vec3 grip_m) {
        homed.unit.with([&](FalconModel& model) { model.board().hand().place(grip_m); });
        homed.loop->tick_for(milliseconds(30));
        REQUIRE(homed.loop->tick_until_ready());
        return homed.loop->reading.goal_in_grid;
    };
    const Vec3 middle = goal_with_grip_at({0.0, 0.0, 0.115});
    const Vec3 moved = goal_with_grip_at({0.01, 0.02, 0.125});
    const double px_per_m = 1000.0 / TickingFalcon::kPitch_mm;
    // One count is at most 34 um (device/falcon/README.md, Workspace).
    const double tolerance_px = 0.05 * px_per_m / 1000.0;
    CHECK_THAT(moved.x - middle.x, Catch::Matchers::WithinAbs(0.01 * px_per_m, tolerance_px));
    CHECK_THAT(moved.y - middle.y, Catch::Matchers::WithinAbs(-0.02 * px_per_m, tolerance_px));
    CHECK_THAT(moved.z - middle.z, Catch::Matchers::WithinAbs(0.01 * px_per_m, tolerance_px));
}

TEST_CASE("while the clutch is held the goal stays and there is no force; then it goes on",
          "[falcon]") {
    Homed homed;
    auto& loop = *homed.loop;
    loop.force_newton = {0.0, 0.0, 0.5};
    REQUIRE(loop.tick_until([&] { return !is_limp(homed.unit); }));
    const auto press = [&](std::uint8_t buttons) {
        homed.unit.with([=](FalconModel& model) { model.board().press(buttons); });
    };
    press(static_cast<std::uint8_t>(Button::centre));
    REQUIRE(loop.tick_until([&] { return !loop.reading.ready && loop.reading.buttons != 0; }));
    CHECK(loop.device.can_touch());
    const Vec3 held = loop.reading.goal_in_grid;
    CHECK(homed.told(Counts{}));
    homed.unit.with([](FalconModel& model) { model.board().hand().place({0.02, 0.01, 0.13}); });
    loop.tick_for(milliseconds(50));
    CHECK_THAT(glm::distance(loop.reading.goal_in_grid, held),
               Catch::Matchers::WithinAbs(0.0, 1e-9));
    press(0);
    REQUIRE(loop.tick_until([&] { return loop.reading.ready; }));
    CHECK(glm::distance(loop.reading.goal_in_grid, held) < 5.0);  // the hand sags by some counts
    CHECK(loop.tick_until([&] { return loop.device.status().presses[2] == 1; }));
}

TEST_CASE(
    "a changed geometry, motor scale, workspace or centre begins anew in the tick it counts in",
    "[falcon]") {
    Homed homed;
    auto& loop = *homed.loop;
    const auto change = GENERATE(values<void (*)(Tuning&)>({
        [](Tuning& tuning) { tuning.geometry.gear *= 1.01; },
        [](Tuning& tuning) { tuning.motors.counts_per_newton_metre = 6616.0; },
        [](Tuning& tuning) { tuning.workspace.scale = 2.0; },
        [](Tuning& tuning) { tuning.centre_count = 1; },
    }));
    Tuning tuning;
    change(tuning);
    const auto next_reading = [&] {
        REQUIRE(loop.tick_until_ready());
        return loop.reading;
    };
    (void)next_reading();
    CHECK_FALSE(next_reading().hand_changed);
    loop.device.tuning().publish(tuning);
    CHECK(next_reading().hand_changed);
    CHECK_FALSE(next_reading().hand_changed);
    loop.device.tuning().publish(tuning);  // the same once more
    CHECK_FALSE(next_reading().hand_changed);
}

TEST_CASE("other buttons for clutch and force do not take the force off a hand", "[falcon]") {
    Homed homed;
    auto& loop = *homed.loop;
    Tuning tuning;
    tuning.clutch_buttons = static_cast<std::uint8_t>(Button::plus);
    tuning.force_off_buttons = 0;
    REQUIRE(loop.tick_until_ready());
    loop.device.tuning().publish(tuning);
    REQUIRE(loop.tick_until_ready());
    CHECK_FALSE(loop.reading.hand_changed);
}

TEST_CASE("a force has the tuning of the reading it was computed from", "[falcon]") {
    Homed homed;
    auto& loop = *homed.loop;
    homed.unit.with([](FalconModel& model) { model.board().hold_commands(Moment(0)); });
    Tuning none;
    none.motors.counts_per_newton_metre = 0.0;
    const auto before = log_of(homed.unit).with_force;
    loop.tick();
    loop.device.tuning().publish(none);
    loop.device.send({0.0, 0.0, 1.0});
    CHECK(eventually([&] { return log_of(homed.unit).with_force == before + 1; }));
    loop.force_newton = {0.0, 0.0, 1.0};
    loop.tick_for(milliseconds(50));
    CHECK(log_of(homed.unit).with_force == before + 1);
}

TEST_CASE("the buttons that take the force off are told in the reading", "[falcon]") {
    Homed homed;
    auto& loop = *homed.loop;
    const auto press = [&](Button button) {
        homed.unit.with(
            [=](FalconModel& model) { model.board().press(static_cast<std::uint8_t>(button)); });
        return loop.tick_until(
            [&] { return loop.reading.buttons == static_cast<std::uint8_t>(button); });
    };
    CHECK_FALSE(loop.reading.force_off);
    REQUIRE(press(Button::minus));
    CHECK(loop.reading.force_off);
    REQUIRE(press(Button::forward));
    CHECK_FALSE(loop.reading.force_off);
    Tuning tuning;
    tuning.force_off_buttons = static_cast<std::uint8_t>(Button::forward);
    loop.device.tuning().publish(tuning);
    loop.tick();
    CHECK(loop.reading.force_off);
    CHECK(loop.reading.ready);
}

TEST_CASE("beyond the usable volume the soft boundary pushes back to its centre", "[falcon]") {
    Homed homed;
    const auto own_force_at = [&](Vec3 grip_m) {
        homed.unit.with([&](FalconModel& model) { model.board().hand().place(grip_m); });
        homed.loop->tick_for(milliseconds(30));
        REQUIRE(homed.loop->tick_until_ready());
        return homed.loop->reading.own_force_newton;
    };
    CHECK_THAT(glm::length(own_force_at({0.0, 0.03, 0.12})), Catch::Matchers::WithinAbs(0, 1e-12));
    const Vec3 pushed = own_force_at({0.0, 0.045, 0.115});  // 5 mm beyond, above: down in the grid
    CHECK_THAT(pushed.y, Catch::Matchers::WithinAbs(1.5, 0.05));
    CHECK_THAT(pushed.x, Catch::Matchers::WithinAbs(0.0, 0.05));
    CHECK_THAT(pushed.z, Catch::Matchers::WithinAbs(0.0, 0.05));
}

TEST_CASE("a haptic thread that stands still leaves the motors without force", "[falcon]") {
    Homed homed;
    homed.unit.with([](FalconModel& model) { model.board().hold_commands(Moment(0)); });
    homed.loop->force_newton = {0.0, 0.0, 1.0};
    REQUIRE(homed.loop->tick_until([&] { return !is_limp(homed.unit); }));
    const auto before = log_of(homed.unit).commands;
    // No tick from here on.
    CHECK(eventually([&] { return is_limp(homed.unit); }));
    let_pass(milliseconds(300));
    CHECK(is_limp(homed.unit));
    CHECK(log_of(homed.unit).commands > before + 20);  // it is asked all the same, every 12 ms
    CHECK(homed.loop->tick_until([&] { return !is_limp(homed.unit); }));
}

TEST_CASE("leaving sends five packets without force, the last the unit gets", "[falcon]") {
    Homed homed;
    homed.unit.with([](FalconModel& model) { model.board().hold_commands(Moment(0)); });
    homed.loop->force_newton = {0.0, 0.0, 1.0};
    REQUIRE(homed.loop->tick_until([&] { return !is_limp(homed.unit); }));
    const auto flushes = [&] {
        return homed.unit.with([](FalconModel& model) { return model.chip().flushes(); });
    };
    CHECK(flushes());
    homed.loop.reset();
    CHECK(is_limp(homed.unit));
    CHECK(log_of(homed.unit).zeros_in_a_row >= 5);
    CHECK_FALSE(flushes());  // other programs expect none
}

TEST_CASE("a Falcon that loses its homing in mid-touch lets go at once and is homed again",
          "[falcon]") {
    Homed homed;
    auto& loop = *homed.loop;
    homed.unit.with([](FalconModel& model) { model.board().hold_commands(Moment(0)); });
    loop.force_newton = {0.0, 0.0, 1.0};
    REQUIRE(loop.tick_until([&] { return !is_limp(homed.unit); }));
    const auto forces = homed.unit.with([](FalconModel& model) {
        model.board().start_firmware();
        return model.board().log().with_force;
    });
    REQUIRE(loop.tick_until([&] { return !loop.reading.ready; }));
    loop.tick_for(milliseconds(50));
    CHECK(loop.device.status().stage == Stage::homing);
    CHECK(log_of(homed.unit).with_force <= forces + 1);  // the one that was asked of a homed unit
    CHECK(is_limp(homed.unit));
    CHECK(log_of(homed.unit).zeros_in_a_row >= 5);
    home(homed.unit);
    REQUIRE(loop.tick_until_ready());
    CHECK(loop.tick_until([&] { return !is_limp(homed.unit); }));
}

TEST_CASE("20 ms after the haptic thread's last command the USB thread sends zero",
          "[falcon_device]") {
    Homed at;
    std::chrono::nanoseconds zero_at{
        0};  // the first zero after a force; while the bus stands still
    at.unit.with([&zero_at](FalconModel& model) {
        model.board().hold_commands(Moment{0});
        model.board().watch([&zero_at, pushed = false](const CommandPacket& packet) mutable {
            const bool pushes = packet.motors != std::array<std::int16_t, 3>{};
            if (pushed && !pushes) zero_at = packet.at;
            pushed = pushes;
        });
    });
    at.loop->force_newton = {0.0, 0.0, 1.0};
    for (int k = 0; k < 3; ++k) {
        REQUIRE(at.loop->tick_until([&] { return !is_limp(at.unit); }));
        const auto last = std::chrono::steady_clock::now().time_since_epoch();
        REQUIRE(eventually([&] { return is_limp(at.unit); }));
        const std::chrono::duration<double, std::milli> after =
            at.unit.with([&](FalconModel&) { return zero_at; }) - last;
        CHECK_THAT(after.count(), Catch::Matchers::WithinAbs(20.0, 0.5));
    }
    at.unit.with([](FalconModel& model) { model.board().watch({}); });
}
