// What is live for a long time, by the machine's clock: no drift from a clock that runs at another
// rate, no growing memory, and every flash in the depth felt in time. DIBHR_SOAK_SECONDS: ten
// minutes are looked at by hand.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/live/senders.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/own_memory.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Clock = std::chrono::steady_clock;

namespace {

constexpr double kRate = 30.0;
constexpr double kTooQuick = 1.0003;  ///< a source's clock, as bad as they come
constexpr int kEvery = 30;            ///< frames between two flashes

double megabytes() {
    return static_cast<double>(resident_bytes()) / 1048576.0;
}

/// One a second.
std::size_t flashes_to_feel() {
    const char* const seconds = std::getenv("DIBHR_SOAK_SECONDS");
    return seconds == nullptr ? 25 : std::strtoul(seconds, nullptr, 10);
}

double level_of(const FrameWindow& window, Clock::time_point now) {
    const DepthBlend blend = window.at(window.clock.playback_s(now));
    if (!blend.makes_surface()) return 0.0;
    const double from = static_cast<double>(blend.from->depth->at(80, 60));
    return from + blend.blend * (static_cast<double>(blend.to->depth->at(80, 60)) - from);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

}  // namespace

TEST_CASE("what is live for long neither drifts nor grows", "[soak][realtime]") {
    const int port = free_port();
    std::atomic<Clock::time_point> flashed{Clock::time_point{}};
    PictureSender::Asked asked;
    asked.frames_per_s = kRate;
    asked.clock_rate = kTooQuick;
    asked.level = [](int k, int i, int j) {
        const int shaken = (k * 31 + i * 17 + j * 7) % 60;
        return static_cast<std::uint16_t>((k % kEvery >= kEvery / 2 ? 40000 : 10000) + shaken);
    };
    asked.late = [](int k) { return std::chrono::milliseconds(k * 13 % 9); };
    asked.sent = [&](int k, Clock::time_point when) {
        if (k % kEvery == kEvery / 2) flashed = when;
    };
    const PictureSender sender(port, asked);
    DepthRequest request{.find_out = true};
    request.command_line.unit = DepthUnit::levels;
    request.command_line.near = NearLevels::bright;
    request.command_line.range = DepthRange{65535.0, 0.0};
    request.command_line.packing = DepthPacking::separate;
    Player player;
    player.play_media(open_media(PictureSender::url(port), {}, request), 1);
    REQUIRE(eventually([&] { return player.haptics().front().count > 1; }));
    std::vector<double> delays_ms;
    bool was_high = true;
    const auto feel = [&](std::size_t flashes) {
        while (delays_ms.size() < flashes) {
            const auto now = Clock::now();
            const bool high = level_of(player.haptics().front(), now) > 37000.0;
            if (high && !was_high)
                delays_ms.push_back(
                    std::chrono::duration<double, std::milli>(now - flashed.load()).count());
            was_high = high;
            std::this_thread::sleep_for(std::chrono::microseconds(500));  // a quick loop
        }
    };
    feel(5);  // the surface has its pace, and memory what is kept
    delays_ms.clear();
    const double before_mb = megabytes();
    const std::size_t flashes = std::max<std::size_t>(flashes_to_feel(), 20);
    for (std::size_t minute = 60; minute < flashes; minute += 60) {
        feel(minute);
        std::printf("%4zu s: felt after %.1f ms, said %.1f ms, %lld left out, %.1f MB\n", minute,
                    median({delays_ms.end() - 30, delays_ms.end()}),
                    1000.0 * player.status().live->behind_s,
                    static_cast<long long>(player.status().live->dropped), megabytes());
        std::fflush(stdout);
    }
    feel(flashes);
    const std::vector<double> first_ms(delays_ms.begin(), delays_ms.begin() + 10);
    const std::vector<double> last_ms(delays_ms.end() - 10, delays_ms.end());
    CHECK(median(delays_ms) <= 2000.0 / kRate + 10.0);
    CHECK(std::fabs(median(last_ms) - median(first_ms)) < 10.0);
    CHECK(megabytes() - before_mb < 8.0);
    CHECK(player.status().live->signal);
}
