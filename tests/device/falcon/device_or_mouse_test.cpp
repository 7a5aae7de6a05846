// The mouse as fallback while a Falcon is not ready; the Falcon takes over when it is.
#include "device/device_or_mouse.hpp"

#include <glm/geometric.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include "device/inverse3/inverse3_device.hpp"
#include "device/inverse3/simulated/service.hpp"
#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using namespace dibhr::falcon;
using dibhr::Vec3;
using std::chrono::milliseconds;

/// In the order of force_device_kinds().
dibhr::DeviceOrMouse::Devices looked_for(
    std::unique_ptr<FalconDevice> falcon,
    std::unique_ptr<dibhr::inverse3::Inverse3Device> inverse3 = nullptr) {
    dibhr::DeviceOrMouse::Devices both;
    both.push_back(std::move(falcon));
    both.push_back(std::move(inverse3));
    return both;
}

/// Of devices only a Falcon is looked for.
struct FalconOrMouse : dibhr::DeviceOrMouse {
    FalconOrMouse(ConnectionOptions options, FirmwareImage firmware)
        : DeviceOrMouse(
              looked_for(std::make_unique<FalconDevice>(std::move(options), std::move(firmware)))) {
    }
};
using TickingHand = TickingDevice<FalconOrMouse>;

bool press_of_the_mouse_moves_the_goal(TickingHand& loop) {
    const Vec3 before = loop.reading.goal_in_grid;
    const double x = before.x < 200.0 ? 350.0 : 50.0;
    loop.device.mouse().target().publish({.cursor_in_grid = {x, 150.0}, .pointing = true});
    loop.tick_for(milliseconds(300));
    return glm::distance(loop.reading.goal_in_grid, before) > 20.0;
}

}  // namespace

TEST_CASE("without a Falcon the mouse touches from the first tick on", "[device_or_mouse]") {
    const UsbBench bus;
    TickingHand loop(ConnectionOptions{}, FirmwareImage{});
    CHECK(loop.device.reading_without_surface().mouse_fallback);
    CHECK(loop.device.reading_without_surface().limits ==
          loop.device.mouse().specification().limits);
    loop.tick();
    CHECK(loop.reading.ready);
    CHECK(loop.reading.mouse_fallback);
    CHECK_FALSE(loop.reading.hand_changed);
    CHECK(press_of_the_mouse_moves_the_goal(loop));
}

TEST_CASE("a Falcon takes the hand over once when it is ready, and the mouse once when it is gone",
          "[device_or_mouse]") {
    UsbBench bus;
    Unit& unit = bus.make("SIM00001");
    TickingHand loop(ConnectionOptions{}, any_firmware());
    loop.tick();
    start_firmware(unit);
    home(unit);
    bus.plug(unit);
    int takings = 0;
    REQUIRE(loop.tick_until([&] {
        takings += loop.reading.hand_changed ? 1 : 0;
        return !loop.reading.mouse_fallback;
    }));
    CHECK(takings == 1);
    CHECK(loop.reading.hand_changed);
    REQUIRE(loop.tick_until_ready());
    loop.force_newton = {0.0, 0.0, 0.5};
    REQUIRE(loop.tick_until([&] { return !is_limp(unit); }));
    CHECK_FALSE(press_of_the_mouse_moves_the_goal(loop));

    const auto forces = log_of(unit).with_force;
    CHECK(forces > 0);
    bus.unplug(unit);
    REQUIRE(loop.tick_until([&] { return loop.reading.mouse_fallback; }));
    CHECK(loop.reading.hand_changed);
    CHECK(press_of_the_mouse_moves_the_goal(loop));

    bus.plug(unit);
    CHECK(loop.tick_until_ready());
    CHECK(loop.tick_until([&] { return log_of(unit).with_force > forces; }));
}

TEST_CASE("a reading says what its own hand can stand: the mouse's, or the Falcon's at its scale",
          "[device_or_mouse]") {
    UsbBench bus;
    Unit& unit = bus.make("SIM00001");
    TickingHand loop(ConnectionOptions{}, FirmwareImage{});
    Tuning tuning;
    tuning.workspace.scale = 4.0;
    dynamic_cast<FalconDevice&>(*loop.device.devices()[0]).tuning().publish(tuning);
    loop.tick();
    CHECK(loop.reading.limits == loop.device.mouse().specification().limits);
    start_firmware(unit);
    home(unit);
    bus.plug(unit);
    REQUIRE(loop.tick_until_ready());
    REQUIRE(loop.reading.limits.has_value());
    const dibhr::DeviceLimits& most = loop.device.specification().limits;
    CHECK(loop.reading.limits == dibhr::at_scale(most, 4.0));
    CHECK(loop.reading.limits->max_stiffness_newton_per_mm < most.max_stiffness_newton_per_mm);
    bus.unplug(unit);
    REQUIRE(loop.tick_until([&] { return loop.reading.mouse_fallback; }));
    CHECK(loop.reading.limits == loop.device.mouse().specification().limits);
}

TEST_CASE("a clutched Falcon stays the hand, without force", "[device_or_mouse]") {
    UsbBench bus;
    Unit& unit = bus.plug();
    start_firmware(unit);
    home(unit);
    TickingHand loop(ConnectionOptions{}, FirmwareImage{});
    REQUIRE(loop.tick_until_ready());
    unit.with(
        [](FalconModel& model) { model.board().press(static_cast<std::uint8_t>(Button::centre)); });
    REQUIRE(loop.tick_until([&] { return !loop.reading.ready; }));
    CHECK_FALSE(loop.reading.mouse_fallback);
    CHECK_FALSE(loop.reading.hand_changed);
}

TEST_CASE("of a Falcon and an Inverse3 the first that is ready touches, and the other rests",
          "[device_or_mouse]") {
    UsbBench bus;
    Unit& unit = bus.make("SIM00001");
    namespace simulated = dibhr::inverse3::simulated;
    simulated::Service service;
    dibhr::inverse3::ConnectionOptions options;
    options.port = service.port();
    options.older_port = service.older_port();
    TickingDevice<dibhr::DeviceOrMouse> loop(
        looked_for(std::make_unique<FalconDevice>(ConnectionOptions{}, any_firmware()),
                   std::make_unique<dibhr::inverse3::Inverse3Device>(options)));
    constexpr int kFalcon = 1;
    constexpr int kInverse3 = 2;
    const auto touching = [&] { return int{loop.reading.device_number}; };
    loop.force_newton = {0.0, 0.0, 1.0};
    REQUIRE(loop.tick_until_ready());
    CHECK(touching() == kInverse3);
    start_firmware(unit);
    home(unit);
    bus.plug(unit);
    REQUIRE(loop.tick_until([&] { return loop.device.devices()[0]->can_touch(); }));
    loop.tick_for(milliseconds(100));
    CHECK(touching() == kInverse3);
    CHECK(log_of(unit).with_force == 0);

    // The Inverse3 goes: the Falcon takes over, from zero.
    service.with([](simulated::Scene& scene) { scene.arms.clear(); });
    int takings = 0;
    REQUIRE(loop.tick_until([&] {
        takings += loop.reading.hand_changed ? 1 : 0;
        return touching() == kFalcon;
    }));
    CHECK(takings == 1);
    loop.tick_for(milliseconds(300));
    CHECK(log_of(unit).with_force > 0);

    // It comes again: the Falcon keeps the hand, and the Inverse3 rests at zero.
    service.with([](simulated::Scene& scene) { scene.arms = {simulated::Arm{}}; });
    service.clear_received();
    REQUIRE(loop.tick_until([&] { return loop.device.devices()[1]->can_touch(); }));
    loop.tick_for(milliseconds(200));
    CHECK(touching() == kFalcon);
    for (const simulated::ReceivedMessage& one : service.received()) {
        CHECK(glm::length(one.force_newton) == 0.0);
    }
}
