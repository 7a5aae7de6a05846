// Where the grip's point is in the image, and what the clutch and the boundary do.
#include "device/hand/workspace.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/catch.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using namespace dibhr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Vec3 kCentre_mm{0.0, 0.0, 115.0};
constexpr ImageFrame kImage{.columns = 721, .rows = 577, .relief_px = 120.0, .pixel_pitch_mm = 0.2};
constexpr Vec3 kMiddle{360.0, 288.0, 60.0};

bool same(Vec3 a, Vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

Vec3 goal_of(Vec3 grip_mm, const WorkspaceOptions& options = {}, const ImageFrame& image = kImage) {
    Workspace workspace;
    return workspace.goal_in_grid(grip_mm, false, image, options);
}

/// A hand that wanders, or jumps, about the workspace.
class Hand {
  public:
    explicit Hand(unsigned seed) : random_(seed) {}
    Vec3 moved(double step_mm) {
        std::normal_distribution<double> normal(0.0, step_mm);
        grip_mm_ += Vec3{normal(random_), normal(random_), normal(random_)};
        return grip_mm_;
    }
    bool now_and_then(unsigned one_of) { return random_() % one_of == 0; }

  private:
    std::mt19937 random_;
    Vec3 grip_mm_{kCentre_mm};
};

}  // namespace

TEST_CASE("the workspace's centre is over the image's middle, half way up the relief",
          "[workspace]") {
    const double scale = GENERATE(0.1, 1.0, 2.5, 10.0);
    CHECK_THAT(glm::distance(goal_of(kCentre_mm, {.scale = scale}), kMiddle), WithinAbs(0.0, 1e-9));
}

TEST_CASE("right is right, up is up in the image, and out is higher", "[workspace]") {
    const Vec3 goal = goal_of(kCentre_mm + Vec3{1.0, 2.0, 3.0});
    CHECK_THAT(goal.x - kMiddle.x, WithinAbs(5.0, 1e-9));
    CHECK_THAT(goal.y - kMiddle.y, WithinAbs(-10.0, 1e-9));
    CHECK_THAT(goal.z - kMiddle.z, WithinAbs(15.0, 1e-9));
}

TEST_CASE("the scale is image millimetres a hand millimetre, about the centre", "[workspace]") {
    const Vec3 way{3.0, -7.0, 11.0};
    const Vec3 once = goal_of(kCentre_mm + way) - kMiddle;
    const double scale = GENERATE(0.1, 0.5, 3.0, 10.0);
    const Vec3 scaled = goal_of(kCentre_mm + way, {.scale = scale}) - kMiddle;
    CHECK_THAT(glm::distance(scaled, scale * once), WithinAbs(0.0, 1e-9));
}

TEST_CASE("the offset moves the point in the image, whatever the scale", "[workspace]") {
    const double scale = GENERATE(0.5, 1.0, 4.0);
    const Vec3 goal = goal_of(kCentre_mm, {.scale = scale, .offset_mm = {4.0, 6.0, -2.0}});
    CHECK_THAT(glm::distance(goal, kMiddle + Vec3{20.0, -30.0, -10.0}), WithinAbs(0.0, 1e-9));
}

TEST_CASE("device axes and grid axes are each other's mirror", "[workspace]") {
    const Vec3 v{1.0, 2.0, 3.0};
    CHECK(same(device_axes(v), {1.0, -2.0, 3.0}));
    CHECK(same(grid_axes(device_axes(v)), v));
    CHECK(same(device_axes(grid_axes(v)), v));
}

TEST_CASE("while clutched the point stays, and afterwards goes on from there", "[workspace]") {
    Workspace workspace;
    const WorkspaceOptions options;
    const auto goal = [&](Vec3 grip_mm, bool clutched) {
        return workspace.goal_in_grid(grip_mm, clutched, kImage, options);
    };
    const Vec3 before = goal(kCentre_mm + Vec3{10.0, 0.0, 0.0}, false);
    CHECK(same(goal(kCentre_mm + Vec3{10.0, 0.0, 0.0}, true), before));
    CHECK(same(goal(kCentre_mm + Vec3{-20.0, 5.0, 9.0}, true), before));
    CHECK(same(goal(kCentre_mm + Vec3{-20.0, 5.0, 9.0}, false), before));
    const Vec3 after = goal(kCentre_mm + Vec3{-18.0, 5.0, 9.0}, false);
    CHECK_THAT(glm::distance(after, before + Vec3{10.0, 0.0, 0.0}), WithinAbs(0.0, 1e-9));
}

TEST_CASE("engaging and releasing the clutch never make the point jump, whatever the hand does",
          "[workspace]") {
    const unsigned seed = GENERATE(range(1U, 11U));
    const double step_mm = GENERATE(0.1, 50.0);
    CAPTURE(seed, step_mm);
    Hand hand(seed);
    Workspace workspace;
    WorkspaceOptions options;
    bool clutched = false;
    bool was_clutched = false;
    Vec3 grip = kCentre_mm;
    Vec3 goal = workspace.goal_in_grid(grip, false, kImage, options);
    double worst_px = 0.0;
    for (int k = 0; k < 5000; ++k) {
        if (hand.now_and_then(30)) clutched = !clutched;
        if (clutched && hand.now_and_then(50)) options.scale = hand.now_and_then(2) ? 0.3 : 2.0;
        const Vec3 next_grip = hand.moved(step_mm);
        const Vec3 next = workspace.goal_in_grid(next_grip, clutched, kImage, options);
        const bool held = clutched || was_clutched;
        const Vec3 free_px = 5.0 * options.scale * grid_axes(next_grip - grip);
        const Vec3 expected = held ? goal : goal + free_px;
        worst_px = std::max(worst_px, glm::distance(next, expected));
        goal = next;
        grip = next_grip;
        was_clutched = clutched;
    }
    CHECK(worst_px <= 1e-6);
}

TEST_CASE("a clutch held from the first reading on holds the first point", "[workspace]") {
    Workspace workspace;
    const Vec3 first = workspace.goal_in_grid(kCentre_mm + Vec3{5.0}, true, kImage, {});
    CHECK_THAT(glm::distance(first, goal_of(kCentre_mm + Vec3{5.0})), WithinAbs(0.0, 1e-9));
    CHECK(same(workspace.goal_in_grid(kCentre_mm, true, kImage, {}), first));
}

TEST_CASE("centring forgets the clutch's shift, also while it is held", "[workspace]") {
    const bool still_clutched = GENERATE(false, true);
    const Vec3 grip = kCentre_mm + Vec3{7.0, 8.0, -9.0};
    Workspace workspace;
    (void)workspace.goal_in_grid(kCentre_mm, false, kImage, {});
    (void)workspace.goal_in_grid(grip, true, kImage, {});
    (void)workspace.goal_in_grid(grip, still_clutched, kImage, {});
    workspace.centre();
    const Vec3 goal = workspace.goal_in_grid(grip, still_clutched, kImage, {});
    CHECK_THAT(glm::distance(goal, goal_of(grip)), WithinAbs(0.0, 1e-9));
}

TEST_CASE("a grip that is no number leaves the point where it was", "[workspace]") {
    const double bad = GENERATE(values({kNan, kInfinity, -kInfinity, 1e308}));
    Workspace workspace;
    CHECK(is_finite(workspace.goal_in_grid({0.0, bad, 0.0}, false, kImage, {.scale = 10.0})));
    const Vec3 goal = workspace.goal_in_grid(kCentre_mm + Vec3{3.0}, false, kImage, {});
    CHECK(same(workspace.goal_in_grid({bad, 0.0, 115.0}, false, kImage, {.scale = 10.0}), goal));
    CHECK(same(workspace.goal_in_grid({bad, 0.0, 115.0}, true, kImage, {.scale = 10.0}), goal));
    CHECK(same(workspace.goal_in_grid(kCentre_mm + Vec3{3.0}, false, kImage, {}), goal));
}

TEST_CASE("options and images that make no sense still give a point", "[workspace]") {
    const double bad = GENERATE(values({kNan, kInfinity, -1.0, 0.0}));
    const Vec3 grip = kCentre_mm + Vec3{1.0, 2.0, 3.0};
    CHECK(is_finite(goal_of(grip, {.scale = bad})));
    CHECK(is_finite(goal_of(grip, {.offset_mm = Vec3{bad}})));
    CHECK(is_finite(goal_of(grip, {.centre_z_mm = bad})));
    CHECK(is_finite(goal_of(grip, {}, {10, 10, bad, 0.1})));
    CHECK(is_finite(goal_of(grip, {}, {10, 10, 5.0, bad})));
    CHECK(is_finite(goal_of(grip, {}, {})));
}

TEST_CASE("within the radius the boundary does not push", "[workspace]") {
    Hand hand(1);
    for (int k = 0; k < 1000; ++k) {
        const Vec3 way = hand.moved(5.0) - kCentre_mm;
        const double most = 39.999 / std::max(glm::length(way), 39.999);
        CHECK(same(Workspace::boundary_force(kCentre_mm + most * way, {}), Vec3{0.0}));
    }
}

TEST_CASE("beyond the radius the boundary pushes to the centre, harder the further",
          "[workspace]") {
    Hand hand(2);
    for (int k = 0; k < 1000; ++k) {
        const Vec3 outwards = glm::normalize(hand.moved(5.0) - kCentre_mm);
        const double beyond_mm = 0.01 * k;
        const Vec3 force =
            Workspace::boundary_force(kCentre_mm + (40.0 + beyond_mm) * outwards, {});
        CHECK_THAT(glm::distance(force, -0.3 * beyond_mm * outwards), WithinAbs(0.0, 1e-9));
    }
}

TEST_CASE("the boundary has the radius, centre and stiffness that people choose", "[workspace]") {
    const WorkspaceOptions options{
        .centre_z_mm = 120.0, .radius_mm = 20.0, .boundary_newton_per_mm = 1.5};
    const Vec3 force = Workspace::boundary_force({0.0, 0.0, 98.0}, options);
    CHECK_THAT(force.z, WithinAbs(3.0, 1e-9));
}

TEST_CASE("a boundary of no sense pushes nobody", "[workspace]") {
    const double bad = GENERATE(values({kNan, kInfinity}));
    const Vec3 grip{80.0, 0.0, 115.0};
    CHECK(same(Workspace::boundary_force({bad, 0.0, 115.0}, {}), Vec3{0.0}));
    CHECK(same(Workspace::boundary_force(grip, {.radius_mm = bad}), Vec3{0.0}));
    CHECK(same(Workspace::boundary_force(grip, {.boundary_newton_per_mm = bad}), Vec3{0.0}));
    CHECK(same(Workspace::boundary_force(grip, {.boundary_newton_per_mm = -0.3}), Vec3{0.0}));
    CHECK(is_finite(Workspace::boundary_force(grip, {.centre_z_mm = bad})));
    CHECK(is_finite(Workspace::boundary_force({1e300, 1e300, 0.0}, {})));
}

TEST_CASE("at the fitting scale the whole image and its relief are within the radius, just",
          "[workspace]") {
    const ImageFrame image =
        GENERATE(ImageFrame{kImage}, ImageFrame{1920, 1080, 200.0}, ImageFrame{320, 240, 0.0});
    const WorkspaceOptions options;
    const double scale = fitting_scale(image, options);
    const Vec3 corner_mm = goal_of(kCentre_mm, {}, image) * image.pixel_pitch_mm / scale;
    CHECK_THAT(glm::length(corner_mm), WithinRel(options.radius_mm, 1e-9));
}

TEST_CASE("the fitting scale stays within the scale's range", "[workspace]") {
    const WorkspaceOptions options;
    CHECK_THAT(fitting_scale({2, 2, 0.0}, options), WithinAbs(0.1, 1e-12));
    CHECK_THAT(fitting_scale({100000, 100000, 0.0}, options), WithinAbs(10.0, 1e-12));
    for (const double bad : {kNan, kInfinity, 0.0, -1.0}) {
        CAPTURE(bad);
        const double scale = fitting_scale({100, 100, bad, bad}, {.radius_mm = bad});
        CHECK(scale >= 0.1);
        CHECK(scale <= 10.0);
    }
}
