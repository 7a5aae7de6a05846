// A hand that is carried by a video, recorded from the haptic tick, replays to the same bits.
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <vector>

#include "core/loop/felt_frames.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/replay/session_replay.hpp"
#include "core/replay/stored_frames.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "core/sound/sound_tick.hpp"
#include "tests/core/haptics/moving_scene.hpp"
#include "tests/core/loop/loop_bench.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kFramesPerSecond = 30.0;
constexpr int kFrames = 45;
constexpr double kTick_s = 0.001;

/// Hills that turn and wander; after the last frame comes the first again.
class WanderingVideo final : public RecordedFrames {
  public:
    explicit WanderingVideo(PointMotion motion = turning({80.0, 48.0}, 1.5, 0.1))
        : scene_(160, 96, kFramesPerSecond, std::move(motion), {[](Vec2 place, double t_s) {
                     return 100.0 +
                            8.0 * std::sin(0.1 * place.x + 2.0 * t_s) * std::cos(0.12 * place.y);
                 }}) {}

    [[nodiscard]] Frame frame_number(int k, double time_s) {
        return {.depth = scene_.depth(k),
                .motion = k == kFrames - 1 ? nullptr : scene_.field(k),
                .time_s = time_s,
                .media_s = k / kFramesPerSecond,
                .index = k,
                .media = 1};
    }
    [[nodiscard]] Frame frame(const FrameSource&, double media_s) override {
        return frame_number(static_cast<int>(std::lround(media_s * kFramesPerSecond)), media_s);
    }
    void connect(Frame& from, const Frame&, const MotionRequest& wanted) override {
        if (!wanted.motion) from.motion.reset();
    }
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters&) override {
        return nullptr;
    }

    /// The frames that a player publishes at `now_s` of its time line.
    [[nodiscard]] FrameWindow window_at(double now_s) {
        FrameWindow window;
        window.count = FrameWindow::kFrames;
        const auto first = static_cast<int>(now_s * kFramesPerSecond);
        for (std::size_t k = 0; k < window.count; ++k) {
            const int count = first + static_cast<int>(k);
            window.frames[k] = frame_number(count % kFrames, count / kFramesPerSecond);
        }
        return window;
    }

  private:
    MovingScene scene_;
};

/// A hand on a tick over that video, with all actions of a person.
class CarriedHand {
  public:
    explicit CarriedHand(WanderingVideo& video) : video_(video) {
        bench.handed.parameters.carry = true;
        bench.handed.parameters.coupling.damping_newton_s_per_m = 3.0;
        bench.handed.parameters.friction = {0.6, 0.5};
        bench.hand_over();
    }

    void run(int ticks) {
        for (int k = 0; k < ticks; ++k) {
            if (plays) now_s_ += kTick_s;
            FrameWindow window = video_.window_at(now_s_);
            window.clock = {{}, now_s_, 0.0};
            window.discontinuity = discontinuity;
            for (Frame& frame : window.frames) {
                if (!knows_motion || other_motion) frame.motion = other_motion;
                if (other_depth) frame.depth = other_depth;
            }
            felt.add(window);
            bench.frames.publish(window);
            const double t = ++ticks_ * kTick_s;
            bench.hand.goal = {80.0 + 20.0 * std::sin(3.0 * t), 48.0 + 15.0 * std::sin(2.0 * t),
                               96.0 - 12.0 * std::sin(1.3 * t)};
            if (!moves_itself) bench.hand.goal = {92.0, 48.0, 90.0};
            if (ticks_ % 611 == 0) bench.hand.goal.x = NAN;
            tick_.run({std::chrono::steady_clock::time_point{std::chrono::milliseconds(ticks_)},
                       kTick_s,
                       {},
                       false},
                      0);
            const HapticState& state = bench.state.front();
            carried += state.touch.carried != Vec3(0.0) ? 1 : 0;
        }
    }
    void seek(double to_s) {
        now_s_ = to_s;
        ++discontinuity;
    }

    Bench bench{};
    FeltFrames felt{};
    bool plays{true};
    bool knows_motion{true};
    // Instead of the video's; null: those.
    std::shared_ptr<const MotionField> other_motion{};
    std::shared_ptr<const DepthImage> other_depth{};
    bool moves_itself{true};
    std::uint64_t discontinuity{0};
    int carried{0};

  private:
    WanderingVideo& video_;
    HapticTick tick_{bench.connections()};
    double now_s_{0.0};
    int ticks_{0};
};

}  // namespace

TEST_CASE("a session of a hand that was carried replays to the same bits", "[carry]") {
    const TemporaryFolder folder;
    const auto file = folder / "carried.dibhr";
    WanderingVideo video;
    CarriedHand hand(video);
    {
        hand.felt.keep(true);
        Recorder recorder(file, *hand.bench.ticks, {}, nullptr, std::chrono::steady_clock::now,
                          {&hand.felt});
        recorder.media(1, "colour.mp4", "depth.mp4");
        recorder.parameters(as_recorded(hand.bench.handed));
        const auto change = [&](auto set) {
            set(hand.bench.handed.parameters);
            hand.bench.hand_over();
            recorder.parameters(as_recorded(hand.bench.handed));
        };
        hand.run(1600);  // beyond the last frame and on with the first
        hand.plays = false;
        hand.run(100);
        hand.plays = true;
        hand.seek(0.51);
        hand.run(400);
        hand.knows_motion = false;
        hand.run(150);
        hand.knows_motion = true;
        hand.bench.hand.hand_changed = true;
        hand.run(300);
        hand.bench.hand.lifted = true;
        hand.run(5);
        hand.bench.hand.lifted = false;
        for (const Algorithm algorithm : all_algorithms()) {
            change([&](TouchParameters& p) { p.algorithm = algorithm; });
            hand.run(400);
        }
        change([](TouchParameters& p) { p.carry = false; });
        hand.run(300);
        change([](TouchParameters& p) { p.carry = true; });
        hand.run(400);
    }
    CHECK(hand.carried > 2000);

    const Session session(file);
    int unknown = 0;
    int differing = 0;
    SessionReplay replay(session, video, {{}, [](TouchParameters& p) { p.carry = false; }, {}});
    while (replay.next()) {
        const TickRecord& recorded = replay.recorded();
        CAPTURE(recorded.tick);
        REQUIRE(same_bits(replay.touch(0), recorded));
        REQUIRE(same_bits(replay.touch(2), recorded));
        differing += same_bits(replay.touch(1), recorded) ? 0 : 1;
        unknown += recorded.motion_unknown ? 1 : 0;
    }
    CHECK(session.rows() == 4855);
    CHECK(differing > 2000);
    CHECK(unknown >= 150);
    CHECK(unknown < 400);  // and while the last frame becomes the first again
    CHECK(session.parameters().front().touch.carry);

    CHECK(session.fact("missing_surfaces") == "0");
    StoredFrames stored(session, {});
    std::vector<ParameterChange> changes{{}};
    for (const Algorithm algorithm : all_algorithms())
        changes.push_back([=](TouchParameters& p) { p.algorithm = algorithm; });
    SessionReplay alone(session, stored, changes);
    SessionReplay whole(session, video, changes);
    while (alone.next() && whole.next()) {
        CAPTURE(alone.recorded().tick);
        REQUIRE(same_bits(alone.touch(0), alone.recorded()));
        for (std::size_t run = 0; run < changes.size(); ++run) {
            CAPTURE(run);
            REQUIRE_FALSE(alone.left_known(run));
            REQUIRE(same_bits(alone.touch(run).proxy.position, whole.touch(run).proxy.position));
        }
    }
}

TEST_CASE("a hand that was carried far when the video jumped replays without it to the same bits",
          "[carry]") {
    // What was under the hand had come 20 px. So the search for what is under it after the jump
    // begins 18 px to the left, where something moves as fast: nothing near the hand does.
    const auto moving_left_of = [](int column) {
        auto field = std::make_shared<MotionField>(MotionField{160, 96, {}});
        for (int k = 0; k < 160 * 96; ++k)
            field->ways.push_back({k % 160 < column ? 20.0F : 0.0F, 0.0F});
        return field;
    };
    const TemporaryFolder folder;
    const auto file = folder / "jump.dibhr";
    WanderingVideo video;
    CarriedHand hand(video);
    hand.moves_itself = false;
    hand.other_depth = flat_frame(160, 96, 100.0F).depth;
    {
        hand.felt.keep(true);
        Recorder recorder(file, *hand.bench.ticks, {}, nullptr, std::chrono::steady_clock::now,
                          {&hand.felt});
        recorder.media(1, "colour.mp4", "depth.mp4");
        recorder.parameters(as_recorded(hand.bench.handed));
        hand.other_motion = moving_left_of(160);
        hand.run(100);
        hand.other_motion = moving_left_of(80);
        hand.seek(1.0 + 0.9 / kFramesPerSecond);
        hand.carried = 0;
        hand.run(3);
    }
    CHECK(hand.carried == 2);
    const Session session(file);
    StoredFrames stored(session, {});
    SessionReplay replay(session, stored, {{}});
    while (replay.next()) {
        CAPTURE(replay.recorded().tick);
        REQUIRE(same_bits(replay.touch(0), replay.recorded()));
        REQUIRE_FALSE(replay.left_known(0));
    }
}

TEST_CASE("what was recorded without carry replays with it, as a change", "[carry]") {
    const TemporaryFolder folder;
    const auto file = folder / "plain.dibhr";
    WanderingVideo video;
    CarriedHand hand(video);
    hand.bench.handed.parameters.carry = false;
    hand.bench.hand_over();
    {
        Recorder recorder(file, *hand.bench.ticks, {});
        recorder.media(1, "colour.mp4", "depth.mp4");
        recorder.parameters(as_recorded(hand.bench.handed));
        hand.run(1500);
    }
    CHECK(hand.carried == 0);
    CarriedHand other(video);
    const Session session(file);
    SessionReplay replay(session, video, {{}, [](TouchParameters& p) { p.carry = true; }});
    int differing = 0;
    while (replay.next()) {
        REQUIRE(same_bits(replay.touch(0), replay.recorded()));
        other.run(1);
        CHECK(replay.touch(1).proxy.position == other.bench.state.front().touch.proxy.position);
        differing += same_bits(replay.touch(1), replay.recorded()) ? 0 : 1;
    }
    CHECK(differing > 500);
}

TEST_CASE("a tick that carries allocates nothing", "[carry]") {
    WanderingVideo video;
    CarriedHand hand(video);
    hand.run(40);
    HapticTick tick(hand.bench.connections());
    run_ticks(tick, 3);
    const int allocations = allocations_in([&] { run_ticks(tick, 20); });
    CHECK(allocations == 0);
}

TEST_CASE("what sticks to what moves makes no sound of rubbing, what it slides under does",
          "[carry]") {
    WanderingVideo video(translating({60.0, 0.0}));
    CarriedHand hand(video);
    const auto sound = std::make_unique<SoundRing>();
    SoundRing::Listener ear(*sound);
    HapticConnections connections = hand.bench.connections();
    connections.sound = sound.get();
    HapticTick tick(connections);
    Bench& bench = hand.bench;
    const double friction = GENERATE(5.0, 0.1);
    bench.handed.parameters.friction = {friction, friction};
    bench.hand_over();
    double way_mm = 0.0;
    Vec3 last_mm(0.0);
    for (int k = 0; k < 800; ++k) {
        FrameWindow window = video.window_at(k * kTick_s);
        for (Frame& frame : window.frames) frame.depth = flat_frame(160, 96, 100.0F).depth;
        window.clock = {{}, k * kTick_s, 0.0};
        bench.frames.publish(window);
        bench.hand.goal = {60.0, 48.0, k == 0 ? 101.0 : 80.0};
        tick.run({std::chrono::steady_clock::time_point{std::chrono::milliseconds(k)},
                  kTick_s,
                  {},
                  false},
                 0);
        SoundTick heard;
        while (ear.pop(heard)) {
            if (k > 2) way_mm += glm::length(heard.proxy_mm - last_mm);
            last_mm = heard.proxy_mm;
        }
    }
    const double slid_mm = friction > 1.0 ? 0.0 : 60.0 * 0.77 * kPaperPitch_mm;
    CHECK_THAT(way_mm, WithinAbs(slid_mm, 0.3));
}
