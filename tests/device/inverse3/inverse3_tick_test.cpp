// The haptic loop with the simulated service: the ages of poses, and never more than one message in
// flight, over very many exchanges.
#include <algorithm>
#include <chrono>
#include <cstdint>

#include "tests/device/inverse3/service_desk.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::inverse3;
using std::chrono::microseconds;

/// Without a pause: each new force lets the next message go at once.
void check_exchanges(std::uint64_t wanted) {
    simulated::Service service;
    TickingDevice<Inverse3Device> loop(options_for(service));
    REQUIRE(loop.tick_until_ready());
    loop.force_newton = {0.0, 0.0, 1.0};
    const std::uint64_t before = service.exchanges();
    for (std::uint64_t tick = 0; tick < wanted; ++tick) {
        loop.tick();
        test::let_pass(microseconds(100));
    }
    const std::uint64_t exchanges = service.exchanges() - before;
    CHECK(exchanges >= wanted - 1);
    CHECK(exchanges <= wanted + 1);
    CHECK(service.too_many_in_flight() == 0);
    CHECK(service.not_understood() == 0);
    CHECK(service.connections() == 1);
    CHECK(loop.device.status().unrequested == 0);
    CHECK(loop.device.status().not_understood == 0);
    CHECK(loop.device.status().stage == Stage::ready);
}

}  // namespace

TEST_CASE("there is never more than one message in flight, and each has its answer",
          "[inverse3_tick]") {
    check_exchanges(2'000);
}

TEST_CASE("of very many messages never more than one is in flight, and each has its answer",
          "[inverse3_tick][long]") {
    check_exchanges(DIBHR_SANITIZED ? 10'000 : 50'000);
}

TEST_CASE("poses are young with a service of 1 and of 4 kHz", "[inverse3_tick]") {
    simulated::Scene scene;
    scene.behaviour.tick = GENERATE(microseconds(1000), microseconds(250), microseconds(0));
    CAPTURE(scene.behaviour.tick.count());
    simulated::Service service(scene);
    TickingDevice<Inverse3Device> loop(options_for(service));
    REQUIRE(loop.tick_until_ready());
    loop.tick_times(200);
    const std::uint64_t before = service.exchanges();
    std::chrono::nanoseconds oldest{0};
    constexpr int kTicks = 500;
    for (int tick = 0; tick < kTicks; ++tick) {
        loop.tick_times(1);
        oldest = std::max(oldest, loop.device.pose_age());
    }
    CHECK(oldest < microseconds(2000));
    CHECK(service.exchanges() - before >= kTicks - 1);  // a new pose a tick
}
