// Surfaces felt and seen between two frames, against scenes that are known at every time.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/haptics/touch.hpp"
#include "core/video/motion/frame_motion.hpp"
#include "core/video/motion/in_betweens.hpp"
#include "core/video/motion/motion_track.hpp"
#include "core/video/playing/depth_timeline.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/playing/playback.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/core/video/moving_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using test::MovingScene;
using Shape = MovingScene::Shape;
using Goes = MovingScene::Goes;

namespace {

constexpr MotionRequest kInBetweens{.motion = true, .in_betweens = true};
constexpr CleaningOptions kRaw{.preset = CleaningPreset::raw};

/// Two frames of a scene, connected.
struct Pair {
    Frame from, to;

    Pair(const MovingScene& scene, double frames_per_s)
        : from(scene.frame(0.0, {.brightness = 1.0, .seed = 1})),
          to(scene.frame(1.0 / frames_per_s, {.brightness = 1.0, .seed = 2})) {
        FrameMotion().connect(from, to, kInBetweens);
    }
    [[nodiscard]] DepthBlend at(double blend) const { return {&from, &to, blend}; }
    /// The same frames without in-betweens, so that they fade.
    [[nodiscard]] Pair faded() const {
        Pair pair = *this;
        pair.from.motion = nullptr;
        pair.from.in_betweens = nullptr;
        return pair;
    }
};

/// A film in memory.
class Film : public Media {
  public:
    explicit Film(std::vector<Frame> frames) : frames_(std::move(frames)) {
        description_.colour_path = description_.depth_path = "film";
        description_.depth_columns = description_.colour_columns = frames_[0].depth->columns;
        description_.depth_rows = description_.colour_rows = frames_[0].depth->rows;
        description_.frames_per_s = 30.0;
        description_.frames = static_cast<std::int64_t>(frames_.size());
    }
    [[nodiscard]] const MediaDescription& description() const override { return description_; }
    std::optional<RawFrame> next() override {
        if (at_ >= frames_.size()) return std::nullopt;
        RawFrame raw;
        raw.depth = *frames_[at_].depth;
        raw.colour = *frames_[at_].colour;
        raw.colour_of_view = true;
        raw.media_s = frames_[at_].media_s;
        raw.index = static_cast<std::int64_t>(at_++);
        return raw;
    }
    void seek(double media_s) override {
        at_ = 0;
        while (at_ + 1 < frames_.size() && frames_[at_ + 1].media_s <= media_s + 1e-6) ++at_;
    }

  private:
    std::vector<Frame> frames_;
    MediaDescription description_{};
    std::size_t at_{0};
};

MovingScene hand_at(double px_per_s) {
    return MovingScene({Shape::hand, Goes::along, px_per_s, 320, 240});
}

/// Made once, for all cases.
const Pair& pair_of_a_hand() {
    static const Pair pair(hand_at(200.0), 30.0);
    return pair;
}

std::unique_ptr<Media> waving_hand() {
    static const std::vector<Frame> frames =
        test::film(hand_at(200.0), 5, 30.0, {.brightness = 1.0}, false);
    return std::make_unique<Film>(frames);
}

/// Mean absolute errors near outlines: where another object is within the way moved in this time.
struct OutlineError {
    double elevation_px{0.0};
    double brightness{0.0};
};

OutlineError outline_error(const DepthBlend& shown, const MovingScene& scene, double t_s,
                           double reach_px) {
    OutlineError error;
    double count = 0.0;
    const DepthSurface surface = shown.surface({.relief_px = 255.0});
    const Frame truth = scene.frame(t_s);
    const std::vector<std::uint8_t>& before = shown.with_in_betweens().from->colour->rgb;
    const std::vector<std::uint8_t>& after = shown.with_in_betweens().to->colour->rgb;
    const double blend = shown.with_in_betweens().blend;
    for (int j = 0; j < surface.rows(); ++j)
        for (int i = 0; i < surface.columns(); ++i) {
            const int object = scene.at(t_s, {1.0 * i, 1.0 * j}).object;
            bool is_beside = false;
            for (const double x : {-reach_px, 0.0, reach_px})
                for (const double y : {-reach_px, 0.0, reach_px})
                    is_beside = is_beside || scene.at(t_s, {i + x, j + y}).object != object;
            if (!is_beside) continue;
            const std::size_t k = 3 * shown.from->depth->index(i, j);
            const double bright = std::lerp(1.0 * before[k], 1.0 * after[k], blend);
            error.elevation_px += std::fabs(surface.elevation(i, j) - truth.depth->at(i, j));
            error.brightness += std::fabs(bright - truth.colour->rgb[k]);
            count += 1.0;
        }
    return {error.elevation_px / count, error.brightness / count};
}

}  // namespace

TEST_CASE("half way outlines and colours are far nearer the truth than faded", "[in-betweens]") {
    // The outline of a sphere that turns does not move.
    const auto [shape, goes] =
        GENERATE(some_of<std::pair<Shape, Goes>>({{Shape::hand, Goes::round},
                                                  {Shape::sphere, Goes::along},
                                                  {Shape::sphere, Goes::apart},
                                                  {Shape::hand, Goes::along},
                                                  {Shape::hand, Goes::apart}},
                                                 1));
    const double speed = shape == Shape::hand ? 200.0 : 300.0;
    CAPTURE(static_cast<int>(shape), static_cast<int>(goes));
    const MovingScene scene({shape, goes, speed, 320, 240});
    const Pair moved(scene, 30.0);
    const Pair faded = moved.faded();
    REQUIRE(moved.from.in_betweens);
    const double way_px = speed / 30.0;
    const OutlineError with = outline_error(moved.at(0.5), scene, 0.5 / 30.0, way_px);
    const OutlineError without = outline_error(faded.at(0.5), scene, 0.5 / 30.0, way_px);
    CAPTURE(with.elevation_px, without.elevation_px, with.brightness, without.brightness);
    CHECK(with.elevation_px < 0.25 * without.elevation_px);
    CHECK(with.brightness < 0.4 * without.brightness);
}

TEST_CASE("an outline that goes less than two pixels is nearer the truth, too", "[in-betweens]") {
    const MovingScene scene = hand_at(50.0);
    const Pair moved(scene, 30.0);
    const Pair faded = moved.faded();
    REQUIRE(moved.from.in_betweens);
    const OutlineError with = outline_error(moved.at(0.5), scene, 0.5 / 30.0, 2.0);
    const OutlineError without = outline_error(faded.at(0.5), scene, 0.5 / 30.0, 2.0);
    CAPTURE(with.elevation_px, without.elevation_px);
    CHECK(with.elevation_px < 0.5 * without.elevation_px);
}

TEST_CASE("so many frames lie between that nothing moves far from one to the next",
          "[in-betweens]") {
    const Pair pair(hand_at(150.0), 30.0);
    REQUIRE(pair.from.in_betweens);
    CHECK(pair.from.in_betweens->size() + 1 >= 3);
    CHECK(pair.from.in_betweens->size() + 1 <= static_cast<std::size_t>(kMostParts));
}

TEST_CASE("what does not move blends as it always did", "[in-betweens]") {
    const Pair& pair = pair_of_a_hand();
    REQUIRE(pair.from.in_betweens);
    const double blend = GENERATE(0.1, 0.5, 0.8);
    const DepthSurface moved = pair.at(blend).surface({.relief_px = 255.0});
    const DepthSurface faded{*pair.from.depth, *pair.to.depth, blend, {.relief_px = 255.0}};
    for (const auto& [i, j] : {std::pair{10, 10}, {300, 20}, {20, 220}, {310, 230}})
        CHECK(std::fabs(moved.elevation(i, j) - faded.elevation(i, j)) < 1e-4);
}

TEST_CASE("without motion two frames are as they are, bit by bit", "[in-betweens]") {
    const Pair pair(hand_at(0.0), 30.0);
    CHECK(pair.from.motion == nullptr);
    CHECK(pair.from.in_betweens == nullptr);
    const DepthBlend shown = pair.at(0.3).with_in_betweens();
    CHECK(shown.from == &pair.from);
    CHECK(shown.to == &pair.to);
    CHECK(shown.blend == 0.3);
}

TEST_CASE("the surface is continuous in time, from a frame over all between to the next",
          "[in-betweens]") {
    const Pair& pair = pair_of_a_hand();
    REQUIRE(pair.from.in_betweens);
    const auto parts = static_cast<double>(pair.from.in_betweens->size() + 1);
    for (double k = 1.0; k < parts; k += 1.0) {
        const DepthSurface before = pair.at(k / parts - 1e-9).surface({.relief_px = 255.0});
        const DepthSurface after = pair.at(k / parts + 1e-9).surface({.relief_px = 255.0});
        for (int j = 0; j < before.rows(); j += 3)
            for (int i = 0; i < before.columns(); i += 3)
                REQUIRE(std::fabs(before.elevation(i, j) - after.elevation(i, j)) < 1e-4);
    }
    const DepthSurface first = pair.at(0.0).surface({.relief_px = 255.0});
    const DepthSurface last = pair.at(1.0).surface({.relief_px = 255.0});
    const auto level = [](const Frame& frame) {
        return static_cast<double>(frame.depth->at(160, 120));
    };
    CHECK(first.elevation(160, 120) == level(pair.from));
    CHECK(last.elevation(160, 120) == level(pair.to));
}

TEST_CASE("what was never seen is on its way, too", "[in-betweens]") {
    Pair pair = pair_of_a_hand();
    const std::size_t count = pair.from.depth->levels.size();
    pair.from.unseen = std::make_shared<const std::vector<std::uint8_t>>(count, 1);
    pair.to.unseen = pair.from.unseen;
    const auto between = InBetweenMaker().make(pair.from, pair.to);
    REQUIRE(between);
    for (const Frame& frame : *between) {
        REQUIRE(frame.unseen);
        CHECK(std::count(frame.unseen->begin(), frame.unseen->end(), 1) ==
              static_cast<std::ptrdiff_t>(count));
    }
}

TEST_CASE("a fingertip is felt over what is on its way", "[in-betweens]") {
    Pair pair = pair_of_a_hand();
    for (Frame* frame : {&pair.from, &pair.to}) {
        frame->undilated = frame->depth;
        frame->cleaning.finger = {.radius_px = 6.0, .relief_px = 255.0};
    }
    const auto between = InBetweenMaker().make(pair.from, pair.to);
    REQUIRE(between);
    const Frame& frame = between->front();
    REQUIRE(frame.undilated);
    for (std::size_t k = 0; k < frame.depth->levels.size(); ++k)
        REQUIRE(frame.depth->levels[k] >= frame.undilated->levels[k] - 1e-3F);
}

TEST_CASE("frames of a video are connected to those that follow them", "[in-betweens]") {
    FrameReader reader(waving_hand());
    reader.set_cleaning(kRaw);
    reader.set_motion(kInBetweens);
    auto first = reader.at(0.0);
    REQUIRE(first);
    auto second = reader.after(first->media_s);
    REQUIRE(second);
    SECTION("with all between them, where there is colour") {
        reader.connect(*first, *second);
        CHECK(first->motion);
        CHECK(first->in_betweens);
    }
    SECTION("not with those before them, as at the seam of a loop") {
        reader.connect(*second, *first);
        CHECK(second->motion == nullptr);
        CHECK(second->in_betweens == nullptr);
    }
    SECTION("only if that is asked for") {
        reader.set_motion({});
        reader.connect(*first, *second);
        CHECK(first->motion == nullptr);
        reader.set_motion({.motion = true});
        reader.connect(*first, *second);
        CHECK(first->motion);
        CHECK(first->in_betweens == nullptr);
    }
    SECTION("anew to the same bits, as a replay does") {
        reader.connect(*first, *second);
        Frame again = *first;
        FrameMotion().connect(again, *second, kInBetweens);
        REQUIRE(again.in_betweens->size() == first->in_betweens->size());
        for (std::size_t k = 0; k < again.in_betweens->size(); ++k) {
            CHECK((*again.in_betweens)[k].depth->levels == (*first->in_betweens)[k].depth->levels);
            CHECK((*again.in_betweens)[k].colour->rgb == (*first->in_betweens)[k].colour->rgb);
        }
    }
}

TEST_CASE("what plays is felt and seen on its way", "[in-betweens]") {
    const auto now = Playback::Time{} + std::chrono::seconds(1);
    Playback playback;
    playback.set_cleaning(kRaw);
    playback.set_motion(kInBetweens);
    playback.open(std::make_unique<FrameReader>(waving_hand()), now);
    while (playback.needs_frame())
        if (playback.read_ahead(now)) playback.on_frame_read(now);
    const FrameWindow window = playback.window();
    REQUIRE(window.count == FrameWindow::kFrames);
    for (std::size_t k = 0; k + 1 < window.count; ++k) CHECK(window.frames[k].in_betweens);
    CHECK(window.frames[window.count - 1].in_betweens == nullptr);
    const double half_s = 0.5 * (window.frames[0].time_s + window.frames[1].time_s);
    const DepthBlend shown = window.at(half_s).with_in_betweens();
    CHECK(shown.from != &window.frames[0]);
    CHECK(window.at(half_s).colour_frame().colour != window.frames[0].colour);
}

TEST_CASE("in-betweens come and go with the frames that are there, as another surface",
          "[in-betweens]") {
    const auto now = Playback::Time{} + std::chrono::seconds(1);
    Playback playback;
    playback.set_cleaning(kRaw);
    playback.open(std::make_unique<FrameReader>(waving_hand()), now);
    while (playback.needs_frame())
        if (playback.read_ahead(now)) playback.on_frame_read(now);
    const FrameWindow faded = playback.window();
    CHECK(faded.frames[0].in_betweens == nullptr);
    playback.set_motion(kInBetweens);
    const FrameWindow moved = playback.window();
    CHECK(moved.frames[0].in_betweens);
    CHECK(moved.discontinuity != faded.discontinuity);
    playback.set_motion({.motion = true});
    CHECK(playback.window().frames[0].in_betweens == nullptr);
    CHECK(playback.window().frames[0].motion);
    CHECK(playback.window().discontinuity != moved.discontinuity);
}

namespace {

constexpr double kFramesPerSecond = 30.0;

MovingScene fast_hand() {
    return hand_at(300.0);
}

/// The scene's frames without in-betweens, made once for all cases.
const std::vector<Frame>& faded_film() {
    static const std::vector<Frame> frames =
        test::film(fast_hand(), 4, kFramesPerSecond, {.brightness = 1.0}, false);
    return frames;
}

/// The same frames connected.
const std::vector<Frame>& moved_film() {
    static const std::vector<Frame> connected = [] {
        std::vector<Frame> frames = faded_film();
        FrameMotion motion;
        for (std::size_t k = 0; k + 1 < frames.size(); ++k)
            motion.connect(frames[k], frames[k + 1], kInBetweens);
        return frames;
    }();
    return connected;
}

/// A finger that moves over frames that play once, millisecond by millisecond.
class WildFinger {
  public:
    explicit WildFinger(test::Dice& dice) : dice_(dice) {
        parameters_.algorithm = static_cast<Algorithm>(static_cast<int>(dice.uniform(0.0, 4.0)));
        parameters_.carry = dice.uniform(0.0, 1.0) < 0.5;
        parameters_.shape.relief_px = 255.0;
        goal_ = {dice.uniform(60.0, 260.0), dice.uniform(40.0, 220.0), dice.uniform(40.0, 140.0)};
        speed_ = {dice.uniform(-0.4, 0.4), dice.uniform(-0.4, 0.4), dice.uniform(-0.2, 0.2)};
    }

    void go(const std::vector<Frame>& frames, int tick) {
        const DepthBlend pair = depth_at(frames, tick * 0.001);
        const DepthSurface surface = pair.surface(parameters_.shape);
        for (int k = 0; k < 3; ++k) goal_[k] += speed_[k] + dice_.uniform(-0.2, 0.2);
        const SurfaceMotion motion = track_.follow_to(pair, pair.from->motion.get(), 0.001);
        const Touch& touch = renderer_.update(surface, goal_, parameters_, {}, limits_, motion);
        const Vec3 before = std::exchange(last_, touch.sent_force_newton);
        const Vec3 place = touch.proxy.position;
        touched += touch.proxy.contact ? 1 : 0;
        const bool is_on_surface =
            is_finite(place) && place.z >= surface.elevation_at(place.x, place.y) - 1e-8;
        const bool dropped = last_ == Vec3(0.0);
        const bool jumps =
            !dropped && glm::length(last_ - before) > limits_.max_change_newton_per_ms + 1e-12;
        if (is_on_surface && !jumps) return;
        CAPTURE(tick, name_of(parameters_.algorithm), place.x, place.y, place.z, jumps);
        FAIL("off the surface, or a force that jumps");
    }

    long touched{0};

  private:
    test::Dice& dice_;
    TouchParameters parameters_{};
    SafetyLimits limits_{.ramp_s = 0.0};
    TouchRenderer renderer_{};
    MotionTrack track_{};
    Vec3 goal_{0.0}, speed_{0.0}, last_{0.0};
};

}  // namespace

namespace {

void require_touched_without_a_jump(long updates) {
    const std::vector<Frame>& frames = moved_film();
    REQUIRE(frames.front().in_betweens);
    const int ticks = static_cast<int>(1e3 * frames.back().time_s);
    test::Dice dice(11);
    long touched = 0;
    for (long done = 0; done < updates; done += ticks) {
        WildFinger finger(dice);
        for (int tick = 0; tick < ticks; ++tick) finger.go(frames, tick);
        touched += finger.touched;
    }
    CHECK(touched > updates / 5);  // or it would prove little
}

}  // namespace

TEST_CASE("where outlines pass under a proxy it stays on the surface, and no force jumps",
          "[in-betweens]") {
    require_touched_without_a_jump(30'000);
}

TEST_CASE("where outlines pass under a proxy no force jumps in a million updates",
          "[in-betweens][long]") {
    require_touched_without_a_jump(1'000'000);
}

namespace {

struct Cost {
    double ms{0.0};     ///< of this thread
    double moves{0.0};  ///< primitives visited
};

/// The cost of `count` updates, each with its own surface.
Cost cost_of_updates(const std::vector<Frame>& frames, int count) {
    TouchRenderer renderer;
    TouchParameters parameters;
    parameters.shape.relief_px = 255.0;
    const double last_s = frames.back().time_s;
    Cost cost;
    timespec begin{}, end{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
    for (int k = 0; k < count; ++k) {
        const double t_s = std::fmod(k * 0.001, last_s);
        const DepthSurface surface = depth_at(frames, t_s).surface(parameters.shape);
        const double x = 160.0 + 60.0 * std::sin(0.01 * k);
        const double y = 130.0 + 40.0 * std::cos(0.013 * k);
        const Vec3 goal{x, y, surface.elevation_at(x, y) - 8.0};
        cost.moves += renderer.update(surface, goal, parameters, {}, {}).proxy.moves;
    }
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    cost.ms = 1e3 * static_cast<double>(end.tv_sec - begin.tv_sec) +
              1e-6 * static_cast<double>(end.tv_nsec - begin.tv_nsec);
    return cost;
}

}  // namespace

TEST_CASE("an update over in-betweens visits no more than half as many primitives again",
          "[in-betweens]") {
    const Cost faded = cost_of_updates(faded_film(), 3000);
    const Cost moved = cost_of_updates(moved_film(), 3000);
    CAPTURE(faded.moves, moved.moves);
    REQUIRE(faded.moves > 0.0);
    CHECK(moved.moves <= 1.5 * faded.moves);
}

// 1.0 to 1.3 times as long were measured.
TEST_CASE("an update over in-betweens takes less than three times as long",
          "[in-betweens][bench]") {
    double faded_ms = std::numeric_limits<double>::infinity();
    double moved_ms = faded_ms;
    for (int run = 0; run < 7; ++run) {
        faded_ms = std::min(faded_ms, cost_of_updates(faded_film(), 5000).ms);
        moved_ms = std::min(moved_ms, cost_of_updates(moved_film(), 5000).ms);
    }
    WARN("with in-betweens " << moved_ms / faded_ms << " times as long");
    CHECK(moved_ms < 3.0 * faded_ms);
}

namespace {

/// A finger moves with the hand and presses on its palm with much friction: its distance at the end
/// from the point that it touched first [px].
double astray_px(const std::vector<Frame>& frames, bool carry) {
    constexpr double kPressed_px = 20.0;
    const MovingScene scene = fast_hand();
    const auto over_palm = [&scene](double t_s, double up_px) {
        const MovingScene::Point at = scene.gone(0.0, {135.0, 135.0}, t_s);
        return Vec3(at.x, at.y, scene.at(t_s, at).elevation_px + up_px);
    };
    TouchParameters parameters;
    parameters.shape.relief_px = 255.0;
    parameters.friction = {5.0, 5.0};
    parameters.carry = carry;
    TouchRenderer renderer;
    MotionTrack track;
    Vec2 touched(0.0), place(0.0);
    const int ticks = static_cast<int>(1e3 * frames.back().time_s);
    for (int tick = 0; tick < ticks; ++tick) {
        const DepthBlend pair = depth_at(frames, tick * 0.001);
        const SurfaceMotion motion = track.follow_to(pair, pair.from->motion.get(), 0.001);
        const Vec3 goal = over_palm(tick * 0.001, tick == 0 ? 2.0 : -kPressed_px);
        place = Vec2(renderer
                         .update(pair.surface(parameters.shape), goal, parameters, {},
                                 {.max_goal_speed_mm_per_ms = 1e3}, motion)
                         .proxy.position);
        if (tick == 1) touched = place;
    }
    const MovingScene::Point there = scene.gone(0.001, {touched.x, touched.y}, (ticks - 1) * 0.001);
    return glm::length(place - Vec2(there.x, there.y));
}

}  // namespace

TEST_CASE("a finger that presses on what moves in a film goes along with it", "[in-betweens]") {
    CHECK(astray_px(moved_film(), true) < 1.0);
    CHECK(astray_px(moved_film(), false) > 10.0);
}

TEST_CASE("runs without a clock have them, too", "[in-betweens]") {
    DepthTimeline depth(waving_hand(), DepthTimeline::Wanted::all, kRaw, kInBetweens);
    depth.advance_to(0.05);
    CHECK(depth.now().from->in_betweens);
    CHECK(depth.now().with_in_betweens().from != depth.now().from);
}
