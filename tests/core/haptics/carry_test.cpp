// Carried by what moves: a proxy goes with the material point that it touches.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/haptics/surface_motion.hpp"
#include "core/haptics/touch.hpp"
#include "tests/core/haptics/moving_scene.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double kTick_s = 0.001;
constexpr double kElevation_px = 100.0;

Algorithm any_algorithm() {
    return GENERATE(some_of<Algorithm>(
        {Algorithm::dibhr, Algorithm::neighborhood, Algorithm::pga, Algorithm::god_object}, 2));
}

struct NamedMotion {
    std::string name;
    PointMotion motion;
    Vec2 touched;  ///< at time 0
};

/// Motion of `px_per_s` at the touched place, in an image of 640 x 480.
std::vector<NamedMotion> motions(double px_per_s) {
    const Vec2 centre(320.3, 240.7);
    return {{"translating", translating(px_per_s * Vec2(0.8, -0.6)), {150.2, 390.4}},
            {"rotating", turning(centre, px_per_s / 60.0), centre + Vec2(60.0, 0.0)},
            {"expanding", turning(centre, 0.0, px_per_s / 80.0), centre + Vec2(30.0, 20.0)},
            {"both", turning(centre, px_per_s / 90.0, px_per_s / 500.0), centre + Vec2(0.0, 70.0)}};
}

/// A finger over a moving scene, tick by tick.
class Finger {
  public:
    Finger(MovingScene& scene, const TouchParameters& parameters)
        : scene_(scene), parameters_(parameters) {}

    const Touch& tick(Vec3 goal, double now_s) {
        const auto frame = static_cast<int>(now_s * scene_.frames_per_s());
        const SurfaceMotion motion = motion_between(scene_, last_s_, now_s);
        const DepthSurface surface(*scene_.depth(frame), *scene_.depth(frame + 1), motion.to_blend,
                                   parameters_.shape);
        const SafetyInput input{.dt_s = now_s - last_s_, .from_zero = begins_};
        begins_ = false;
        last_s_ = now_s;
        return touch_ = renderer_.update(surface, goal, parameters_, input, limits_, motion);
    }
    [[nodiscard]] const Touch& touch() const { return touch_; }

  private:
    MovingScene& scene_;
    TouchParameters parameters_;
    SafetyLimits limits_{.max_goal_speed_mm_per_ms = 1e3};
    TouchRenderer renderer_{};
    Touch touch_{};
    double last_s_{-kTick_s};
    bool begins_{true};
};

TouchParameters carrying(Algorithm algorithm, double friction) {
    TouchParameters parameters;
    parameters.algorithm = algorithm;
    parameters.friction = {friction, friction};
    parameters.carry = true;
    return parameters;
}

/// The exact answer of a plane to a finger that rests: carried, and held on the cone.
class CarriedOnPlane {
  public:
    CarriedOnPlane(MovingScene& scene, Vec2 foot, double radius_px)
        : scene_(scene), foot_(foot), radius_px_(radius_px), place_(foot) {
        point_.attach_at(place_, motion_between(scene_, 0.0, 0.0), read_);
    }

    void go_on(double last_s, double now_s) {
        const SurfaceMotion motion = motion_between(scene_, last_s, now_s);
        place_ += point_.step_from(place_, motion, read_);
        const double off_px = glm::length(place_ - foot_);
        slides_ = off_px > radius_px_;
        if (slides_) place_ = foot_ + radius_px_ / off_px * (place_ - foot_);
        point_.attach_at(place_, motion, read_);
    }
    [[nodiscard]] Vec2 place() const { return place_; }
    [[nodiscard]] bool slides() const { return slides_; }

  private:
    MovingScene& scene_;
    Vec2 foot_;
    double radius_px_;
    Vec2 place_;
    MaterialPoint point_{};
    PlaceBox read_{};
    bool slides_{false};
};

double angle_deg(Vec3 a, Vec3 b) {
    const double cosine = glm::dot(a, b) / (glm::length(a) * glm::length(b));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

MotionField constant_field(int columns, int rows, MotionField::Way way) {
    return {columns, rows,
            std::vector<MotionField::Way>(
                static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), way)};
}

}  // namespace

TEST_CASE("a material point is where it is, however often it was asked for on the way", "[carry]") {
    for (const NamedMotion& named : motions(400.0)) {
        MovingScene scene(640, 480, 15.0, named.motion, 0.0);
        const auto walked_to = [&](double end_s, auto next_s) {
            MaterialPoint point;
            PlaceBox read;
            Vec2 place = named.touched;
            double last_s = 0.0;
            point.attach_at(place, motion_between(scene, 0.0, 0.0), read);
            while (last_s < end_s) {
                const double now_s = std::min(next_s(last_s), end_s);
                const SurfaceMotion motion = motion_between(scene, last_s, now_s);
                place += point.step_from(place, motion, read);
                point.attach_at(place, motion, read);
                last_s = now_s;
            }
            return place;
        };
        Dice dice(3);
        for (const double end_s : {0.2, 0.2333, 1.0 / 3.0, 0.5}) {
            const Vec2 at_1_khz = walked_to(end_s, [](double s) { return s + 0.001; });
            const Vec2 at_60_hz = walked_to(end_s, [](double s) { return s + 1.0 / 60.0; });
            const Vec2 now_and_then =
                walked_to(end_s, [&](double s) { return s + dice.uniform(1e-4, 0.03); });
            CAPTURE(named.name, end_s);
            CHECK(glm::length(at_1_khz - at_60_hz) < 1e-4);
            CHECK(glm::length(at_1_khz - now_and_then) < 1e-4);
        }
        const Vec2 at_frame = walked_to(0.4, [](double s) { return s + 0.0007; });
        CHECK(glm::length(at_frame - scene.at(named.touched, 0.4)) < 1e-3);
    }
}

TEST_CASE("a finger that sticks ends where its material point does", "[carry]") {
    struct Played {
        double frames_per_s, px_per_s;
    };
    const auto [frames_per_s, px_per_s] =
        GENERATE(some_of<Played>({{15.0, 400.0}, {30.0, 25.0}, {60.0, 150.0}}, 1));
    for (const NamedMotion& named : motions(px_per_s)) {
        MovingScene scene(640, 480, frames_per_s, named.motion, kElevation_px);
        for (const Algorithm algorithm : all_algorithms()) {
            Finger finger(scene, carrying(algorithm, 5.0));
            const Vec3 goal(named.touched, kElevation_px - 90.0);  // held within 450 px of its foot
            finger.tick(Vec3(named.touched, kElevation_px + 1.0), 0.0);
            for (int k = 0; k <= 1000; ++k) finger.tick(goal, k * kTick_s);
            const Proxy& proxy = finger.touch().proxy;
            const Vec2 expected = scene.at(named.touched, 1.0);
            CAPTURE(name_of(algorithm), frames_per_s, px_per_s, named.name);
            CHECK(proxy.contact);
            CHECK(glm::length(Vec2(proxy.position) - expected) < 0.001);
            CHECK_THAT(proxy.position.z, WithinAbs(kElevation_px, 1e-9));
        }
    }
}

TEST_CASE("what moves under a resting finger drags it as friction does", "[carry]") {
    constexpr double kFriction = 0.4;
    constexpr double kPressed_px = 20.0;
    const double px_per_s = GENERATE(some_of<double>({40.0, 400.0}, 1));
    for (const NamedMotion& named : motions(px_per_s)) {
        MovingScene scene(640, 480, 30.0, named.motion, kElevation_px);
        for (const Algorithm algorithm : all_algorithms()) {
            const TouchParameters parameters = carrying(algorithm, kFriction);
            Finger finger(scene, parameters);
            const Vec3 goal(named.touched, kElevation_px - kPressed_px);
            finger.tick(Vec3(named.touched, kElevation_px + 1.0), 0.0);
            finger.tick(goal, 0.0);
            CarriedOnPlane exact(scene, named.touched, kFriction * kPressed_px);
            const bool walks_planes =
                algorithm == Algorithm::dibhr || algorithm == Algorithm::god_object;
            std::vector<double> astray_deg, drag_share;
            for (int k = 1; k <= 700; ++k) {
                exact.go_on((k - 1) * kTick_s, k * kTick_s);
                const Touch& touch = finger.tick(goal, k * kTick_s);
                if (walks_planes)
                    REQUIRE(glm::length(Vec2(touch.proxy.position) - exact.place()) < 1e-6);
                const Vec3 lag = Vec3(exact.place(), kElevation_px) - goal;
                astray_deg.push_back(angle_deg(touch.spring_force_newton, lag));
                if (exact.slides())
                    drag_share.push_back(glm::length(Vec2(touch.spring_force_newton)) /
                                         (parameters.coupling.stiffness_newton_per_mm *
                                          kPaperPitch_mm * kFriction * kPressed_px));
            }
            CAPTURE(name_of(algorithm), px_per_s, named.name);
            REQUIRE(drag_share.size() > 100);
            CHECK(median_of(astray_deg) < 5.0);
            // The other two have their own ways over a plane, and stick more.
            CHECK_THAT(median_of(drag_share), WithinRel(1.0, walks_planes ? 1e-6 : 0.2));
        }
    }
}

TEST_CASE("a sliding finger feels the difference of the two speeds", "[carry]") {
    const Vec2 surface_px_per_s(200.0, 0.0);
    const Vec2 hand_px_per_s =
        GENERATE(Vec2(200.0, 120.0), Vec2(80.0, 0.0), Vec2(320.0, 0.0), Vec2(-100.0, -50.0));
    static MovingScene scene(640, 480, 30.0, translating(surface_px_per_s),
                             kElevation_px);  // for all of them
    Finger finger(scene, carrying(Algorithm::dibhr, 0.4));
    Vec3 goal(200.0, 200.0, kElevation_px + 1.0);
    finger.tick(goal, 0.0);
    goal.z = kElevation_px - 20.0;
    for (int k = 1; k <= 600; ++k) {
        goal += kTick_s * Vec3(hand_px_per_s, 0.0);
        finger.tick(goal, k * kTick_s);
    }
    const Vec2 relative = surface_px_per_s - hand_px_per_s;
    const Vec3 expected(0.4 * relative / glm::length(relative), 1.0);
    CHECK(angle_deg(finger.touch().spring_force_newton, expected) < 0.5);
}

TEST_CASE("a finger that goes along with what it touches feels no drag and no damping", "[carry]") {
    const Vec2 px_per_s(240.0, -90.0);
    TouchParameters parameters = carrying(any_algorithm(), 0.4);
    parameters.coupling.damping_newton_s_per_m = 5.0;
    parameters.coupling.damping_cutoff_hz = GENERATE(0.0, 50.0);
    static MovingScene scene(640, 480, 30.0, translating(px_per_s),
                             kElevation_px);  // for all of them
    const auto force_at_end = [&](bool carry, Vec2 hand_px_per_s) {
        TouchParameters here = parameters;
        here.carry = carry;
        Finger finger(scene, here);
        Vec3 goal(150.0, 300.0, kElevation_px + 1.0);
        finger.tick(goal, 0.0);
        goal.z = kElevation_px - 20.0;
        finger.tick(goal, 0.0);
        for (int k = 1; k <= 500; ++k) {
            goal += kTick_s * Vec3(hand_px_per_s, 0.0);
            finger.tick(goal, k * kTick_s);
        }
        return finger.touch().spring_force_newton;
    };
    const double newton_s_per_px = 5.0 * 1e-3 * kPaperPitch_mm;
    CHECK(glm::length(Vec2(force_at_end(true, px_per_s))) < 1e-6);
    CHECK(glm::length(Vec2(force_at_end(false, px_per_s))) > 0.5 * newton_s_per_px * 250.0);
    // A hand that rests is taken along by both; without carry by neither.
    const Vec2 along = Vec2(force_at_end(true, Vec2(0.0)));
    const double rubbed = 0.4 * 20.0 * 0.5 * kPaperPitch_mm;
    const double dragged = rubbed + newton_s_per_px * glm::length(px_per_s);
    CHECK_THAT(glm::dot(along, px_per_s) / glm::length(px_per_s), WithinRel(dragged, 0.1));
    CHECK(glm::length(Vec2(force_at_end(false, Vec2(0.0)))) < 1e-9);
}

TEST_CASE("a sphere that moves takes the finger on it along", "[carry]") {
    const Algorithm algorithm = any_algorithm();
    const Vec2 px_per_s(170.0, 60.0);
    const Vec2 centre(150.0, 150.0);
    const auto sphere = [=](Vec2 place, double t_s) {
        const Vec2 off = place - centre - t_s * px_per_s;
        const double up2 = 80.0 * 80.0 - glm::dot(off, off);
        return 60.0 + (up2 > 0.0 ? std::sqrt(up2) : 0.0);
    };
    static MovingScene scene(480, 320, 60.0, translating(px_per_s), sphere);  // for all of them
    Finger finger(scene, carrying(algorithm, 0.8));
    const Vec2 touched = centre + Vec2(25.0, -20.0);
    Vec3 goal(touched, sphere(touched, 0.0) + 1.0);
    finger.tick(goal, 0.0);
    const Vec3 pressed(touched, sphere(touched, 0.0) - 30.0);
    for (int k = 1; k <= 1000; ++k)  // the hand goes along
        finger.tick(pressed + k * kTick_s * Vec3(px_per_s, 0.0), k * kTick_s);
    const Vec2 expected = touched + px_per_s;
    CAPTURE(name_of(algorithm));
    // Where friction holds it is decided while it comes down; from then on it is the same point.
    CHECK(finger.touch().proxy.contact);
    CHECK(glm::length(Vec2(finger.touch().proxy.position) - expected) < 1.5);
    CHECK(finger.touch().proxy.position.z > 60.0 + 60.0);
}

TEST_CASE("without carry, or without motion, nothing is carried: the same bits", "[carry]") {
    TouchParameters parameters = carrying(any_algorithm(), 0.4);
    parameters.coupling.damping_newton_s_per_m = 5.0;
    parameters.coupling.damping_cutoff_hz = 50.0;
    SafetyLimits limits;
    if (GENERATE(false, true)) {
        limits.watched = {.mass_kg = 0.1,
                          .friction_newton_s_per_m = 0.5,
                          .resolution_mm = 0.05,
                          .delay_s = 0.002};
    }
    const MotionField still = constant_field(50, 40, {});
    const MotionField moving = constant_field(50, 40, {3.0F, -2.0F});
    const auto surfaces = hostile_surfaces(50, 40);
    for (const auto& named : surfaces) {
        std::vector<TouchRenderer> renderers(4);
        Dice dice(11);
        Vec3 goal(25.0, 20.0, 200.0);
        double last = 0.0;
        for (int k = 0; k < 1500; ++k) {
            goal += Vec3{dice.uniform(-1.0, 1.0), dice.uniform(-1.0, 1.0), dice.uniform(-2.0, 1.9)};
            const double blend = k % 33 / 33.0;
            const DepthSurface surface(named.image, named.image, blend, parameters.shape);
            const SurfaceMotion going{nullptr, last, blend, blend < last};
            last = blend;
            const auto run = [&](std::size_t which, bool carry, SurfaceMotion motion) {
                TouchParameters here = parameters;
                here.carry = carry;
                return renderers[which].update(surface, goal, here, {}, limits, motion);
            };
            const auto with = [&](const MotionField& field) {
                SurfaceMotion motion = going;
                motion.field = &field;
                return motion;
            };
            const Touch off = run(0, false, {});
            std::vector<Touch> others{run(1, false, with(moving)), run(2, true, going),
                                      run(3, true, with(still))};
            for (Touch& other : others) {
                other.proxy.motion_read = {};  // what was read is no part of what was felt
                if (other.proxy == off.proxy &&
                    other.spring_force_newton == off.spring_force_newton &&
                    other.sent_force_newton == off.sent_force_newton && other.carried == Vec3(0.0))
                    continue;
                CAPTURE(named.name, k, other.carried.x, other.carried.y);
                FAIL("another touch than without carry");
            }
        }
    }
    SUCCEED();
}

namespace {

/// `ticks`: number of ticks of each algorithm.
void require_not_thrown(int ticks) {
    constexpr int kColumns = 50;
    constexpr int kRows = 40;
    const Algorithm algorithm = any_algorithm();
    const auto walker = make_algorithm(algorithm);
    const auto surfaces = hostile_surfaces(kColumns, kRows);
    Dice dice(29);
    MotionField field = constant_field(kColumns, kRows, {});
    const auto spoil = [&] {
        const double most_px = std::pow(10.0, dice.uniform(-2.0, 4.0));
        for (MotionField::Way& way : field.ways) {
            way = {static_cast<float>(dice.uniform(-most_px, most_px)),
                   static_cast<float>(dice.uniform(-most_px, most_px))};
            const double die = dice.uniform(0.0, 1.0);
            if (die < 0.02) way.right = std::numeric_limits<float>::quiet_NaN();
            if (die > 0.98) way.down = std::numeric_limits<float>::infinity();
        }
    };
    Vec3 goal(25.0, 20.0, 120.0);
    double last = 0.0;
    int carried = 0;
    double farthest_px = 0.0;
    for (int k = 0; k < ticks; ++k) {
        if (k % 40 == 0) spoil();
        goal += Vec3{dice.uniform(-1.0, 1.0), dice.uniform(-1.0, 1.0), dice.uniform(-3.0, 3.0)};
        goal = glm::clamp(goal, Vec3(-5.0, -5.0, -20.0), Vec3(54.0, 44.0, 260.0));
        const auto& from = surfaces[static_cast<std::size_t>(k / 500) % surfaces.size()].image;
        const auto& to = surfaces[static_cast<std::size_t>(k / 900) % surfaces.size()].image;
        const double blend = dice.uniform(0.0, 1.0) < 0.9 ? k % 33 / 33.0 : dice.uniform(0.0, 1.0);
        const DepthSurface surface(from, to, blend, {});
        const SurfaceMotion motion{&field, last, blend, dice.uniform(0.0, 1.0) < 0.05,
                                   dice.uniform(0.0, 0.002)};
        last = blend;
        const Proxy& proxy = walker->update(surface, goal, {0.6, 0.4}, motion);
        const double way_px = glm::length(Vec2(walker->carried_px()));
        carried += way_px > 0.0 ? 1 : 0;
        farthest_px = std::max(farthest_px, way_px / motion.farthest_px());
        const Vec3 p = proxy.position;
        if (is_finite(p) && p == surface.clamped_to_frame(p) &&
            p.z >= surface.elevation_at(p.x, p.y) - 1e-5 && way_px <= motion.farthest_px())
            continue;
        CAPTURE(name_of(algorithm), k, p.x, p.y, p.z, way_px);
        FAIL("the proxy was thrown");
    }
    CAPTURE(name_of(algorithm), carried);
    CHECK(carried > ticks / 50);
    CHECK(farthest_px <= 1.0);
}

}  // namespace

TEST_CASE("no field, however wrong, throws a proxy about, below the surface or out of the image",
          "[carry]") {
    require_not_thrown(50'000);
}

TEST_CASE("no field throws a proxy about in a million updates", "[carry][long]") {
    require_not_thrown(250'000);  // of each of four algorithms
}

TEST_CASE("what only touches the air, or begins anew, is not carried", "[carry]") {
    MovingScene scene(200, 100, 30.0, translating({300.0, 0.0}), kElevation_px);
    TouchRenderer renderer;
    const TouchParameters parameters = carrying(any_algorithm(), 5.0);
    double last_s = 0.0;
    const auto tick = [&](Vec3 goal, SafetyInput input = {}) -> const Touch& {
        const double now_s = last_s + kTick_s;
        const SurfaceMotion motion = motion_between(scene, last_s, now_s);
        last_s = now_s;
        const DepthSurface surface(*scene.depth(0), *scene.depth(0), 0.0, parameters.shape);
        return renderer.update(surface, goal, parameters, input, {}, motion);
    };
    const Vec3 above(50.0, 50.0, kElevation_px + 5.0);
    const Vec3 pressed(50.0, 50.0, kElevation_px - 20.0);
    for (int k = 0; k < 20; ++k) CHECK(tick(above).carried == Vec3(0.0));
    CHECK(tick(pressed).carried == Vec3(0.0));  // it has just touched
    CHECK(tick(pressed).carried.x > 0.29);

    SECTION("a force that begins from zero") {
        CHECK(tick(pressed, {.from_zero = true}).carried == Vec3(0.0));
    }
    SECTION("a hand that lets go") {
        renderer.release_contact();
        CHECK(tick(pressed).carried == Vec3(0.0));
    }
    SECTION("an update that was refused") {
        tick(Vec3(NAN));
        CHECK(tick(pressed).carried == Vec3(0.0));
    }
    SECTION("a pause in which there was nothing to touch") {
        renderer.pause();
        CHECK(tick(pressed).carried == Vec3(0.0));
    }
    SECTION("a reset") {
        renderer.reset();
        CHECK(tick(pressed).carried == Vec3(0.0));
    }
    CHECK(tick(pressed).carried.x > 0.29);  // and then it goes on
}

TEST_CASE("while a video is paused nothing is carried, and at the border it stays in the image",
          "[carry]") {
    const MotionField field = constant_field(60, 40, {12.0F, 0.0F});
    const DepthImage image = flat(60, 40, kElevation_px);
    const DepthSurface surface(image, image, 0.0, {});
    const auto walker = make_algorithm(any_algorithm());
    const Friction held{5.0, 5.0};
    (void)walker->update(surface, {50.0, 20.0, kElevation_px + 1.0}, held);
    const Vec3 goal(50.0, 20.0, kElevation_px - 20.0);
    (void)walker->update(surface, goal, held, {&field, 0.2, 0.2});
    const Proxy rests = walker->update(surface, goal, held, {&field, 0.2, 0.2});
    for (int k = 0; k < 100; ++k)
        CHECK(walker->update(surface, goal, held, {&field, 0.2, 0.2}).position == rests.position);
    double blend = 0.2;
    for (int k = 0; k < 60; ++k) {
        const bool next = blend > 0.97;
        const double to = next ? 0.0 : blend + 0.03;
        (void)walker->update(surface, goal, held, {&field, blend, to, next});
        blend = to;
    }
    const Proxy& proxy = walker->update(surface, goal, held, {&field, blend, blend});
    CHECK(proxy.contact);
    CHECK(proxy.position == Vec3(59.0, 20.0, kElevation_px));
}

TEST_CASE("a wrong flow throws no proxy over an outline", "[carry]") {
    const auto ground = [](int i, int) { return i < 30 ? 200.0 : 40.0; };
    const DepthImage image = image_of(60, 40, 255.0, ground);
    const DepthSurface surface(image, image, 0.0, {});
    const MotionField field = constant_field(60, 40, {12.0F, 0.0F});
    const auto walker = make_algorithm(any_algorithm());
    const double begin_x = GENERATE(25.0, 28.9);
    const double ticks_in_frame = GENERATE(33.0, 4.0);
    const Friction held{5.0, 5.0};
    (void)walker->update(surface, {begin_x, 20.0, 201.0}, held);
    const Vec3 goal(begin_x, 20.0, 180.0);
    double blend = 0.0;
    for (int k = 0; k < 300; ++k) {
        const bool next = blend + 1.0 / ticks_in_frame > 1.0;
        const double to = next ? 0.0 : blend + 1.0 / ticks_in_frame;
        const Proxy& proxy = walker->update(surface, goal, held, {&field, blend, to, next});
        blend = to;
        CAPTURE(k, begin_x, proxy.position.x);
        REQUIRE(proxy.contact);
        REQUIRE(proxy.position.x <= 29.0 + 0.5);
        REQUIRE_THAT(proxy.position.z, WithinAbs(200.0, 8.0));
    }
}

TEST_CASE("after a late tick a proxy is carried by all that was missed, up to a hand's speed",
          "[carry]") {
    const MotionField field = constant_field(200, 40, {100.0F, 0.0F});
    const DepthImage image = flat(200, 40, kElevation_px);
    const DepthSurface surface(image, image, 0.0, {});
    const auto walker = make_algorithm(any_algorithm());
    const Friction held{5.0, 5.0};
    (void)walker->update(surface, {50.0, 20.0, kElevation_px + 1.0}, held);
    const Vec3 goal(50.0, 20.0, kElevation_px - 50.0);
    (void)walker->update(surface, goal, held, {&field, 0.0, 0.0});
    (void)walker->update(surface, goal, held, {&field, 0.0, 0.4, false, 0.008});  // 5000 px/s
    CHECK_THAT(walker->carried_px().x, WithinAbs(40.0, 1e-6));
    (void)walker->update(surface, goal, held, {&field, 0.4, 0.5, false, 0.001});
    CHECK(walker->carried_px() == Vec3(0.0));
}
