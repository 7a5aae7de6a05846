// Runs fingers over a filmed scene and over the true scene.
#include "tests/bench/carried.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "core/haptics/touch.hpp"
#include "core/video/motion/frame_motion.hpp"
#include "core/video/motion/in_betweens.hpp"
#include "core/video/motion/motion_track.hpp"

namespace dibhr::bench {

namespace {

using test::MovingScene;
using Point = MovingScene::Point;

constexpr double kTick_s = 0.001;
constexpr double kPressed_px = 20.0;

/// So near to an outline no finger begins or ends [px].
double beside_px(const MovingScene& scene) {
    const bool is_disc = scene.what().shape == MovingScene::Shape::disc;
    return is_disc ? std::min(12.0, 0.4 * scene.size_px()) : 12.0;
}

/// Between places that are tried [px].
double spacing_px(const MovingScene& scene) {
    const bool is_disc = scene.what().shape == MovingScene::Shape::disc;
    return is_disc ? std::min(17.0, 0.3 * scene.size_px()) : 17.0;
}

/// Frames, each with its motion to the next.
std::vector<Frame> seen(const MovingScene& scene, const Filming& filming, int count) {
    std::vector<Frame> frames = test::film(scene, count, filming.frames_per_s,
                                           {.brightness = filming.brightness_levels,
                                            .elevation_px = filming.elevation_px,
                                            .exposure = filming.exposure},
                                           filming.coded);
    FrameMotion motion;
    InBetweenMaker maker;
    for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
        const double from_s = static_cast<double>(k) / filming.frames_per_s;
        if (filming.found) {
            motion.connect(frames[k], frames[k + 1], motion_request(true, InBetweens::automatic));
        } else {
            frames[k].motion = scene.motion(from_s, from_s + 1.0 / filming.frames_per_s);
            frames[k].in_betweens = maker.make(frames[k], frames[k + 1]);
        }
    }
    return frames;
}

/// Frames so close in time that their in-betweens do not matter.
std::vector<Frame> truth(const MovingScene& scene, double seconds) {
    constexpr double kFrames_per_s = 60.0;
    const int count = static_cast<int>(std::ceil(seconds * kFrames_per_s)) + 2;
    std::vector<Frame> frames;
    for (int k = 0; k < count; ++k) {
        frames.push_back(scene.uncoloured(k / kFrames_per_s));
        frames.back().motion = scene.motion(k / kFrames_per_s, (k + 1) / kFrames_per_s);
    }
    return frames;
}

/// A finger that is updated tick by tick over the frames of a film.
class Finger {
  public:
    Finger(const std::vector<Frame>& frames, double friction, bool carry) : frames_(frames) {
        parameters_.shape.relief_px = 255.0;
        parameters_.friction = {friction, friction};
        parameters_.carry = carry;
    }

    const Touch& tick(Vec3 goal, double now_s) {
        const DepthBlend pair = depth_at(frames_, now_s);
        SurfaceMotion motion = track_.follow_to(pair, pair.from->motion.get(), kTick_s);
        const SafetyInput input{.dt_s = kTick_s, .from_zero = begins_};
        begins_ = false;
        return renderer_.update(pair.surface(parameters_.shape), goal, parameters_, input, limits_,
                                motion);
    }

  private:
    const std::vector<Frame>& frames_;
    TouchParameters parameters_{};
    SafetyLimits limits_{.max_goal_speed_mm_per_ms = 1e3};
    TouchRenderer renderer_{};
    MotionTrack track_{};
    bool begins_{true};
};

double median(std::vector<double> values) {
    if (values.empty()) return CarriedFinger::kNone;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double angle_deg(Vec3 a, Vec3 b) {
    const double cosine = glm::dot(a, b) / (glm::length(a) * glm::length(b));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

/// Whether the place and its surroundings are on the object and in the picture.
bool is_on_thing(const MovingScene& scene, double t_s, Point at) {
    const auto& what = scene.what();
    const double beside = beside_px(scene);
    if (at.x < beside || at.y < beside || at.x > what.columns - 1 - beside ||
        at.y > what.rows - 1 - beside)
        return false;
    for (const double x : {-beside, 0.0, beside})
        for (const double y : {-beside, 0.0, beside})
            if (scene.at(t_s, {at.x + x, at.y + y}).object == 0) return false;
    return true;
}

bool is_too_fast(const MovingScene& scene, Point at) {
    constexpr double kMoment_s = 1e-3;
    const Point gone = scene.gone(0.0, at, kMoment_s);
    return std::hypot(gone.x - at.x, gone.y - at.y) >
           1.05 * scene.what().speed_px_per_s * kMoment_s;
}

/// Places of a grid over the picture that stay on the object, inside the picture, and not faster
/// than the scene's speed; a few, evenly chosen.
std::vector<Point> places_that_stay(const MovingScene& scene, double seconds) {
    std::vector<Point> found;
    const double spacing = spacing_px(scene);
    for (double y = 10.3; y < scene.what().rows; y += spacing)
        for (double x = 10.7; x < scene.what().columns; x += spacing) {
            bool stays = !is_too_fast(scene, {x, y});
            for (int k = 0; stays && k <= 10; ++k)
                stays = is_on_thing(scene, 0.1 * k * seconds,
                                    scene.gone(0.0, {x, y}, 0.1 * k * seconds));
            if (stays) found.push_back({x, y});
        }
    constexpr std::size_t kMost = 9;
    if (found.size() <= kMost) return found;
    std::vector<Point> chosen;
    for (std::size_t k = 0; k < kMost; ++k)
        chosen.push_back(found[(2 * k + 1) * found.size() / (2 * kMost)]);
    return chosen;
}

Vec3 over(const MovingScene& scene, double t_s, Point at, double up_px) {
    return {at.x, at.y, scene.at(t_s, at).elevation_px + up_px};
}

/// Errors, at those times, of a finger that presses deep, with much friction, and whose hand moves
/// along [px].
std::vector<double> astray_px(const MovingScene& scene, const std::vector<Frame>& frames,
                              Point begun, const Filming& filming,
                              std::span<const double> times_s) {
    Finger finger(frames, 5.0, filming.carry);
    finger.tick(over(scene, 0.0, begun, 2.0), 0.0);
    Vec2 held(0.0);  // where on the thing it came down, from where it was meant to
    std::vector<double> errors_px;
    int k = 0;
    for (const double time_s : times_s) {
        const int ticks = static_cast<int>(std::lround(time_s / kTick_s));
        Vec2 place(0.0);
        for (; k <= ticks; ++k) {
            const Point now = scene.gone(0.0, begun, k * kTick_s);
            const Touch& touch =
                finger.tick(over(scene, k * kTick_s, now, -kPressed_px), k * kTick_s);
            place = Vec2(touch.proxy.position);
            if (k == 0) held = place - Vec2(begun.x, begun.y);
        }
        const Point there = scene.gone(0.0, {begun.x + held.x, begun.y + held.y}, ticks * kTick_s);
        errors_px.push_back(glm::length(place - Vec2(there.x, there.y)));
    }
    return errors_px;
}

std::vector<Astray> astray_over(const MovingScene& scene, const std::vector<Frame>& frames,
                                const Filming& filming, std::span<const double> times_s) {
    std::vector<std::vector<double>> errors_px(times_s.size());
    for (const Point begun : places_that_stay(scene, times_s.back())) {
        const std::vector<double> of_one = astray_px(scene, frames, begun, filming, times_s);
        for (std::size_t k = 0; k < of_one.size(); ++k) errors_px[k].push_back(of_one[k]);
    }
    std::vector<Astray> all;
    for (std::size_t k = 0; k < times_s.size(); ++k) {
        Astray astray{.after_s = times_s[k],
                      .median_px = median(errors_px[k]),
                      .fingers = static_cast<int>(errors_px[k].size())};
        if (!errors_px[k].empty())
            astray.worst_px = *std::max_element(errors_px[k].begin(), errors_px[k].end());
        all.push_back(astray);
    }
    return all;
}

int frames_for(const Filming& filming, double seconds) {
    return static_cast<int>(std::ceil(seconds * filming.frames_per_s)) + 2;
}

struct Resting {
    std::vector<double> turned_deg{}, drag_share{};
};

/// A finger that stays at its place in the picture, and presses evenly.
Resting resting(const MovingScene& scene, const std::vector<Frame>& frames,
                const std::vector<Frame>& true_frames, Point at, const Filming& filming) {
    constexpr double kLeastDrag_newton = 0.05;
    constexpr double kBack_s = 1e-3;
    Finger measured(frames, 0.4, filming.carry);
    Finger exact(true_frames, 0.4, true);
    Resting result;
    const int ticks = static_cast<int>(std::lround(filming.seconds / kTick_s));
    for (int k = 0; k < ticks; ++k) {
        const double now_s = k * kTick_s;
        if (!is_on_thing(scene, now_s, at)) break;
        const Vec3 goal = over(scene, now_s, at, k == 0 ? 2.0 : -kPressed_px);
        const Vec3 got = measured.tick(goal, now_s).spring_force_newton;
        const Vec3 wanted = exact.tick(goal, now_s).spring_force_newton;
        const Point gone = scene.gone(now_s, at, now_s + kBack_s);
        const Vec2 way(gone.x - at.x, gone.y - at.y);
        if (glm::length(wanted) == 0.0 || glm::length(got) == 0.0 || glm::length(way) == 0.0)
            continue;
        result.turned_deg.push_back(angle_deg(got, wanted));
        const double drag = glm::dot(Vec2(wanted), way) / glm::length(way);
        if (drag > kLeastDrag_newton)
            result.drag_share.push_back(glm::dot(Vec2(got), way) / glm::length(way) / drag);
    }
    return result;
}

}  // namespace

std::vector<Astray> astray_after(const MovingScene& scene, const Filming& filming,
                                 std::span<const double> times_s) {
    const std::vector<Frame> frames = seen(scene, filming, frames_for(filming, times_s.back()));
    return astray_over(scene, frames, filming, times_s);
}

CarriedFinger carried_finger(const MovingScene& scene, const Filming& filming) {
    const std::vector<Frame> frames = seen(scene, filming, frames_for(filming, filming.seconds));
    const std::vector<Frame> true_frames = truth(scene, filming.seconds);
    const std::array times_s{filming.seconds};
    const Astray astray = astray_over(scene, frames, filming, times_s).front();
    std::vector<double> turned, drag;
    for (const Point at : places_that_stay(scene, 0.1)) {
        const Resting one = resting(scene, frames, true_frames, at, filming);
        if (!one.turned_deg.empty()) turned.push_back(median(one.turned_deg));
        if (!one.drag_share.empty()) drag.push_back(median(one.drag_share));
    }
    return {.astray_px = astray.median_px,
            .worst_astray_px = astray.worst_px,
            .turned_deg = median(turned),
            .drag_share = median(drag),
            .fingers = astray.fingers};
}

}  // namespace dibhr::bench
