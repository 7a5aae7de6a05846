// The time for a picture drawn by software.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>

#include "render/gl_objects.hpp"
#include "render/scene_view.hpp"
#include "tests/render/hidden_window.hpp"
#include "tests/render/scenes.hpp"
#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

constexpr int kPictures = 60;
// Processor time of all threads for one picture: three times the usual; other programs' excluded.
constexpr double kMost_ms = 150.0;

TEST_CASE("a playing 640x480 relief at 1280x800 takes at most 150 ms of processors a picture",
          "[bench]") {
    HiddenWindow window;
    const auto noise = colour_image(640, 480, [](int i, int j) {
        return Rgb{i % 256, j % 256, 90};
    });
    const auto waves = [](double phase) {
        return depth_image(640, 480, [phase](int i, int j) {
            return 120.0 + 80.0 * std::sin(i / 40.0 + phase) * std::cos(j / 55.0);
        });
    };
    const Frame frames[] = {frame(waves(0.0), noise), frame(waves(0.1), noise),
                            frame(waves(0.2), noise)};
    Camera camera;
    camera.frame_relief(640, 480, 255.0);
    const glm::ivec2 size(1280, 800);
    const Offscreen offscreen(size, 0);
    SceneView view;
    SceneContent content;
    content.markers.visible = true;
    content.markers.contact = true;
    content.markers.proxy = {320.0, 240.0, 150.0};
    content.markers.goal = {325.0, 245.0, 110.0};
    const bool leaves_a_mark = GENERATE(false, true);  // dent, shadow, gauge and a long trace
    if (leaves_a_mark) {
        content.dent = {content.markers.proxy, 13.0, 5.0, 0.45};
        content.markers.force_newton = {0.0, 0.5, 1.5};
        content.markers.most_newton = 4.0;
        for (int k = 0; k < 100; ++k)
            content.markers.trace.push_back({{50.0 + 5.0 * k, 240.0, 150.0}, 0.01 * k});
    }
    double sum_ms = 0.0;
    std::clock_t processor_start = 0;
    for (int k = -3; k < kPictures; ++k) {
        // Two pictures a video frame, as at 60 pictures and 30 frames a second.
        const auto n = static_cast<std::size_t>((k + 4) / 2);
        content.depth = {&frames[n % 3], &frames[(n + 1) % 3], k % 2 == 0 ? 0.0 : 0.5};
        content.colour = &frames[n % 3];
        if (k == 0) processor_start = std::clock();
        const auto start = std::chrono::steady_clock::now();
        view.draw(content, camera, size);
        glFinish();
        const auto spent = std::chrono::steady_clock::now() - start;
        if (k >= 0) sum_ms += std::chrono::duration<double, std::milli>(spent).count();
    }
    const double processor_ms =
        1e3 * static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC / kPictures;
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    WARN(renderer << (leaves_a_mark ? ", with dent and trace: " : ": ") << sum_ms / kPictures
                  << " ms a picture, " << processor_ms << " ms of all processors");
    CHECK(processor_ms <= kMost_ms);
}

}  // namespace
}  // namespace dibhr
