// The camera: what is in view, and that the ray under the cursor matches the picture.
#include "render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "tests/render/scenes.hpp"
#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

using Catch::Matchers::WithinAbs;

double distance_to_line(Vec3 p, const Camera::Ray& ray) {
    const Vec3 along = glm::normalize(ray.far_in_grid - ray.near_in_grid);
    return glm::length(glm::cross(p - ray.near_in_grid, along));
}

TEST_CASE("the ray under the projected place of a grid point passes through that point") {
    const glm::ivec2 viewport = GENERATE(glm::ivec2(1280, 800), glm::ivec2(300, 900));
    const auto projection = GENERATE(Camera::Projection::perspective, Camera::Projection::straight);
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    camera.orbit(0.7, -0.4);
    camera.pan(31.0, -12.0, viewport.y);
    camera.zoom(1.7);
    camera.set_projection(projection);
    for (const Vec3 p : {Vec3(0.0), Vec3(639.0, 479.0, 255.0), Vec3(100.5, 333.0, 71.0)}) {
        const Camera::Ray ray = camera.ray_under(on_screen(camera, p, viewport), viewport);
        CHECK_THAT(distance_to_line(p, ray), WithinAbs(0.0, 1e-6));
    }
}

TEST_CASE("what is drawn over the picture in grid space is where the picture has it") {
    const glm::ivec2 viewport(900, 700);
    const auto projection = GENERATE(Camera::Projection::perspective, Camera::Projection::straight);
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    camera.orbit(-0.3, 0.2);
    camera.set_projection(projection);
    for (const Vec3 p : {Vec3(0.0), Vec3(639.0, 479.0, 255.0), Vec3(100.5, 333.0, 71.0)}) {
        const glm::dvec4 clip = camera.clip_from_grid(900.0 / 700.0) * glm::dvec4(p, 1.0);
        const glm::dvec2 seen = on_screen(camera, p, viewport);
        CHECK_THAT((clip.x / clip.w + 1.0) * 450.0, WithinAbs(seen.x, 1e-6));
        CHECK_THAT((1.0 - clip.y / clip.w) * 350.0, WithinAbs(seen.y, 1e-6));
    }
}

TEST_CASE(
    "a close-up has its ball in the middle, and all of it in view, whatever was seen before") {
    const glm::ivec2 viewport = GENERATE(glm::ivec2(1280, 800), glm::ivec2(500, 900));
    const auto projection = GENERATE(Camera::Projection::perspective, Camera::Projection::straight);
    const double radius = GENERATE(8.0, 60.0);
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    camera.set_projection(projection);
    camera.zoom(3.0);
    camera.pan(50.0, 20.0, viewport.y);
    const Vec3 centre(200.0, 130.0, 90.0);
    camera.close_up(centre, radius);
    const glm::dvec2 middle = on_screen(camera, centre, viewport);
    CHECK_THAT(middle.x, WithinAbs(0.5 * viewport.x, 1e-6));
    CHECK_THAT(middle.y, WithinAbs(0.5 * viewport.y, 1e-6));
    double farthest = 0.0;
    for (const Vec3 way : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
        const glm::dvec2 seen = on_screen(camera, centre + radius * way, viewport) - middle;
        CHECK(std::abs(seen.x) <= 0.5 * viewport.x * 1.03);
        CHECK(std::abs(seen.y) <= 0.5 * viewport.y * 1.03);
        farthest =
            std::max({farthest, std::abs(seen.x) / viewport.x, std::abs(seen.y) / viewport.y});
    }
    CHECK(farthest > 0.25);  // of the window: not too small
}

TEST_CASE(
    "a view that was taken down is taken again, and held to what a hand can turn and zoom to") {
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    camera.orbit(0.4, -0.3);
    camera.zoom(2.5);
    camera.pan(12.0, 7.0, 800);
    const Camera::View view = camera.view();
    camera.reset();
    CHECK_FALSE(camera.view() == view);
    camera.set_view(view);
    CHECK(camera.view() == view);
    camera.set_view({.yaw_rad = 0.0, .pitch_rad = 9.0, .zoom = 1e9});
    CHECK(camera.view().pitch_rad < 1.6);
    CHECK(camera.view().zoom <= 50.0);
    camera.set_view({.centre_in_world = {1e300, 0.0, -1e300}});
    CHECK(glm::length(camera.view().centre_in_world) < 1e4);
}

TEST_CASE("a ray goes from near to far: down onto the relief") {
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    const Camera::Ray ray = camera.ray_under({640.0, 400.0}, {1280, 800});
    CHECK(ray.near_in_grid.z > 255.0);
    CHECK(ray.far_in_grid.z < 0.0);
}

TEST_CASE("the whole relief is in view after framing, whatever the window's proportions") {
    const glm::ivec2 size = GENERATE(glm::ivec2(1280, 800), glm::ivec2(400, 1600),
                                     glm::ivec2(3000, 300), glm::ivec2(512, 512));
    const auto projection = GENERATE(Camera::Projection::perspective, Camera::Projection::straight);
    const glm::ivec2 image = GENERATE(glm::ivec2(640, 480), glm::ivec2(288, 512));
    Camera camera;
    camera.frame_relief(image.x, image.y, 255.0);
    camera.set_projection(projection);
    glm::dvec2 least(1e9);
    glm::dvec2 most(-1e9);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p(corner & 1 ? image.x - 1 : 0, corner & 2 ? image.y - 1 : 0,
                     corner & 4 ? 255 : 0);
        least = glm::min(least, on_screen(camera, p, size));
        most = glm::max(most, on_screen(camera, p, size));
    }
    CHECK(std::min(least.x, least.y) >= 0.0);
    CHECK(most.x <= size.x);
    CHECK(most.y <= size.y);
    const glm::dvec2 filled = (most - least) / glm::dvec2(size);
    CHECK(std::max(filled.x, filled.y) > 0.75);  // and it fills most of the view
}

TEST_CASE("the straight view keeps the picture's proportions and does not see elevation") {
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    camera.orbit(0.3, 0.3);
    camera.set_projection(Camera::Projection::straight);
    const glm::ivec2 size(1280, 800);
    const glm::dvec2 origin = on_screen(camera, {0.0, 0.0, 0.0}, size);
    const glm::dvec2 right = on_screen(camera, {100.0, 0.0, 0.0}, size) - origin;
    const glm::dvec2 down = on_screen(camera, {0.0, 100.0, 200.0}, size) - origin;
    CHECK_THAT(right.y, WithinAbs(0.0, 1e-9));
    CHECK_THAT(down.x, WithinAbs(0.0, 1e-9));
    CHECK_THAT(right.x - down.y, WithinAbs(0.0, 1e-9));
    CHECK(right.x > 0.0);
}

TEST_CASE("grid and world convert back and forth, and the middle of the image is the world's") {
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    const Vec3 p(12.25, 300.5, -7.0);
    CHECK_THAT(glm::length(camera.grid_from_world(camera.world_from_grid(p)) - p),
               WithinAbs(0.0, 1e-12));
    CHECK_THAT(glm::length(camera.world_from_grid({319.5, 239.5, 0.0})), WithinAbs(0.0, 1e-12));
    CHECK(camera.world_from_grid({639.0, 0.0, 3.0}).x > 0.0);
    CHECK(camera.world_from_grid({639.0, 0.0, 3.0}).y > 0.0);
}

TEST_CASE("a drag to the right and down turns the near side right and down") {
    Camera camera;
    camera.frame_relief(640, 480, 200.0);
    const glm::ivec2 size(1280, 800);
    const Vec3 near_side(319.5, 239.5, 200.0);
    const glm::dvec2 before = on_screen(camera, near_side, size);
    camera.orbit(0.1, 0.1);
    const glm::dvec2 after = on_screen(camera, near_side, size);
    CHECK(after.x > before.x);
    CHECK(after.y > before.y);
}

TEST_CASE("a camera that is kept in front of the relief looks at its near side", "[camera]") {
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    const Camera::View home = camera.view();
    camera.keep_in_front();
    CHECK(camera.view() == home);
    camera.orbit(GENERATE(-9.0, 9.0), GENERATE(-2.0, 2.0));
    camera.keep_in_front();
    const Camera::Ray ray = camera.ray_under({450.0, 350.0}, {900, 700});
    const Vec3 way = ray.far_in_grid - ray.near_in_grid;
    CHECK(way.z < -0.35 * glm::length(way));
}

TEST_CASE("panning by some pixels moves the middle of the relief by as many") {
    const auto projection = GENERATE(Camera::Projection::perspective, Camera::Projection::straight);
    Camera camera;
    camera.set_covered_below(GENERATE(0.0, 0.2));
    camera.frame_relief(640, 480, 200.0);
    camera.set_projection(projection);
    camera.zoom(2.0);
    const glm::ivec2 size(1280, 800);
    const Vec3 middle(319.5, 239.5, 100.0);
    const glm::dvec2 before = on_screen(camera, middle, size);
    camera.pan(40.0, 25.0, size.y);
    const glm::dvec2 moved = on_screen(camera, middle, size) - before;
    CHECK_THAT(moved.x, WithinAbs(40.0, 1e-6));
    CHECK_THAT(moved.y, WithinAbs(-25.0, 1e-6));
}

TEST_CASE(
    "above a covered share of the viewport the whole relief is in view, and as wide as can be") {
    const glm::ivec2 relief = GENERATE(glm::ivec2(640, 480), glm::ivec2(288, 512));
    const glm::ivec2 size = GENERATE(glm::ivec2(1280, 800), glm::ivec2(500, 900));
    const auto projection = GENERATE(Camera::Projection::perspective, Camera::Projection::straight);
    Camera camera;
    camera.frame_relief(relief.x, relief.y, 100.0);
    camera.set_projection(projection);
    camera.set_covered_below(0.2);
    double widest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 place(corner & 1 ? relief.x - 1 : 0, corner & 2 ? relief.y - 1 : 0,
                         corner & 4 ? 100 : 0);
        const glm::dvec2 seen = on_screen(camera, place, size);
        const glm::dvec2 free_px(size.x, 0.8 * size.y);
        CHECK(seen.x >= 0.0);
        CHECK(seen.x <= free_px.x);
        CHECK(seen.y >= 0.0);
        CHECK(seen.y <= free_px.y);
        const glm::dvec2 from_middle = glm::abs(seen - 0.5 * free_px) / (0.5 * free_px);
        widest = std::max({widest, from_middle.x, from_middle.y});
    }
    CHECK(widest > 0.9);
}

TEST_CASE("zooming in makes the relief larger, within bounds to both sides") {
    Camera camera;
    camera.frame_relief(640, 480, 200.0);
    const glm::ivec2 size(1280, 800);
    const auto width = [&] {
        return on_screen(camera, {639.0, 240.0, 0.0}, size).x -
               on_screen(camera, {0.0, 240.0, 0.0}, size).x;
    };
    const double before = width();
    camera.zoom(1.5);
    CHECK_THAT(width() / before, WithinAbs(1.5, 1e-9));
    for (int k = 0; k < 500; ++k) camera.zoom(2.0);
    CHECK(std::isfinite(width()));
    for (int k = 0; k < 500; ++k) camera.zoom(0.5);
    CHECK(width() > 10.0);
    camera.zoom(0.0);  // ignored
    CHECK(width() > 10.0);
}

TEST_CASE("reset gives back what framing set, and pitch never goes over the top") {
    Camera camera;
    camera.frame_relief(640, 480, 200.0);
    const glm::dmat4 home = camera.view_from_world();
    camera.orbit(3.0, 100.0);
    camera.pan(10.0, 10.0, 800);
    const Vec3 up_in_view(camera.view_from_world() * glm::dvec4(0.0, 1.0, 0.0, 0.0));
    CHECK(up_in_view.y > 0.0);
    camera.reset();
    for (int column = 0; column < 4; ++column) {
        CHECK_THAT(glm::length(camera.view_from_world()[column] - home[column]),
                   WithinAbs(0.0, 1e-12));
    }
}

}  // namespace
}  // namespace dibhr
