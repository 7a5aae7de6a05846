// The device with the simulated service, without faults.
#include "device/inverse3/inverse3_device.hpp"

#include <glm/geometric.hpp>

#include <stop_token>
#include <thread>

#include "device/inverse3/exchange_loop.hpp"
#include "tests/device/inverse3/service_desk.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::inverse3;
using Catch::Matchers::WithinAbs;
using simulated::AcceptedDialect;
using test::let_pass;

}  // namespace

TEST_CASE("a ready device touches, and its force arrives in the service's axes", "[inverse3]") {
    ServiceDesk desk;
    CHECK_FALSE(desk.loop.device.can_touch());
    REQUIRE(desk.press());
    CHECK(desk.stage() == Stage::ready);
    CHECK(desk.loop.device.status().id == "049D");
    desk.tick_for(milliseconds(20));
    // Out of the upright image is back to the person.
    const Vec3 felt = desk.felt_newton();
    CHECK_THAT(felt.y, WithinAbs(-2.0, 1e-6));
    CHECK_THAT(felt.x, WithinAbs(0.0, 1e-9));
    CHECK_THAT(felt.z, WithinAbs(0.0, 1e-9));
}

TEST_CASE("the middle of the box is the middle of the image, and the image is upright",
          "[inverse3]") {
    ServiceDesk desk;
    desk.pressed_newton = Vec3{0.0};
    REQUIRE(desk.loop.tick_until_ready());
    const DepthSurface& surface = desk.loop.surface();
    const Vec3 middle{0.5 * (surface.columns() - 1), 0.5 * (surface.rows() - 1),
                      0.5 * surface.ceiling()};
    CHECK(glm::distance(desk.loop.reading.goal_in_grid, middle) < 1e-6);
    // A centimetre up in the hand is a centimetre up in the picture: rows count down.
    desk.service.with([](simulated::Scene& scene) { scene.arms[0].position_m.z += 0.01; });
    desk.tick_for(milliseconds(50));
    const Vec3 way = desk.loop.reading.goal_in_grid - middle;
    CHECK_THAT(way.y, WithinAbs(-10.0 / desk.loop.kPitch_mm, 1e-6));
    CHECK_THAT(way.z, WithinAbs(0.0, 1e-6));
}

TEST_CASE("both dialects, in the shapes of 3.1 and 3.5, are found without being told",
          "[inverse3]") {
    simulated::Scene scene = usual_scene();
    simulated::Behaviour& behaviour = scene.behaviour;
    behaviour.newer_shape = GENERATE(true, false);
    behaviour.accepts =
        GENERATE(AcceptedDialect::vector, AcceptedDialect::values, AcceptedDialect::both);
    behaviour.on_wrong_dialect =
        GENERATE(simulated::OnWrongDialect::ignores, simulated::OnWrongDialect::refuses,
                 simulated::OnWrongDialect::closes);
    behaviour.version = behaviour.newer_shape ? "3.5.0" : "3.1.4";
    // 3.1 reports no force: a service that ignores the wrong dialect cannot be detected.
    const bool mute = !behaviour.newer_shape && behaviour.accepts == AcceptedDialect::vector &&
                      behaviour.on_wrong_dialect == simulated::OnWrongDialect::ignores;
    CAPTURE(behaviour.newer_shape, static_cast<int>(behaviour.accepts),
            static_cast<int>(behaviour.on_wrong_dialect));
    ServiceDesk desk(scene);
    const auto patience = milliseconds(mute ? 1500 : 60'000);
    CHECK(desk.tick_until([&] { return glm::length(desk.felt_newton()) > 0.5; }, patience) != mute);
}

TEST_CASE("no force is longer than was allowed, whoever asks for it", "[inverse3]") {
    ServiceDesk desk;
    REQUIRE(desk.loop.tick_until_ready());
    CHECK(desk.loop.reading.limits->max_force_newton == 4.0);
    desk.loop.force_newton = {0.0, 30.0, 40.0};
    desk.loop.tick_for(milliseconds(100));
    const Vec3 felt = desk.felt_newton();
    CHECK_THAT(glm::length(felt), WithinAbs(4.0, 1e-6));
    CHECK_THAT(felt.z / felt.y, WithinAbs(0.75, 1e-6));
    desk.loop.device.tuning().publish({.max_force_newton = 1.5});
    desk.loop.tick_for(milliseconds(100));
    CHECK_THAT(glm::length(desk.felt_newton()), WithinAbs(1.5, 1e-6));
}

TEST_CASE("a device is chosen by its name or its hand, in whatever order the list is",
          "[inverse3]") {
    simulated::Scene scene = usual_scene();
    scene.arms = {simulated::Arm{.id = "B", .handedness = "right"},
                  simulated::Arm{.id = "A", .handedness = "left"}};
    if (GENERATE(false, true)) std::swap(scene.arms[0], scene.arms[1]);
    const auto [wish, id] = GENERATE(table<std::string, std::string>(
        {{"", "A"}, {"A", "A"}, {"B", "B"}, {"left", "A"}, {"right", "B"}}));
    CAPTURE(wish);
    ServiceDesk desk(scene, wish);
    REQUIRE(desk.begins_to_press());
    CHECK(desk.loop.device.status().id == id);
    for (const simulated::ReceivedMessage& one : desk.service.received()) {
        CHECK((one.arm.empty() || one.arm == id));
    }
}

TEST_CASE("the other of two devices is never sent a word, and swapping their order changes nothing",
          "[inverse3]") {
    simulated::Scene scene = usual_scene();
    scene.arms = {simulated::Arm{.id = "A"}, simulated::Arm{.id = "B"}};
    scene.arms[1].position_m.x = 0.1;
    ServiceDesk desk(scene);
    REQUIRE(desk.begins_to_press());
    const Vec3 before = desk.loop.reading.goal_in_grid;
    desk.service.with([](simulated::Scene& there) { std::swap(there.arms[0], there.arms[1]); });
    desk.tick_for(milliseconds(100));
    CHECK(glm::distance(desk.loop.reading.goal_in_grid, before) < 1e-6);
    CHECK(desk.stage() == Stage::ready);
}

TEST_CASE("who asks for a device that is not there is told which one is", "[inverse3]") {
    ServiceDesk desk(usual_scene(), "C0FFEE");
    CHECK(desk.tick_until([&] { return desk.sentence().find("C0FFEE") != std::string::npos; }));
    CHECK(desk.stage() == Stage::no_device);
    CHECK(desk.sentence().find("049D") != std::string::npos);
}

TEST_CASE("the grip's buttons come without their bounce, in both naming schemes", "[inverse3]") {
    simulated::Scene scene = usual_scene();
    scene.grips = {simulated::Grip{.numbered = GENERATE(true, false)}};
    ServiceDesk desk(scene);
    desk.loop.device.tuning().publish({.clutch_buttons = 2, .force_off_buttons = 4});
    REQUIRE(desk.begins_to_press());
    const auto hold = [&](std::uint8_t buttons) {
        desk.service.with([&](simulated::Scene& there) { there.grips[0].buttons = buttons; });
        desk.tick_for(milliseconds(60));
    };
    hold(1);
    CHECK(desk.loop.reading.buttons == 1);
    hold(2);
    CHECK_FALSE(desk.loop.reading.ready);  // the clutch
    CHECK(glm::length(desk.felt_newton()) == 0.0);
    hold(4);
    CHECK(desk.loop.reading.force_off);
    hold(0);
    CHECK(desk.loop.reading.ready);
    const ButtonPresses presses = desk.loop.device.status().presses;
    CHECK(presses == ButtonPresses{1, 1, 1, 0});
}

TEST_CASE("of a grip it is told whether it sleeps and how full it is", "[inverse3]") {
    simulated::Scene scene = usual_scene();
    scene.grips = {simulated::Grip{.awake = false, .battery = 0.25}};
    ServiceDesk desk(scene);
    REQUIRE(desk.begins_to_press());
    const auto grip = desk.loop.device.status().grip;
    REQUIRE(grip.has_value());
    CHECK_FALSE(grip->awake);
    CHECK_THAT(grip->battery.value_or(0.0), WithinAbs(0.25, 1e-12));
}

TEST_CASE("a tick allocates nothing", "[inverse3]") {
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    int allocations = 0;
    for (int k = 0; k < 200; ++k) {
        allocations += test::allocations_in([&] { desk.loop.tick(); });
        let_pass(milliseconds(1));
    }
    CHECK(allocations == 0);
}

TEST_CASE("on the network thread no exchange allocates, once there is a connection", "[inverse3]") {
    simulated::Service service;
    const ConnectionOptions options = options_for(service);
    ArmBuffers buffers;
    Board board;
    DriverState driver_state;
    Guardian guardian("Inverse3");
    int allocations = 0;
    std::jthread network([&](const std::stop_token& stop) {
        ServiceLink link(options.port, ServiceLink::Time::clock::now() + milliseconds(1000));
        ExchangeLoop exchange_loop(link, options, true, buffers, board, driver_state, guardian);
        allocations = test::allocations_in([&] { exchange_loop.run(stop); });
    });
    constexpr std::uint64_t kExchanges = 1000;
    while (service.exchanges() <=
           kExchanges) {  // before it asks again it has taken the last answer
        const TimedPose pose = buffers.poses.front();
        buffers.forces.publish({{0.0, 0.0, 1.0}, simulated::Clock::now(), pose.epoch});
        buffers.wake.signal();
        let_pass(std::chrono::microseconds(200));
    }
    network.request_stop();
    network.join();
    CHECK(driver_state.exchanges.count >= kExchanges);
    CHECK(driver_state.dialect_confirmed);
    CHECK(allocations < 50);  // what is said of each new stage
}

TEST_CASE("a program that presses is never disturbed by its guardian", "[inverse3]") {
    ServiceDesk desk;
    REQUIRE(desk.press());
    desk.service.clear_received();
    desk.tick_for(std::chrono::seconds(2));
    CHECK(desk.service.connections() == 1);
    CHECK(desk.service.too_many_in_flight() == 0);
    const auto received = desk.service.received();
    CHECK(received.size() > 1900);
    for (const simulated::ReceivedMessage& one : received) {
        if (one.drives) CHECK(glm::length(one.force_newton) > 1.9);
    }
}

TEST_CASE("its end is a zero force and a goodbye", "[inverse3]") {
    simulated::Service service;
    {
        TickingDevice<Inverse3Device> loop(options_for(service));
        REQUIRE(loop.tick_until_ready());
        loop.force_newton = {0.0, 0.0, 2.0};
        loop.tick_for(milliseconds(100));
    }
    const auto received = service.received();
    REQUIRE(received.size() > 10);
    CHECK(received.back().drives);
    CHECK(received.back().force_newton == Vec3{0.0});
    CHECK(service.too_many_in_flight() == 0);
}
