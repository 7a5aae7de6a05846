// The other algorithms' proxies beside the running one.
#include "core/loop/other_proxies.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/haptics/surface.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/core/loop/loop_bench.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr int kColumns = 48;
constexpr int kRows = 36;
constexpr double kFrame_s = 0.033;
constexpr int kTicks = 2400;

/// Different frames of the same kind of hostile ground, as a player publishes them.
class HostileVideo {
  public:
    explicit HostileVideo(std::size_t kind) {
        for (int k = 0; k < 12; ++k) {
            DepthImage image = hostile_surfaces(kColumns + 2 * k, kRows).at(kind).image;
            image = image_of(kColumns, kRows, 255.0, [&](int i, int j) { return image.at(i, j); });
            images_.push_back(std::make_shared<const DepthImage>(std::move(image)));
            const float way = 6.0F * static_cast<float>(k % 5) - 11.0F;
            MotionField field{kColumns, kRows, {}};
            for (int i = 0; i < kColumns * kRows; ++i)
                field.ways.push_back({way, 0.1F * static_cast<float>(i % kColumns)});
            fields_.push_back(std::make_shared<const MotionField>(std::move(field)));
        }
    }

    /// The window published at `now_s`; its frames change with `discontinuity`.
    [[nodiscard]] FrameWindow at(double now_s, std::uint64_t discontinuity) const {
        FrameWindow window;
        window.count = FrameWindow::kFrames;
        window.discontinuity = discontinuity;
        const auto first = static_cast<std::size_t>(now_s / kFrame_s);
        for (std::size_t k = 0; k < window.count; ++k) {
            Frame& frame = window.frames[k];
            const std::size_t which = (first + k + 3 * discontinuity) % images_.size();
            frame.depth = images_[which];
            frame.motion = fields_[which];
            frame.time_s = static_cast<double>(first + k) * kFrame_s + (discontinuity > 0 ? 9 : 0);
            frame.media_s = frame.time_s;
        }
        window.clock = {std::chrono::steady_clock::time_point{}, discontinuity > 0 ? 9.0 : 0.0,
                        1.0};
        return window;
    }

  private:
    std::vector<std::shared_ptr<const DepthImage>> images_{};
    std::vector<std::shared_ptr<const MotionField>> fields_{};
};

/// A hand that presses, drags, jumps, lifts, gives no number, and a person who changes parameters,
/// over a video that is sought in. What it does depends on nothing but the tick.
class HostileDrag {
  public:
    HostileDrag(const HostileVideo& video, Algorithm algorithm) : video_(video) {
        bench.handed.parameters.algorithm = algorithm;
        bench.handed.parameters.carry = true;
        bench.handed.compare_algorithms = true;
        HapticConnections connections = bench.connections();
        connections.walked = walked.get();
        tick_ = std::make_unique<HapticTick>(connections);
        hand_over();
    }

    /// The next tick, and its results.
    WalkedTick next() {
        const int k = ticks_++;
        const double now_s = 0.001 * k;
        if (plays && k % 33 == 0) {
            const FrameWindow window = video_.at(now_s, k > kTicks / 2 ? 1 : 0);
            bench.frames.publish(window);
            pictures.publish(window);
        }
        if (k % 400 == 200) {
            bench.handed.parameters.shape.relief_px = k % 800 == 200 ? 120.0 : 255.0;
            bench.handed.parameters.friction = {0.6, k % 800 == 200 ? 0.1 : 0.5};
            bench.handed.bump = k % 800 == 200 ? bumps_ : nullptr;
            bench.handed.parameters.shape.roughness_px = 4.0;
            hand_over();
        }
        bench.hand.goal = goal_at(k);
        bench.hand.lifted = k % 700 > 680;
        bench.hand.hand_changed = k % 550 == 549;
        const std::chrono::steady_clock::time_point begin{std::chrono::milliseconds(k)};
        tick_->run({begin, 0.001, {}, false}, 0);
        WalkedTick left;
        while (walked->pop(left)) last_ = left;
        return last_;
    }

    void hand_over() { bench.hand_over(); }

    Bench bench{};
    bool plays{true};  // the video does; else its frames stay
    TripleBuffer<FrameWindow> pictures{};
    std::unique_ptr<WalkedTickRing> walked{std::make_unique<WalkedTickRing>()};
    [[nodiscard]] const std::shared_ptr<const BumpMap>& bump() const { return bench.handed.bump; }

  private:
    [[nodiscard]] static Vec3 goal_at(int k) {
        if (k % 900 == 450) return Vec3{NAN, 0.0, 0.0};
        const double jump = k % 300 < 150 ? 0.0 : 9.0;
        return {24.0 + 26.0 * std::sin(0.011 * k) + jump, 18.0 + 20.0 * std::sin(0.017 * k),
                110.0 + 170.0 * std::cos(0.009 * k)};
    }

    const HostileVideo& video_;
    std::shared_ptr<const BumpMap> bumps_{
        std::make_shared<BumpMap>(BumpMap{2, 2, {0.0F, 1.0F, 1.0F, 0.0F}, {}})};
    std::unique_ptr<HapticTick> tick_{};
    WalkedTick last_{};
    int ticks_{0};
};

/// The ticks as they would be if another algorithm ran: this one's is then among the others.
Algorithm other_than(Algorithm algorithm) {
    return algorithm == Algorithm::dibhr ? Algorithm::god_object : Algorithm::dibhr;
}

WalkedTick as_of_another(WalkedTick tick) {
    tick.parameters.algorithm = other_than(tick.parameters.algorithm);
    return tick;
}

const Proxy* proxy_of(const std::vector<AlgorithmProxy>& all, Algorithm algorithm) {
    const auto found = std::find_if(all.begin(), all.end(), [algorithm](const AlgorithmProxy& one) {
        return one.algorithm == algorithm;
    });
    return found == all.end() ? nullptr : &found->proxy;
}

/// OtherProxies with the ticks one by one.
struct Follower {
    void follow(HostileDrag& drag, const WalkedTick& tick) {
        REQUIRE(ring->push(tick));
        others.follow(*ring, drag.pictures, drag.bump());
    }
    std::unique_ptr<WalkedTickRing> ring{std::make_unique<WalkedTickRing>()};
    OtherProxies others{};
};

}  // namespace

TEST_CASE("beside any algorithm, each other one's proxy is where it would be had it run",
          "[side by side]") {
    const HostileVideo video(GENERATE(some_of(std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7}, 1)));
    const Algorithm felt = GENERATE(Algorithm::dibhr, Algorithm::pga);
    HostileDrag drag(video, felt);
    Follower follower;
    std::vector<std::unique_ptr<HostileDrag>> runs;
    for (const Algorithm algorithm : all_algorithms())
        runs.push_back(std::make_unique<HostileDrag>(video, algorithm));
    int in_contact = 0;
    int apart = 0;
    for (int k = 0; k < kTicks; ++k) {
        const WalkedTick tick = drag.next();
        follower.follow(drag, tick);
        const std::vector<AlgorithmProxy> others = follower.others.proxies();
        REQUIRE(others.size() == all_algorithms().size() - 1);
        CHECK(proxy_of(others, felt) == nullptr);
        for (const auto& run : runs) {
            const WalkedTick own = run->next();
            if (own.parameters.algorithm == felt) continue;
            const Proxy& beside = *proxy_of(others, own.parameters.algorithm);
            CAPTURE(k, name_of(own.parameters.algorithm));
            REQUIRE(beside == own.proxy);
            in_contact += own.proxy.contact ? 1 : 0;
            apart += own.proxy.position != tick.proxy.position ? 1 : 0;
        }
    }
    CHECK(in_contact > kTicks);
    CHECK(apart > kTicks / 10);
}

TEST_CASE(
    "whenever one begins to look, the algorithm of the loop is at the loop's proxy from then on",
    "[side by side]") {
    const HostileVideo video(GENERATE(some_of(std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7}, 1)));
    const Algorithm algorithm =
        GENERATE(Algorithm::dibhr, Algorithm::pga, Algorithm::neighborhood, Algorithm::god_object);
    HostileDrag drag(video, algorithm);
    Follower follower;
    const int begins = GENERATE(137, 1000);
    const int each = GENERATE(1, 17);  // ticks a picture
    for (int k = 0; k < begins; ++k) (void)drag.next();
    CHECK(follower.others.proxies().empty());
    for (int k = begins; k < kTicks; ++k) {
        const WalkedTick tick = drag.next();
        REQUIRE(follower.ring->push(as_of_another(tick)));
        if (k % each != 0) continue;
        follower.others.follow(*follower.ring, drag.pictures, drag.bump());
        CAPTURE(k);
        const auto others = follower.others.proxies();
        REQUIRE_FALSE(others.empty());
        REQUIRE(*proxy_of(others, algorithm) == tick.proxy);
    }
}

TEST_CASE("after ticks that were lost all begin anew where the running proxy is",
          "[side by side]") {
    const HostileVideo video(5);
    HostileDrag drag(video, Algorithm::dibhr);
    Follower follower;
    for (int k = 0; k < 300; ++k) follower.follow(drag, drag.next());
    drag.plays = false;
    std::uint64_t lost = 0;
    for (std::uint64_t k = 0; k < WalkedTickRing::room() + 200; ++k)
        lost += follower.ring->push(as_of_another(drag.next())) ? 0 : 1;
    REQUIRE(lost == 200);
    follower.others.follow(*follower.ring, drag.pictures, drag.bump());
    const WalkedTick next = drag.next();
    follower.follow(drag, next);
    REQUIRE(next.proxy.contact);
    const auto others = follower.others.proxies();
    REQUIRE(others.size() == all_algorithms().size() - 1);
    for (const AlgorithmProxy& other : others) CHECK(other.proxy == next.proxy);
    for (int k = 0; k < 300; ++k) {
        const WalkedTick tick = drag.next();
        follower.follow(drag, as_of_another(tick));
        REQUIRE(*proxy_of(follower.others.proxies(), Algorithm::dibhr) == tick.proxy);
    }
}

TEST_CASE("nothing is said of proxies over frames that nobody has seen, or once it is forgotten",
          "[side by side]") {
    const HostileVideo video(7);
    HostileDrag drag(video, Algorithm::dibhr);
    Follower follower;
    TripleBuffer<FrameWindow> nothing;
    for (int k = 0; k < 100; ++k) {
        REQUIRE(follower.ring->push(drag.next()));
        follower.others.follow(*follower.ring, nothing, drag.bump());
        REQUIRE(follower.others.proxies().empty());
    }
    follower.follow(drag, drag.next());
    CHECK_FALSE(follower.others.proxies().empty());
    WalkedTick of_another_time = drag.next();  // where an image of before was in memory
    of_another_time.from.time_s += 100.0;
    follower.follow(drag, of_another_time);
    CHECK(follower.others.proxies().empty());
    REQUIRE(follower.ring->push(drag.next()));
    follower.others.forget(*follower.ring);
    CHECK(follower.others.proxies().empty());
    CHECK(follower.ring->size() == 0);
}

TEST_CASE("another algorithm goes on from the proxy, and the one before it from where it was",
          "[side by side]") {
    const HostileVideo video(5);
    HostileDrag drag(video, Algorithm::dibhr);
    HostileDrag unchanged(video, Algorithm::dibhr);
    Follower follower;
    for (int k = 0; k < 1200; ++k) {
        if (k == 620) {
            drag.bench.handed.parameters.algorithm = Algorithm::pga;
            drag.hand_over();
        }
        const WalkedTick tick = drag.next();
        const WalkedTick before = unchanged.next();
        follower.follow(drag, tick);
        const auto others = follower.others.proxies();
        CHECK(proxy_of(others, tick.parameters.algorithm) == nullptr);
        if (k >= 620) REQUIRE(*proxy_of(others, Algorithm::dibhr) == before.proxy);
    }
}

TEST_CASE("a tick that is followed allocates nothing, and one that is not leaves nothing",
          "[side by side]") {
    const HostileVideo video(7);
    HostileDrag drag(video, Algorithm::dibhr);
    for (int k = 0; k < 40; ++k) (void)drag.next();  // the frames are handed over at 0 and 33
    CHECK(allocations_in([&] {
              for (int k = 0; k < 20; ++k) (void)drag.next();
          }) == 0);
    drag.bench.handed.compare_algorithms = false;
    drag.hand_over();
    const WalkedTick last = drag.next();
    CHECK(drag.next().tick == last.tick);
}
