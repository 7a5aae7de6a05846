// Contact episodes and speeds: which ticks belong to one touch, and its statistics.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "core/haptics/surface.hpp"
#include "core/report/contact_episodes.hpp"
#include "tests/core/report/made_session.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kTick_s = 0.001;
constexpr double kPitch_mm = 0.1;

std::vector<Episode> episodes_of(const std::vector<TickRecord>& ticks) {
    ContactEpisodes episodes;
    for (const TickRecord& tick : ticks) episodes.add(tick, kTick_s, kPitch_mm);
    return episodes.finish();
}

}  // namespace

TEST_CASE("an episode begins with the first tick in contact and ends with the last", "[report]") {
    const auto episodes = episodes_of(ticks_touching(300, 100, 200));
    REQUIRE(episodes.size() == 1);
    CHECK_THAT(episodes[0].begin_s, WithinAbs(0.1, 1e-12));
    CHECK_THAT(episodes[0].length_s(), WithinAbs(0.1, 1e-12));
    CHECK_THAT(episodes[0].contact_s, WithinAbs(0.1, 1e-12));
    CHECK(episodes_of(ticks_touching(300, 0, 0)).empty());
}

TEST_CASE("an episode that goes on at the end of the session counts", "[report]") {
    const auto episodes = episodes_of(ticks_touching(300, 299, 300));
    REQUIRE(episodes.size() == 1);
    CHECK_THAT(episodes[0].length_s(), WithinAbs(kTick_s, 1e-12));
}

TEST_CASE("gaps shorter than 20 ms are joined, and count for the length but not for the contact",
          "[report]") {
    const std::int64_t gap = GENERATE(1, 2, 19, 20, 21, 300);
    CAPTURE(gap);
    auto ticks = ticks_touching(100, 0, 100);
    for (std::int64_t k = 100; k < 100 + gap; ++k) ticks.push_back(tick_above(k));
    for (std::int64_t k = 100 + gap; k < 200 + gap; ++k) {
        ticks.push_back(tick_in_contact(k, 150.0, 100.0));
    }
    const auto episodes = episodes_of(ticks);
    if (gap >= 20) {
        CHECK(episodes.size() == 2);
        return;
    }
    REQUIRE(episodes.size() == 1);
    CHECK_THAT(episodes[0].length_s(), WithinAbs(0.2 + kTick_s * static_cast<double>(gap), 1e-12));
    CHECK_THAT(episodes[0].contact_s, WithinAbs(0.2, 1e-12));
    CHECK_THAT(episodes[0].path_mm, WithinAbs(0.0, 1e-12));  // the path across the gap is not known
}

TEST_CASE("ticks missing in the file are a gap, a long tick is none", "[report]") {
    std::vector<TickRecord> ticks = ticks_touching(50, 0, 50);
    SECTION("missing ticks") {
        for (std::int64_t k = 100; k < 150; ++k) ticks.push_back(tick_in_contact(k, 100.0, 100.0));
        CHECK(episodes_of(ticks).size() == 2);
    }
    SECTION("a long tick") {
        for (std::int64_t k = 50; k < 100; ++k) {
            ticks.push_back(tick_in_contact(k, 100.0, 100.0));
            ticks.back().t_s += 0.05;
        }
        CHECK(episodes_of(ticks).size() == 1);
    }
}

TEST_CASE("an episode ends where the hand lets go or another video comes", "[report]") {
    auto ticks = ticks_touching(200, 0, 200);
    const bool releases_contact = GENERATE(true, false);
    ticks[100].releases_contact = releases_contact;
    for (std::size_t k = 100; k < 200; ++k) ticks[k].frames.source.media = releases_contact ? 1 : 2;
    const auto episodes = episodes_of(ticks);
    REQUIRE(episodes.size() == 2);
    CHECK_THAT(episodes[0].end_s, WithinAbs(0.1, 1e-12));
    CHECK_THAT(episodes[1].begin_s, WithinAbs(0.1, 1e-12));
}

TEST_CASE("an episode tells its forces, path, place, primitives and the video's time", "[report]") {
    std::vector<TickRecord> ticks;
    for (int k = 0; k < 100; ++k) {  // half a pixel a tick to the right, the force rises
        ticks.push_back(tick_in_contact(k, 200.0 + 0.5 * k, 80.0, 0.01 * k));
        ticks.back().video_s = 3.0 + 0.001 * k;
        ticks.back().primitive = static_cast<std::uint8_t>(k < 60   ? PrimitiveKind::triangle
                                                           : k < 90 ? PrimitiveKind::edge
                                                                    : PrimitiveKind::vertex);
    }
    const auto episodes = episodes_of(ticks);
    REQUIRE(episodes.size() == 1);
    const Episode& episode = episodes[0];
    CHECK_THAT(episode.sent.mean_newton, WithinAbs(0.495, 1e-9));
    CHECK_THAT(episode.sent.peak_newton, WithinAbs(0.99, 1e-12));
    CHECK_THAT(episode.spring.mean_newton, WithinAbs(0.5, 1e-12));
    CHECK_THAT(episode.path_mm, WithinAbs(99 * 0.5 * kPitch_mm, 1e-9));
    CHECK_THAT(episode.mean_speed_mm_per_s(), WithinAbs(49.5, 1e-6));
    CHECK_THAT(episode.centre_px.x, WithinAbs(224.75, 1e-9));
    CHECK_THAT(episode.centre_px.y, WithinAbs(80.0, 1e-9));
    CHECK_THAT(episode.shares.triangle, WithinAbs(0.6, 1e-9));
    CHECK_THAT(episode.shares.edge, WithinAbs(0.3, 1e-9));
    CHECK_THAT(episode.shares.vertex, WithinAbs(0.1, 1e-9));
    CHECK_THAT(episode.video_begin_s, WithinAbs(3.0, 1e-12));
    CHECK_THAT(episode.video_end_s, WithinAbs(3.099, 1e-12));
}

TEST_CASE("no path leads over a jump, and no force is no number", "[report]") {
    auto ticks = ticks_touching(20, 0, 20);
    for (std::size_t k = 10; k < 20; ++k) ticks[k].proxy[2] += 500.0;
    ticks[10].from_zero = true;
    ticks[5].sent_newton[0] = std::numeric_limits<double>::infinity();
    const auto episodes = episodes_of(ticks);
    REQUIRE(episodes.size() == 1);
    CHECK_THAT(episodes[0].path_mm, WithinAbs(0.0, 1e-12));
    CHECK_THAT(episodes[0].sent.peak_newton, WithinAbs(0.5, 1e-12));
}

TEST_CASE("whatever the contacts, episodes are apart and their contact times sum to all of it",
          "[report]") {
    std::mt19937 random(GENERATE(1U, 2U, 3U));
    std::vector<TickRecord> ticks;
    std::int64_t touching = 0;
    while (ticks.size() < 20000) {
        const bool contact = random() % 2 == 0;
        const auto run = 1 + static_cast<int>(random() % 60);
        for (int k = 0; k < run; ++k) {
            const auto number = static_cast<std::int64_t>(ticks.size());
            touching += contact ? 1 : 0;
            ticks.push_back(contact ? tick_in_contact(number, 100.0, 100.0) : tick_above(number));
        }
    }
    const auto episodes = episodes_of(ticks);
    REQUIRE(episodes.size() > 10);
    double contact_s = 0.0;
    for (std::size_t k = 0; k < episodes.size(); ++k) {
        contact_s += episodes[k].contact_s;
        CHECK(episodes[k].contact_s <= episodes[k].length_s() + 1e-9);
        if (k > 0) CHECK(episodes[k].begin_s - episodes[k - 1].end_s >= kJoinedGap_s - 1e-9);
    }
    CHECK_THAT(contact_s, WithinAbs(kTick_s * static_cast<double>(touching), 1e-6));
}

TEST_CASE("a steady move has its speed, whatever the device's steps", "[report]") {
    const double step_px = GENERATE(0.0, 2.0);  // 2 px: a device with coarse steps
    CAPTURE(step_px);
    SpeedWindow window;
    for (int k = 0; k < 400; ++k) {
        TickRecord tick = tick_in_contact(k, 100.0, 100.0);
        const double x = 100.0 + 1.0 * k;
        tick.goal[0] = step_px > 0.0 ? step_px * std::round(x / step_px) : x;
        tick.proxy[0] = 100.0 + 0.5 * k;
        const std::optional<Speeds> speeds = window.add(tick, kPitch_mm);
        REQUIRE(speeds.has_value() == (k >= 20));
        if (!speeds) continue;
        CHECK_THAT(speeds->goal_mm_per_s, WithinAbs(100.0, 10.0 * step_px + 1e-6));
        CHECK_THAT(speeds->proxy_mm_per_s, WithinAbs(50.0, 1e-6));
    }
}

TEST_CASE("a jump has no speed", "[report]") {
    SpeedWindow window;
    double highest = 0.0;
    for (int k = 0; k < 200; ++k) {
        TickRecord tick = tick_in_contact(k, k < 100 ? 100.0 : 500.0, 100.0);
        if (k == 100) tick.releases_contact = true;
        if (const auto speeds = window.add(tick, kPitch_mm)) {
            highest = std::max({highest, speeds->goal_mm_per_s, speeds->proxy_mm_per_s});
        }
    }
    CHECK_THAT(highest, WithinAbs(0.0, 1e-9));
}
