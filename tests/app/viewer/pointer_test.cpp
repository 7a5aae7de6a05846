// Where the mouse points on the relief, and which of two dropped files is which.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <future>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "app/touching/pointer.hpp"
#include "app/viewer/files.hpp"
#include "app/viewer/input.hpp"
#include "app/viewer/task_group.hpp"
#include "app/viewer/trace.hpp"
#include "core/error.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "device/hand_device.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// Waves, 80 x 60.
DepthImage wavy_image() {
    DepthImage image{80, 60, 255.0, std::vector<float>(80 * 60)};
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 80; ++i) {
            image.at(i, j) =
                static_cast<float>(60.0 + 30.0 * std::sin(0.2 * i) * std::cos(0.15 * j));
        }
    }
    return image;
}

/// Of 64 x 48.
std::vector<std::uint8_t> coloured_pixels() {
    std::vector<std::uint8_t> rgb;
    for (int j = 0; j < 48; ++j)
        for (int i = 0; i < 64; ++i)
            for (const int level : {4 * i, 5 * j, 255 - 4 * i})
                rgb.push_back(static_cast<std::uint8_t>(level));
    return rgb;
}

const OpenRequest& request_of(const TemporaryFolder& folder, const char* first, const char* second,
                              OpenRequest& request) {
    request = {folder / first, folder / second, true};
    return request;
}

}  // namespace

TEST_CASE("the ray under the cursor meets the surface, and nothing of the surface is before it",
          "[pointer]") {
    const DepthImage image = wavy_image();
    const DepthSurface surface(image, image, 0.0, {40.0, 0.0});
    Camera camera;
    camera.frame_relief(80, 60, 40.0);
    const bool straight = GENERATE(true, false);
    camera.set_projection(straight ? Camera::Projection::straight
                                   : Camera::Projection::perspective);
    camera.orbit(GENERATE(-0.6, 0.0, 0.5), GENERATE(-0.4, 0.3));
    const glm::dvec2 screen{GENERATE(250.0, 300.0, 340.0), GENERATE(200.0, 260.0)};
    const Camera::Ray ray = camera.ray_under(screen, {600, 450});
    const std::optional<Vec3> point = surface_under(ray, surface);
    REQUIRE(point);
    const Vec3 p = *point;
    CHECK_THAT(p.z, WithinAbs(surface.elevation_at(p.x, p.y), 1e-6));
    const Vec3 way = ray.far_in_grid - ray.near_in_grid;
    CHECK_THAT(glm::length(glm::cross(glm::normalize(way), p - ray.near_in_grid)),
               WithinAbs(0.0, 1e-6));
    const double reach = glm::dot(p - ray.near_in_grid, way) / glm::dot(way, way);
    for (double s = 0.0; s < 0.999; s += 0.001) {
        const Vec3 before = ray.near_in_grid + s * reach * way;
        const bool inside =
            before.x >= 0.0 && before.x <= 79.0 && before.y >= 0.0 && before.y <= 59.0;
        if (inside) REQUIRE(before.z >= surface.elevation_at(before.x, before.y) - 1e-6);
    }
}

TEST_CASE("a cursor that never was over the relief points nowhere", "[pointer]") {
    const DepthImage image = wavy_image();
    const DepthSurface surface(image, image, 0.0, {40.0, 0.0});
    HandPointer pointer;
    const Camera::Ray beside{{-50.0, -50.0, 100.0}, {-50.0, -50.0, -100.0}};
    CHECK_FALSE(pointer.target(beside, surface, {true, false, 0.0}).pointing);
}

TEST_CASE("a stroke over the image's edge goes on beside it, and the wheel presses deeper",
          "[pointer]") {
    const DepthImage image = wavy_image();
    const DepthSurface surface(image, image, 0.0, {40.0, 0.0});
    HandPointer pointer;
    const Camera::Ray over{{70.0, 30.0, 100.0}, {70.0, 30.0, -100.0}};
    const Camera::Ray beside{{90.0, 30.0, 100.0}, {90.0, 30.0, -100.0}};
    CHECK(pointer.target(over, surface, {true, true, 1.0}).wheel_px > 0.0);
    const MouseTarget target = pointer.target(beside, surface, {true, true, 1.0});
    CHECK_THAT(target.cursor_in_grid.x, WithinAbs(90.0, 1e-9));
    CHECK(target.pressed);
    CHECK_THAT(pointer.target(over, surface, {true, false, 0.0}).wheel_px, WithinAbs(0.0, 1e-12));
}

TEST_CASE("the trace is where one has touched, stays on a surface that moves, and fades",
          "[pointer]") {
    const DepthImage low = image_of(64, 48, 255.0, [](int, int) { return 50; });
    const DepthImage high = image_of(64, 48, 255.0, [](int i, int) { return 100 + i; });
    const DepthSurface before(low, low, 0.0, {255.0});
    const DepthSurface after(high, high, 0.0, {255.0});
    TouchTrace trace;
    CHECK(trace.points(before, 0.0).empty());
    for (int k = 0; k <= 100; ++k) trace.add({10.0 + 0.4 * k, 20.0, 50.0}, 0.01 * k);
    const std::vector<TracePoint> now = trace.points(before, 1.0);
    REQUIRE(now.size() == 8);  // a dot every 5 px or a little more, of 40
    for (std::size_t k = 1; k < now.size(); ++k) {
        CHECK(now[k].place.x - now[k - 1].place.x >= TouchTrace::kApart_px);
        CHECK(now[k].strength > now[k - 1].strength);
        CHECK(now[k].place.z == 50.0);
    }
    for (const TracePoint& point : trace.points(after, 1.5))
        CHECK_THAT(point.place.z, WithinAbs(100.0 + point.place.x, 1e-9));
    CHECK(trace.points(after, 4.5).size() < now.size());
    CHECK(trace.points(after, 5.5).empty());
}

TEST_CASE("of two dropped pictures the depth is known by its name, else by being grey",
          "[opening]") {
    const TemporaryFolder folder;
    write_png({64, 48, coloured_pixels()}, folder / "a.png");
    write_depth_png(folder / "b.png", 64, 48, 0, 4);
    std::filesystem::copy_file(folder / "b.png", folder / "x_depth.png");
    std::filesystem::copy_file(folder / "a.png", folder / "x_color.png");
    OpenRequest request;
    CHECK(open_request(request_of(folder, "a.png", "b.png", request))->description().depth_path ==
          folder / "b.png");
    CHECK(open_request(request_of(folder, "b.png", "a.png", request))->description().depth_path ==
          folder / "b.png");
    CHECK(open_request(request_of(folder, "x_depth.png", "a.png", request))
              ->description()
              .depth_path == folder / "x_depth.png");
    const auto alone = open_request({folder / "x_depth.png", {}, true});
    CHECK(alone->description().colour_path == folder / "x_color.png");
}

TEST_CASE("opening in the background gives the words of the error, and can be tried again",
          "[opening]") {
    const TemporaryFolder folder;
    TaskGroup tasks;
    BackgroundTask<OpenResult> opening(tasks);
    const OpenRequest request{folder / "nowhere.mp4", {}, false};
    for (int attempt = 0; attempt < 2; ++attempt) {
        REQUIRE(opening.start([request] { return try_open(request); }));
        std::optional<OpenResult> opened;
        REQUIRE(eventually([&] {
            opened = opening.take();
            return opened.has_value();
        }));
        CHECK(opened->media == nullptr);
        CHECK(opened->failure.find("nowhere.mp4") != std::string::npos);
    }
}

TEST_CASE("work that never ends is left behind, which whoever ends the program is told",
          "[opening]") {
    TaskGroup tasks;
    CHECK(tasks.wait_all(std::chrono::milliseconds(0)));
    const auto let_go = std::make_shared<std::promise<void>>();
    {
        BackgroundTask<int> errand(tasks);
        REQUIRE(errand.start([let_go] {
            let_go->get_future().wait();
            return 1;
        }));
        CHECK_FALSE(errand.start([] { return 2; }));
        CHECK_FALSE(errand.take());
        errand.restart([] { return 2; });  // the first result is dropped
        CHECK(eventually([&] { return errand.take() == 2; }));
    }
    // A wait for the task until here would never end.
    CHECK_FALSE(tasks.wait_all(std::chrono::milliseconds(1)));
    let_go->set_value();
    CHECK(tasks.wait_all(std::chrono::minutes(1)));
    tasks.abandon_one();
    CHECK_FALSE(tasks.wait_all(std::chrono::milliseconds(0)));
}

TEST_CASE("a device that cannot be used says what to do", "[device]") {
    CHECK_THROWS_AS(make_hand_device("falcon"), DeviceError);
    CHECK_THROWS_AS(make_hand_device("glove"), DeviceError);
    CHECK_THROWS_AS(make_hand_device("goals:/nowhere.csv"), InputError);
    CHECK(make_hand_device("auto").mouse != nullptr);
}

TEST_CASE("a drag turns the view by its own way, not by how the pointer came to its begin",
          "[pointer]") {
    const auto eye_after = [](glm::dvec2 before) {
        Camera camera;
        camera.frame_relief(64, 48, 20.0);
        ReliefMouse mouse;
        Pointer pointer;
        pointer.position_px = before;
        mouse.use(pointer, 0.0, false, {640, 480}, camera);
        pointer.right = true;
        for (const double x : {300.0, 310.0, 330.0}) {
            pointer.position_px = {x, 200.0};
            mouse.use(pointer, 0.0, false, {640, 480}, camera);
        }
        return camera.view_from_world();
    };
    CHECK(eye_after({20.0, 400.0}) == eye_after({300.0, 200.0}));
    CHECK_FALSE(eye_after({300.0, 200.0}) == Camera().view_from_world());
}

TEST_CASE("a view goes over the clipboard as text, to the same bits, and nothing else is a view",
          "[pointer]") {
    const Camera::View view{.yaw_rad = 0.1,
                            .pitch_rad = -1.0 / 3.0,
                            .zoom = 2.7,
                            .centre_in_world = {1e-7, -12.5, 100.0}};
    const auto back = view_in(text_of(view));
    REQUIRE(back);
    CHECK(*back == view);
    for (const char* text :
         {"", "hello", "dibhr-view", "dibhr-view 1 2 3", "dibhr-view 0 0 0 1 1 1",
          "dibhr-view nan 0 1 0 0 0", "view 0 0 1 0 0 0"}) {
        CAPTURE(text);
        CHECK_FALSE(view_in(text));
    }
}
