// Faults of the service: each gives the right stage, a plain sentence, no force within 25 ms, and a
// ramp afterwards.
#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>

#include "tests/device/inverse3/service_desk.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::inverse3;
using simulated::Garble;
using Clock = simulated::Clock;

constexpr milliseconds kGrace{25};

/// A fault of the service, and how it is undone.
struct Fault {
    const char* name;
    std::function<void(simulated::Scene&)> begin;
    std::function<void(simulated::Scene&)> end;
    Stage stage;
    const char* word;  ///< of the sentence
};

const std::vector<Fault>& faults() {
    static const std::vector<Fault> all{
        {"not calibrated", [](auto& s) { s.arms[0].calibrated = false; },
         [](auto& s) { s.arms[0].calibrated = true; }, Stage::not_calibrated, "inkwell"},
        {"no power", [](auto& s) { s.arms[0].powered = false; },
         [](auto& s) { s.arms[0].powered = true; }, Stage::no_power, "power adapter"},
        {"locked", [](auto& s) { s.arms[0].ready = false; },
         [](auto& s) { s.arms[0].ready = true; }, Stage::locked, "not ready"},
        {"unplugged", [](auto& s) { s.arms.clear(); }, [](auto& s) { s.arms = {simulated::Arm{}}; },
         Stage::no_device, "unplugged"},
        {"unplugged, and another one comes", [](auto& s) { s.arms.clear(); },
         [](auto& s) { s.arms = {simulated::Arm{.id = "61F0"}}; }, Stage::no_device, "unplugged"},
        {"grip only",
         [](auto& s) {
             s.arms.clear();
             s.grips = {simulated::Grip{}};
         },
         [](auto& s) { s.arms = {simulated::Arm{}}; }, Stage::no_device, "unplugged"},
        {"null", [](auto& s) { s.arms[0].position_text = R"({"x":null,"y":0,"z":0})"; },
         [](auto& s) { s.arms[0].position_text.clear(); }, Stage::not_understood,
         "does not understand"},
        {"huge", [](auto& s) { s.arms[0].position_m.x = 1e12; },
         [](auto& s) { s.arms[0].position_m.x = 0.0; }, Stage::not_understood,
         "does not understand"},
        {"NaN", [](auto& s) { s.arms[0].position_text = R"({"x":NaN,"y":0,"z":0})"; },
         [](auto& s) { s.arms[0].position_text.clear(); }, Stage::not_understood,
         "does not understand"},
        {"malformed", [](auto& s) { s.behaviour.garble = Garble::malformed; },
         [](auto& s) { s.behaviour.garble = Garble::none; }, Stage::not_understood,
         "does not understand"},
        {"cut", [](auto& s) { s.behaviour.garble = Garble::cut; },
         [](auto& s) { s.behaviour.garble = Garble::none; }, Stage::not_understood,
         "does not understand"},
        {"empty", [](auto& s) { s.behaviour.garble = Garble::empty; },
         [](auto& s) { s.behaviour.garble = Garble::none; }, Stage::not_understood,
         "does not understand"},
        {"an array", [](auto& s) { s.behaviour.garble = Garble::array; },
         [](auto& s) { s.behaviour.garble = Garble::none; }, Stage::not_understood,
         "does not understand"},
    };
    return all;
}

void tell_time(const char* fault, Clock::time_point began) {
    const std::chrono::duration<double> taken = Clock::now() - began;
    WARN("Inverse3, " << fault << ": zero force after " << taken.count() << " s");
}

/// Forces rise again from zero: none of the first exceeds the ramp.
bool rises(const std::vector<simulated::ReceivedMessage>& received, Clock::time_point since) {
    const simulated::ReceivedMessage* last = nullptr;
    for (const simulated::ReceivedMessage& one : received) {
        if (one.at < since || !one.drives) continue;
        const double length = glm::length(one.force_newton);
        if (last == nullptr && length > 0.2) return false;
        last = &one;
    }
    return last != nullptr && glm::length(last->force_newton) > 1.9;
}

}  // namespace

TEST_CASE("whatever is said of the device that keeps it from touching takes the force off",
          "[inverse3_faults]") {
    const Fault& fault = GENERATE(from_range(faults()));
    CAPTURE(fault.name);
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    const auto began = Clock::now();
    desk.service.with(fault.begin);
    CHECK(desk.tick_until([&] { return desk.stage() == fault.stage; }));
    desk.tick_for(milliseconds(150));
    CHECK(desk.stage() == fault.stage);
    CHECK(desk.sentence().find(fault.word) != std::string::npos);
    CHECK(desk.sentence().find('\n') == std::string::npos);
    CHECK(desk.strongest_after(began, kGrace) == 0.0);
    CHECK_FALSE(desk.loop.reading.ready);

    const auto ended = Clock::now();
    desk.service.with(fault.end);
    CHECK(desk.press());
    desk.tick_for(milliseconds(20));
    CHECK(desk.stage() == Stage::ready);
    CHECK(rises(desk.service.received(), ended));
    CHECK(desk.service.too_many_in_flight() == 0);
}

TEST_CASE("another program that uses the device from before on has it", "[inverse3_faults]") {
    simulated::Scene scene = usual_scene();
    scene.arms[0].in_use = true;
    ServiceDesk desk(scene);
    CHECK(desk.tick_until([&] { return desk.stage() == Stage::in_use; }));
    desk.tick_for(milliseconds(100));
    CHECK(desk.sentence().find("another program") != std::string::npos);
    for (const simulated::ReceivedMessage& one : desk.service.received()) CHECK_FALSE(one.drives);
    desk.service.with([](simulated::Scene& there) { there.arms[0].in_use = false; });
    CHECK(desk.begins_to_press());
}

TEST_CASE("a position that jumps takes the force off, and it rises again from where it is",
          "[inverse3_faults]") {
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    desk.service.with([](simulated::Scene& scene) { scene.arms[0].position_m.x += 0.1; });
    int hand_changed = 0;
    (void)desk.tick_until(
        [&] {
            hand_changed += desk.loop.reading.hand_changed ? 1 : 0;
            return false;
        },
        milliseconds(100));
    CHECK(hand_changed == 1);
    CHECK(desk.begins_to_press());
}

TEST_CASE("a preset that is changed under us is set again, and the force rises anew",
          "[inverse3_faults]") {
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    const auto preset = [&] {
        return desk.service.with([](simulated::Scene& scene) { return scene.arms[0].preset; });
    };
    desk.service.with([](simulated::Scene& scene) { scene.arms[0].preset = "arm_front"; });
    int hand_changed = 0;
    CHECK(desk.tick_until([&] {
        hand_changed += desk.loop.reading.hand_changed ? 1 : 0;
        return hand_changed > 0 && preset() == "defaults";
    }));
    CHECK(desk.begins_to_press());
}

TEST_CASE("a service that does not take the preset is asked some times, then told, without force",
          "[inverse3_faults]") {
    simulated::Scene scene = usual_scene();
    scene.arms[0].preset = "arm_front";
    scene.behaviour.takes_preset = false;
    const std::string asked = GENERATE("led_front", "defaults");
    simulated::Service service(scene);
    ConnectionOptions options = options_for(service);
    options.preset = ShortWord(asked);
    TickingDevice<Inverse3Device> loop(options);
    loop.force_newton = {0.0, 0.0, 1.0};
    CHECK(loop.tick_until([&] { return loop.device.status().other_preset; }));
    loop.tick_for(milliseconds(300));
    const auto received = service.received();
    CHECK(std::count_if(
              received.begin(), received.end(),
              [](const simulated::ReceivedMessage& one) { return one.requests_preset; }) <= 4);
    if (asked == "defaults") {  // which it may call something else
        CHECK(loop.reading.ready);
        return;
    }
    CHECK(loop.device.status().stage == Stage::other_preset);
    CHECK(loop.device.status().sentence.find("arm_front") != std::string::npos);
    CHECK_FALSE(loop.reading.ready);
    CHECK(glm::length(received.back().force_newton) == 0.0);
    service.with([&](simulated::Scene& there) { there.arms[0].preset = asked; });
    CHECK(loop.tick_until_ready());
}

TEST_CASE("a service that answers slowly makes springs softer, and the loop knows how late it is",
          "[inverse3_faults]") {
    simulated::Scene scene;
    scene.behaviour.delay = std::chrono::microseconds(3500);
    ServiceDesk desk(scene);
    REQUIRE(desk.begins_to_press());
    desk.tick_for(milliseconds(500));
    REQUIRE(desk.loop.reading.limits);
    const DeviceLimits& limits = *desk.loop.reading.limits;
    CHECK(limits.dynamics.delay_s > 2.0 * 0.0035);
    CHECK(limits.max_stiffness_newton_per_mm < 1.0);
    const Coupling felt =
        stable_coupling({.stiffness_newton_per_mm = limits.max_stiffness_newton_per_mm},
                        limits.max_stiffness_newton_per_mm, limits.dynamics);
    CHECK(stability_margin(felt, limits.dynamics) > 2.9);
    CHECK(desk.loop.device.status().softened);
    desk.service.with([](simulated::Scene& there) { there.behaviour.delay = {}; });
    CHECK(desk.tick_until(
        [&] { return desk.loop.reading.limits->max_stiffness_newton_per_mm == 1.0; }));
}

TEST_CASE("a device whose entry goes is still sent zeros, should it still be there",
          "[inverse3_faults]") {
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    const auto began = Clock::now();
    desk.service.with([](simulated::Scene& scene) { scene.arms.clear(); });
    CHECK(desk.tick_until([&] { return desk.stage() == Stage::no_device; }));
    desk.tick_for(milliseconds(100));
    int zeros = 0;
    for (const simulated::ReceivedMessage& one : desk.service.received())
        zeros += one.at > began && one.drives && one.arm == "049D" &&
                         glm::length(one.force_newton) == 0.0
                     ? 1
                     : 0;
    CHECK(zeros >= 4);
    CHECK(desk.strongest_after(began, kGrace) == 0.0);
}

TEST_CASE("when ours is unplugged the one beside it is not pushed until it is plugged in anew",
          "[inverse3_faults]") {
    simulated::Scene scene = usual_scene();
    scene.arms = {simulated::Arm{.id = "A"}, simulated::Arm{.id = "B"}};
    ServiceDesk desk(scene);
    REQUIRE(desk.begins_to_press());
    desk.service.with([](simulated::Scene& there) { there.arms.erase(there.arms.begin()); });
    CHECK(desk.tick_until([&] { return desk.stage() == Stage::no_device; }));
    desk.tick_for(milliseconds(800));
    CHECK(desk.stage() == Stage::no_device);
    CHECK(desk.sentence().find("A was unplugged") != std::string::npos);
    CHECK(desk.sentence().find("B instead") != std::string::npos);
    for (const simulated::ReceivedMessage& one : desk.service.received()) CHECK(one.arm != "B");
    SECTION("ours comes back") {
        desk.service.with(
            [](simulated::Scene& there) { there.arms.push_back(simulated::Arm{.id = "A"}); });
        CHECK(desk.begins_to_press());
        CHECK(desk.loop.device.status().id == "A");
    }
    SECTION("the other one is plugged in anew") {
        desk.service.with([](simulated::Scene& there) { there.arms.clear(); });
        desk.tick_for(milliseconds(300));
        desk.service.with(
            [](simulated::Scene& there) { there.arms.push_back(simulated::Arm{.id = "B"}); });
        CHECK(desk.begins_to_press());
        CHECK(desk.loop.device.status().id == "B");
    }
}

TEST_CASE("a service that stands still for longer than it is waited for has a zero to read",
          "[inverse3_faults]") {
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    desk.service.with([](simulated::Scene& scene) { scene.behaviour.answers = false; });
    desk.tick_for(milliseconds(200));
    desk.service.clear_received();
    CHECK(desk.tick_until([&] { return desk.stage() == Stage::looking; }));
    desk.service.with([](simulated::Scene& scene) { scene.behaviour.answers = true; });
    CHECK(desk.tick_until([&] { return !desk.service.received().empty(); }));
    const simulated::ReceivedMessage first = desk.service.received().front();
    CHECK(first.drives);
    CHECK(glm::length(first.force_newton) == 0.0);
}

TEST_CASE("a service that keeps silent takes the force off, is missed, and comes back",
          "[inverse3_faults]") {
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    const auto began = Clock::now();
    desk.service.with([](simulated::Scene& scene) { scene.behaviour.answers = false; });
    desk.tick_for(milliseconds(60));
    CHECK_FALSE(desk.loop.reading.ready);
    const bool comes_back_soon = GENERATE(true, false);
    if (!comes_back_soon) {
        CHECK(desk.tick_until([&] { return desk.stage() == Stage::looking; }));
        CHECK(desk.sentence().find("silent for 2 s") != std::string::npos);
    }
    const auto ended = Clock::now();
    desk.service.with([](simulated::Scene& scene) { scene.behaviour.answers = true; });
    CHECK(desk.press());
    desk.tick_for(milliseconds(20));
    CHECK(rises(desk.service.received(), ended));
    const double in_between = [&] {
        double strongest = 0.0;
        for (const simulated::ReceivedMessage& one : desk.service.received()) {
            if (one.at > began + kGrace && one.at < ended) {
                strongest = std::max(strongest, glm::length(one.force_newton));
            }
        }
        return strongest;
    }();
    CHECK(in_between == 0.0);
    // The zeros with which a connection ends that is given up: ours, and the guardian's.
    CHECK((desk.service.too_many_in_flight() > 0) == !comes_back_soon);
}

TEST_CASE("a service that closes, breaks off, or cannot be reached for a while is found again",
          "[inverse3_faults]") {
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    const auto how = GENERATE(simulated::Loss::closed, simulated::Loss::reset);
    const bool restarts = GENERATE(true, false);
    if (restarts) desk.service.refuse();
    desk.service.drop_clients(how);
    CHECK(desk.tick_until([&] { return desk.stage() == Stage::looking; }));
    CHECK(desk.sentence().find("was lost") != std::string::npos);
    desk.tick_for(milliseconds(50));
    CHECK_FALSE(desk.loop.reading.ready);
    const auto ended = Clock::now();
    desk.service.listen();
    CHECK(desk.press());
    desk.tick_for(milliseconds(20));
    CHECK(rises(desk.service.received(), ended));
}

TEST_CASE("a megabyte in the place of an answer ends the connection, and the next one is fine",
          "[inverse3_faults]") {
    ServiceDesk desk;
    REQUIRE(desk.begins_to_press());
    desk.service.with([](simulated::Scene& scene) { scene.behaviour.garble = Garble::megabyte; });
    CHECK(desk.tick_until([&] { return desk.stage() == Stage::not_understood; }));
    desk.service.with([](simulated::Scene& scene) { scene.behaviour.garble = Garble::none; });
    CHECK(desk.begins_to_press());
}

TEST_CASE("a position that stands still while the service reports a velocity gives no force",
          "[inverse3_faults]") {
    ServiceDesk desk;
    REQUIRE(desk.press());
    desk.service.with([](simulated::Scene& scene) {
        scene.arms[0].velocity_m_per_s = Vec3{GENERATE(0.05, 0.01, 1.0), 0.0, 0.0};
    });
    const auto began = Clock::now();
    CHECK(desk.tick_until([&] { return desk.felt_newton() == Vec3{0.0}; }, milliseconds(50)));
    tell_time("pose that stands still", began);
    desk.tick_for(milliseconds(300));
    CHECK(desk.strongest_after(began, milliseconds(50)) == 0.0);
    CHECK(desk.stage() == Stage::not_understood);
    CHECK(desk.sentence().find("old position") != std::string::npos);
    const auto ended = Clock::now();
    desk.service.with([](simulated::Scene& scene) {
        scene.hand_m = [](double t) { return Vec3{0.001 * t, -0.15, 0.18}; };
    });
    CHECK(desk.press());
    desk.tick_for(milliseconds(20));
    CHECK(rises(desk.service.received(), ended));
}

TEST_CASE("whatever message ends the connection, the service is sent a zero before it ends",
          "[inverse3_faults]") {
    simulated::Scene scene = usual_scene();
    scene.behaviour.force_held = milliseconds(0);  // for ever
    ServiceDesk desk(scene);
    REQUIRE(desk.begins_to_press());
    desk.service.refuse();  // no later connection takes the force off
    desk.service.with([](simulated::Scene& there) {
        there.behaviour.garble = GENERATE(Garble::not_utf8, Garble::megabyte, Garble::masked,
                                          Garble::reserved_bits, Garble::close_frame);
    });
    const auto began = Clock::now();
    CHECK(desk.tick_until([&] { return desk.felt_newton() == Vec3{0.0}; }, kGrace));
    tell_time("message that ends the connection", began);
    CHECK(desk.tick_until([&] { return desk.stage() != Stage::ready; }));
    CHECK(desk.strongest_after(began, kGrace) == 0.0);
    CHECK(desk.service.not_understood() == 0);
}

TEST_CASE("answers that nobody asked for make no pose older", "[inverse3_faults]") {
    simulated::Scene scene = usual_scene();
    scene.behaviour.garble = Garble::two;
    ServiceDesk desk(scene);
    REQUIRE(desk.begins_to_press());
    desk.tick_for(milliseconds(300));
    CHECK(desk.stage() == Stage::ready);
    CHECK(desk.loop.device.status().unrequested > 50);
    CHECK(desk.loop.device.pose_age() < milliseconds(2));
}

TEST_CASE("a service that takes no force is noticed after a quarter of a second, and told",
          "[inverse3_faults]") {
    simulated::Scene scene = usual_scene();
    // Neither dialect is what it takes: it ignores the one, and the other is not allowed.
    scene.behaviour.accepts = simulated::AcceptedDialect::values;
    simulated::Service service(scene);
    ConnectionOptions options = options_for(service);
    options.dialect = ForceDialect::vector;
    TickingDevice<Inverse3Device> loop(options);
    REQUIRE(loop.tick_until_ready());
    loop.force_newton = {0.0, 0.0, 1.0};
    const auto began = Clock::now();
    CHECK(loop.tick_until([&] { return loop.device.status().stage == Stage::force_refused; }));
    CHECK(Clock::now() - began < milliseconds(300));
    CHECK(loop.device.status().sentence.find("accepts a force in neither") != std::string::npos);
    loop.tick_for(milliseconds(50));
    CHECK_FALSE(loop.reading.ready);
}

TEST_CASE("slow and shaky answers keep the hand safe, never two messages under way",
          "[inverse3_faults]") {
    simulated::Scene scene;
    scene.behaviour.delay =
        GENERATE(std::chrono::microseconds(200), std::chrono::microseconds(2000),
                 std::chrono::microseconds(5000), std::chrono::microseconds(100000));
    scene.behaviour.jitter = scene.behaviour.delay;
    ServiceDesk desk(scene);
    const bool usable = scene.behaviour.delay < milliseconds(5);
    if (usable) {
        CHECK(desk.begins_to_press());
    } else {
        desk.tick_for(milliseconds(1500));
        CHECK(desk.strongest_after({}, milliseconds(400)) < 0.2);
        CHECK(desk.stage() == Stage::slow);
        CHECK(desk.sentence().find("too slowly") != std::string::npos);
    }
    CHECK(desk.service.too_many_in_flight() == 0);
}

TEST_CASE("whether the service is not installed, not running, or too old is told",
          "[inverse3_faults]") {
    simulated::Service service;
    ConnectionOptions options = options_for(service);
    SECTION("not installed") {
        service.refuse();
        service.with([](simulated::Scene& scene) { scene.behaviour.http_older = false; });
        TickingDevice<Inverse3Device> loop(options);
        CHECK(loop.tick_until([&] {
            return loop.device.status().sentence.find("not installed") != std::string::npos;
        }));
    }
    SECTION("not running") {
        service.refuse();
        service.with([](simulated::Scene& scene) { scene.behaviour.http_older = false; });
        options.installed_as = {"/proc/self/exe"};
        TickingDevice<Inverse3Device> loop(options);
        CHECK(loop.tick_until([&] {
            return loop.device.status().sentence.find("not running") != std::string::npos;
        }));
    }
    SECTION("too old") {
        service.with([](simulated::Scene& scene) { scene.behaviour.version = "3.0.2"; });
        TickingDevice<Inverse3Device> loop(options);
        CHECK(loop.tick_until([&] { return loop.device.status().stage == Stage::too_old; }));
        CHECK(loop.device.status().sentence.find("3.0.2") != std::string::npos);
    }
}
