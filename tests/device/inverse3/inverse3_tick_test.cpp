// The haptic loop with the simulated service at its own speed: how old poses are, and that there is
// never more than one message in flight, over very many exchanges.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "tests/device/inverse3/service_desk.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::test::inverse3;
using Clock = simulated::Clock;
using std::chrono::microseconds;

constexpr std::uint64_t kExchanges = DIBHR_SANITIZED ? 10'000 : 30'000;

/// DIBHR_INVERSE3_EXCHANGES=1000000 is the long form.
std::uint64_t exchanges_wanted() {
    const char* given = std::getenv("DIBHR_INVERSE3_EXCHANGES");
    return given == nullptr ? kExchanges : std::strtoull(given, nullptr, 10);
}

double ms(std::chrono::nanoseconds span) {
    return std::chrono::duration<double, std::milli>(span).count();
}

std::chrono::nanoseconds quantile(std::vector<std::chrono::nanoseconds> ages, double q) {
    const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(ages.size() - 1));
    std::nth_element(ages.begin(), ages.begin() + at, ages.end());
    return ages[static_cast<std::size_t>(at)];
}

}  // namespace

TEST_CASE("there is never more than one message in flight, and each has its answer",
          "[inverse3_tick]") {
    simulated::Service service;
    TickingDevice<Inverse3Device> loop(options_for(service));
    REQUIRE(loop.tick_until_ready());
    loop.force_newton = {0.0, 0.0, 1.0};
    const auto began = Clock::now();
    const std::uint64_t before = service.exchanges();
    const std::uint64_t wanted = exchanges_wanted();
    // Without a pause: each new force lets the next message go at once.
    while (service.exchanges() - before < wanted && Clock::now() - began < std::chrono::minutes(8))
        loop.tick();
    const std::chrono::duration<double> passed = Clock::now() - began;
    const std::uint64_t exchanges = service.exchanges() - before;
    std::cout << exchanges << " exchanges, " << static_cast<double>(exchanges) / passed.count()
              << " a second\n";
    CHECK(exchanges >= wanted);
    CHECK(service.too_many_in_flight() == 0);
    CHECK(service.not_understood() == 0);
    CHECK(loop.device.status().unasked == 0);
    CHECK(loop.device.status().not_understood == 0);
    // A machine that was busy at the end may have made the service slow.
    CHECK(loop.tick_until([&] { return loop.device.status().stage == Stage::ready; },
                          std::chrono::milliseconds(10'000)));
}

TEST_CASE("poses are young with a service of 1 and of 4 kHz", "[inverse3_tick]") {
    simulated::Scene scene;
    scene.manners.tick = GENERATE(microseconds(1000), microseconds(250), microseconds(0));
    simulated::Service service(scene);
    TickingDevice<Inverse3Device> loop(options_for(service));
    REQUIRE(loop.tick_until_ready());
    loop.tick_for(std::chrono::milliseconds(200));
    std::vector<std::chrono::nanoseconds> ages;
    const std::uint64_t before = service.exchanges();
    const auto began = Clock::now();
    (void)loop.tick_until(
        [&] {
            ages.push_back(loop.device.pose_age());
            return false;
        },
        std::chrono::milliseconds(3000));
    const std::chrono::duration<double> passed = Clock::now() - began;
    std::cout << "tick of the service " << scene.manners.tick.count()
              << " us: " << static_cast<double>(service.exchanges() - before) / passed.count()
              << " exchanges a second; age of the pose p50 " << ms(quantile(ages, 0.5)) << ", p99 "
              << ms(quantile(ages, 0.99)) << ", worst " << ms(quantile(ages, 1.0)) << " ms\n";
    CHECK(ages.size() > 2000);
    if (!DIBHR_SANITIZED) CHECK(quantile(ages, 0.99) < microseconds(2000));
}
