// The markers show the touch as it is.
#include "render/marker_pass.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

using Catch::Matchers::WithinAbs;

TouchMarkers pressed() {
    TouchMarkers touch;
    touch.visible = true;
    touch.contact = true;
    touch.proxy = {300.0, 200.0, 80.0};
    touch.normal = glm::normalize(Vec3(0.3, -0.2, 1.0));
    touch.goal = touch.proxy - touch.normal * 25.0;
    touch.friction = 0.4;
    touch.force_newton = {0.3, 0.6, 1.2};
    touch.newton_per_px = 0.02;
    return touch;
}

Camera camera_640x480() {
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    return camera;
}

TEST_CASE("markers that are not visible, or not finite, are not drawn") {
    TouchMarkers touch = pressed();
    touch.visible = false;
    CHECK(touch_strokes(touch, camera_640x480(), 1.0).empty());
    CHECK_FALSE(friction_cone(touch, camera_640x480()).has_value());
    touch = pressed();
    touch.goal.x = std::numeric_limits<double>::quiet_NaN();
    CHECK(touch_strokes(touch, camera_640x480(), 1.0).empty());
    CHECK_FALSE(friction_cone(touch, camera_640x480()).has_value());
}

TEST_CASE("out of contact only proxy and goal are shown, a ball and a ring") {
    TouchMarkers touch = pressed();
    touch.contact = false;
    touch.force_newton = {};
    const std::vector<MarkerStroke> strokes = touch_strokes(touch, camera_640x480(), 1.0);
    REQUIRE(strokes.size() == 2);
    const auto rings = std::count_if(strokes.begin(), strokes.end(),
                                     [](const MarkerStroke& s) { return s.hollow > 0.0F; });
    CHECK(rings == 1);
    CHECK_FALSE(friction_cone(touch, camera_640x480()).has_value());
}

TEST_CASE("a fingertip is a ball that stands on the proxy, with a mark where it touches") {
    TouchMarkers touch = pressed();
    const Camera camera = camera_640x480();
    const std::size_t without = touch_strokes(touch, camera, 1.0).size();
    touch.finger_px = 12.0;
    touch.finger_contact = touch.proxy + Vec3(5.0, 0.0, 3.0);
    const std::vector<MarkerStroke> strokes = touch_strokes(touch, camera, 1.0);
    const Vec3 centre = camera.world_from_grid(touch.proxy + Vec3(0.0, 0.0, touch.finger_px));
    const auto on_ball = [&](const MarkerStroke& s) {
        const auto away = [&](const glm::vec4& end) {
            return std::abs(glm::length(Vec3(end) - centre) - touch.finger_px);
        };
        return s.ball_a != s.ball_b && away(s.ball_a) < 1e-3 && away(s.ball_b) < 1e-3;
    };
    const auto circles =
        static_cast<std::size_t>(std::count_if(strokes.begin(), strokes.end(), on_ball));
    CHECK(circles > 60);
    CHECK(strokes.size() == without + circles + 1);
    const auto touches = camera.world_from_grid(*touch.finger_contact);
    CHECK(std::count_if(strokes.begin(), strokes.end(), [&](const MarkerStroke& s) {
              return s.ball_a == s.ball_b && glm::length(Vec3(s.ball_a) - touches) < 1e-3;
          }) == 1);
    touch.visible = false;
    CHECK(touch_strokes(touch, camera, 1.0).empty());
}

TEST_CASE("while the proxy catches up a ring is around it, and the line to the goal is dashed") {
    TouchMarkers touch = pressed();
    touch.contact = GENERATE(true, false);  // the line also without contact
    const Camera camera = camera_640x480();
    const auto dashed = [](const MarkerStroke& s) { return s.dash > 0.0F; };
    const auto ring = [](const MarkerStroke& s) { return s.hollow > 0.0F; };
    const std::vector<MarkerStroke> usual = touch_strokes(touch, camera, 1.0);
    CHECK(std::count_if(usual.begin(), usual.end(), dashed) == 0);
    CHECK(std::count_if(usual.begin(), usual.end(), ring) == 1);
    touch.catching_up = true;
    const std::vector<MarkerStroke> strokes = touch_strokes(touch, camera, 1.0);
    CHECK(std::count_if(strokes.begin(), strokes.end(), dashed) == 1);
    CHECK(std::count_if(strokes.begin(), strokes.end(), ring) == 2);
    CHECK_FALSE(friction_cone(touch, camera).has_value());
}

TEST_CASE(
    "a recorded proxy is one more ball, where it was, in another tint than the computed one") {
    TouchMarkers touch = pressed();
    const Camera camera = camera_640x480();
    const std::size_t without = touch_strokes(touch, camera, 1.0).size();
    touch.recorded_proxy = touch.proxy + Vec3{12.0, 0.0, 3.0};
    const std::vector<MarkerStroke> strokes = touch_strokes(touch, camera, 1.0);
    CHECK(strokes.size() == without + 1);
    const glm::vec3 recorded(camera.world_from_grid(*touch.recorded_proxy));
    const auto there = std::find_if(strokes.begin(), strokes.end(), [&](const MarkerStroke& s) {
        return glm::length(glm::vec3(s.ball_a) - recorded) < 1e-3F;
    });
    REQUIRE(there != strokes.end());
    CHECK_FALSE(there->tint == strokes.back().tint);
}

TEST_CASE(
    "another algorithm's proxy is a ball of its colour, and of those at one place all are seen") {
    TouchMarkers touch = pressed();
    const Camera camera = camera_640x480();
    const std::size_t without = touch_strokes(touch, camera, 1.0).size();
    const glm::vec3 red{0.8F, 0.3F, 0.0F}, green{0.0F, 0.6F, 0.4F}, purple{0.8F, 0.5F, 0.7F};
    const Vec3 there = touch.proxy + Vec3{12.0, 0.0, 3.0};
    touch.others = {{there, red},
                    {touch.proxy - Vec3{9.0, 4.0, 0.0}, green},
                    {there, purple},
                    {Vec3{NAN, 0.0, 0.0}, red}};
    touch.proxy_tint = glm::vec3{0.0F, 0.4F, 0.7F};
    const std::vector<MarkerStroke> strokes = touch_strokes(touch, camera, 1.0);
    CHECK(strokes.size() == without + 6);  // a ball and a line to the goal each
    CHECK(glm::vec3(strokes.back().tint) == *touch.proxy_tint);
    const auto ball_of = [&](const glm::vec3& tint, Vec3 place) {
        const glm::vec3 middle(camera.world_from_grid(place));
        const auto found = std::find_if(strokes.begin(), strokes.end(), [&](const MarkerStroke& s) {
            return glm::vec3(s.tint) == tint && s.ball_a == s.ball_b &&
                   glm::length(glm::vec3(s.ball_a) - middle) < 1e-3F;
        });
        REQUIRE(found != strokes.end());
        return found;
    };
    CHECK(ball_of(red, there)->ball_a.w > ball_of(purple, there)->ball_a.w);
    CHECK(ball_of(red, there) < ball_of(purple, there));  // drawn before it
    CHECK(ball_of(green, touch.others[1].place)->ball_a.w == ball_of(purple, there)->ball_a.w);
}

TEST_CASE(
    "the force arrow starts at the proxy, points along the force and is as long as it is strong") {
    const TouchMarkers touch = pressed();
    const Camera camera = camera_640x480();
    const std::vector<MarkerStroke> with = touch_strokes(touch, camera, 1.0);
    const Vec3 tip = touch.proxy + touch.force_newton / touch.newton_per_px;
    const glm::vec3 tip_in_world(camera.world_from_grid(tip));
    const auto reaches_tip = [&](const MarkerStroke& s) {
        return glm::length(glm::vec3(s.ball_b) - tip_in_world) < 1e-3F;
    };
    CHECK(std::count_if(with.begin(), with.end(), reaches_tip) == 1);
    TouchMarkers calm = touch;
    calm.force_newton = {};
    CHECK(touch_strokes(calm, camera, 1.0).size() + 2 == with.size());
}

TEST_CASE("the friction cone has its apex at the goal and opens by atan(mu) about the normal") {
    const TouchMarkers touch = pressed();
    const Camera camera = camera_640x480();
    const auto cone = friction_cone(touch, camera);
    REQUIRE(cone.has_value());
    CHECK_THAT(glm::length(cone->apex - glm::vec3(camera.world_from_grid(touch.goal))),
               WithinAbs(0.0, 1e-4));
    const glm::vec3 top(camera.world_from_grid(touch.proxy));
    CHECK_THAT(glm::length(cone->apex + cone->axis - top), WithinAbs(0.0, 1e-3));
    for (const glm::vec3 radius : {cone->rim_u, cone->rim_v}) {
        CHECK_THAT(glm::length(radius) / glm::length(cone->axis), WithinAbs(0.4, 1e-5));
        CHECK_THAT(glm::dot(radius, cone->axis), WithinAbs(0.0, 1e-2));
    }
    CHECK_THAT(glm::dot(cone->rim_u, cone->rim_v), WithinAbs(0.0, 1e-2));
}

TEST_CASE("without friction, or with the goal above the surface, there is no cone") {
    TouchMarkers touch = pressed();
    touch.friction = 0.0;
    CHECK_FALSE(friction_cone(touch, camera_640x480()).has_value());
    touch = pressed();
    touch.goal = touch.proxy + touch.normal * 3.0;
    CHECK_FALSE(friction_cone(touch, camera_640x480()).has_value());
}

}  // namespace
}  // namespace dibhr
