// The picture, drawn by a real OpenGL: the drawn surface is the touched one.
#include "render/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "core/haptics/surface.hpp"
#include "render/gl_objects.hpp"
#include "tests/render/hidden_window.hpp"
#include "tests/render/scenes.hpp"
#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

using Catch::Matchers::WithinAbs;

/// The screen pixel that shows a grid point.
glm::ivec2 pixel_of(const Camera& camera, Vec3 grid, glm::ivec2 size) {
    return glm::ivec2(glm::floor(on_screen(camera, grid, size)));
}

/// The grid point at each pixel's drawn depth; only points well inside the image.
std::vector<Vec3> visible_points(const Camera& camera, glm::ivec2 size, glm::ivec2 image) {
    std::vector<float> depth(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    glReadPixels(0, 0, size.x, size.y, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
    const double aspect = static_cast<double>(size.x) / size.y;
    const glm::dmat4 world_from_clip =
        glm::inverse(camera.clip_from_view(aspect) * camera.view_from_world());
    std::vector<Vec3> points;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                            static_cast<std::size_t>(x);
            const glm::dvec4 clip(2.0 * (x + 0.5) / size.x - 1.0, 2.0 * (y + 0.5) / size.y - 1.0,
                                  2.0 * static_cast<double>(depth[at]) - 1.0, 1.0);
            const glm::dvec4 world = world_from_clip * clip;
            const Vec3 p = camera.grid_from_world(Vec3(world) / world.w);
            if (p.x > 0.05 && p.y > 0.05 && p.x < image.x - 1.05 && p.y < image.y - 1.05 &&
                depth[at] < 1.0F) {
                points.push_back(p);
            }
        }
    }
    return points;
}

TEST_CASE("every pixel of the relief shows a point of the surface that the hand feels") {
    const auto projection = GENERATE(Camera::Projection::perspective, Camera::Projection::straight);
    const double roughness_px = GENERATE(0.0, 2.0);
    HiddenWindow window;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> level(0.0, 255.0);
    const auto any = [&](int, int) { return level(random); };
    const Frame from = frame(depth_image(9, 7, any));
    const Frame to = frame(depth_image(9, 7, any));
    const BumpMap bump{3, 2, {0.0F, 1.0F, 0.5F, 0.25F, 0.75F, 0.1F}};
    SceneContent content = still(from);
    content.depth = {&from, &to, 0.3};
    content.shape = {4.0, roughness_px};
    content.bump = &bump;
    content.relief_style.discard_silhouettes = false;
    Camera camera;
    camera.frame_relief(9, 7, 4.0);
    camera.set_projection(projection);

    const glm::ivec2 size(320, 240);
    SceneView view;
    const Offscreen offscreen(size, 0);
    view.draw(content, camera, size);
    const DepthSurface felt(*from.depth, *to.depth, 0.3, content.shape, &bump);
    const std::vector<Vec3> points = visible_points(camera, size, {9, 7});
    CHECK(points.size() > 15'000);
    double worst_px = 0.0;
    for (const Vec3& p : points) {
        worst_px = std::max(worst_px, std::abs(p.z - felt.elevation_at(p.x, p.y)));
    }
    CHECK_THAT(worst_px, WithinAbs(0.0, 2e-3));
    CHECK(window.errors().empty());
}

TEST_CASE("a cell with two high corners on its diagonal is a ridge, not a valley") {
    HiddenWindow window;
    const Frame shown = frame(depth_image(2, 2, [](int i, int j) { return i == j ? 0.0 : 255.0; }));
    SceneContent content = still(shown);
    content.shape.relief_px = 1.0;
    const Camera camera = straight(2, 2, 1.0);
    const glm::ivec2 size(101, 101);
    SceneView view;
    const Offscreen offscreen(size, 0);
    view.draw(content, camera, size);
    for (const Vec3& p : visible_points(camera, size, {2, 2})) {
        CHECK_THAT(p.z, WithinAbs(1.0 - std::abs(p.x + p.y - 1.0), 1e-3));
    }
}

TEST_CASE("painted by its depth, the relief has the legend's colours from far to near") {
    const ReliefPaint paint = GENERATE(ReliefPaint::turbo, ReliefPaint::viridis, ReliefPaint::grey);
    HiddenWindow window;
    const auto colours = depth_colours(paint);
    REQUIRE(colours);
    REQUIRE(colours->columns == 256);
    const auto purple = colour_image(64, 48, [](int, int) { return Rgb{200, 0, 200}; });
    for (const double level : {20.0, 128.0, 240.0}) {
        const Frame shown_frame =
            frame(depth_image(64, 48, [level](int, int) { return level; }), purple);
        SceneContent content = still(shown_frame);
        content.relief_style.paint = paint;
        content.relief_style.light = 0.0;
        const ColourImage picture = SceneView().capture(content, straight(64, 48), {640, 480});
        const auto shown =
            pixel(picture, pixel_of(straight(64, 48), {32.0, 24.0, level}, {640, 480}));
        for (std::size_t c = 0; c < 3; ++c) {
            const int wanted = colours->rgb[3 * static_cast<std::size_t>(level) + c];
            CHECK(std::abs(shown[c] - wanted) <= 6);
        }
    }
}

TEST_CASE("where no surface was ever seen the relief is dimmed and hatched, and only there") {
    const bool textured = GENERATE(true, false);
    HiddenWindow window;
    const auto depth = depth_image(64, 48, [](int, int) { return 100.0; });
    const auto white = colour_image(64, 48, [](int, int) { return Rgb{230, 230, 230}; });
    const Frame whole = frame(depth, white);
    Frame holed = whole;
    std::vector<std::uint8_t> unseen(64 * 48, 0);
    for (std::size_t k = 0; k < unseen.size(); ++k) unseen[k] = k % 64 < 32 ? 1 : 0;
    holed.unseen = std::make_shared<const std::vector<std::uint8_t>>(unseen);
    const auto picture_of = [&, textured = textured](const Frame& shown) {
        SceneContent content = still(shown);
        content.relief_style.paint = textured ? ReliefPaint::video : ReliefPaint::clay;
        return SceneView().capture(content, straight(64, 48), {640, 480});
    };
    const ColourImage plain = picture_of(whole);
    const ColourImage told_apart = picture_of(holed);
    const Camera camera = straight(64, 48);
    const auto at = [&](double x, double y) { return pixel_of(camera, {x, y, 100.0}, {640, 480}); };
    int darkest = 255;
    int lightest = 0;
    for (int step = 0; step < 120; ++step) {
        const int level = pixel(told_apart, at(4.0 + 0.2 * step, 20.0))[1];
        darkest = std::min(darkest, level);
        lightest = std::max(lightest, level);
    }
    CHECK(5 * lightest < 3 * pixel(plain, at(16.0, 20.0))[1]);  // dimmed
    CHECK(lightest - darkest > 10);                             // in lines
    for (double x = 34.0; x < 62.0; x += 0.2)
        CHECK(pixel(told_apart, at(x, 20.0)) == pixel(plain, at(x, 20.0)));
    CHECK(window.errors().empty());
}

TEST_CASE("of a finger's surface the one that it touches is drawn") {
    HiddenWindow window;
    SceneView view;
    const auto pit = depth_image(
        64, 48, [](int i, int j) { return i > 24 && i < 40 && j > 16 && j < 32 ? 20.0 : 200.0; });
    const auto closed = depth_image(64, 48, [](int, int) { return 200.0; });
    Camera camera;
    camera.frame_relief(64, 48, 30.0);
    const auto picture_of = [&](const Frame& shown) {
        SceneContent content = still(shown);
        content.shape.relief_px = 30.0;
        return view.capture(content, camera, {160, 120}).rgb;
    };
    Frame felt = frame(closed);
    CHECK(picture_of(felt) != picture_of(frame(pit)));
    felt.undilated = pit;
    CHECK(picture_of(felt) == picture_of(frame(pit)));
}

TEST_CASE("the picture lies the right way round on the relief, in its own colours") {
    HiddenWindow window;
    const Rgb upper_left{250, 10, 10};
    const Rgb upper_right{10, 250, 10};
    const Rgb lower_left{10, 10, 250};
    const Rgb lower_right{240, 240, 20};
    const auto quarters = colour_image(16, 64, [&](int i, int j) {
        if (j < 32) return i < 8 ? upper_left : upper_right;
        return i < 8 ? lower_left : lower_right;
    });
    // Colour and depth differ in size and proportion: normalised coordinates match them.
    const Frame shown = frame(depth_image(40, 30, [](int, int) { return 100.0; }), quarters);
    SceneContent content = still(shown);
    content.relief_style.light =
        GENERATE(0.0, 0.6, 1.0);  // a flat relief keeps the colours in any light
    const Camera camera = straight(40, 30);
    const glm::ivec2 size(200, 150);
    SceneView view;
    const ColourImage picture = view.capture(content, camera, size);
    const auto seen = [&](double x, double y) {
        return pixel(picture, pixel_of(camera, {x, y, 0.0}, size));
    };
    CHECK(difference(seen(5.0, 5.0), upper_left) <= 2);
    CHECK(difference(seen(35.0, 5.0), upper_right) <= 2);
    CHECK(difference(seen(5.0, 25.0), lower_left) <= 2);
    CHECK(difference(seen(35.0, 25.0), lower_right) <= 2);
    CHECK(window.errors().empty());
}

TEST_CASE("a vertex has the colour of the picture's pixel of the same column and row") {
    HiddenWindow window;
    const auto colour_of = [](int i, int j) {
        return Rgb{60 * (i % 4), 60 * (j % 4), 25 * (i + j)};
    };
    const Frame shown =
        frame(depth_image(5, 4, [](int, int) { return 0.0; }), colour_image(5, 4, colour_of));
    const Camera camera = straight(5, 4);
    const glm::ivec2 size(1000, 800);
    SceneView view;
    const ColourImage picture = view.capture(still(shown), camera, size);
    for (int j = 1; j < 3; ++j) {
        for (int i = 1; i < 4; ++i) {
            const Rgb seen = pixel(picture, pixel_of(camera, Vec3(i, j, 0.0), size));
            CHECK(difference(seen, colour_of(i, j)) <= 2);
        }
    }
}

TEST_CASE("the light comes from the upper left, and without light there is none") {
    HiddenWindow window;
    const Frame shown =
        frame(depth_image(40, 30, [](int i, int) { return i < 20 ? 4.0 * i : 4.0 * (39 - i); }));
    SceneContent content = still(shown);
    const Camera camera = straight(40, 30);
    const glm::ivec2 size(200, 150);
    SceneView view;
    const auto brightness = [&](double x) {
        const ColourImage picture = view.capture(content, camera, size);
        return pixel(picture, pixel_of(camera, {x, 15.0, 0.0}, size))[0];
    };
    CHECK(brightness(8.0) > brightness(31.0) + 20);
    content.relief_style.light = 0.0;
    CHECK(std::abs(brightness(8.0) - brightness(31.0)) <= 1);
}

TEST_CASE("a material tints the video and clay but not the colours of depth") {
    const ReliefPaint paint = GENERATE(ReliefPaint::video, ReliefPaint::clay, ReliefPaint::turbo);
    HiddenWindow window;
    const Frame shown = frame(depth_image(40, 30, [](int i, int) { return 2.0 * i; }),
                              colour_image(40, 30, [](int, int) {
                                  return Rgb{128, 128, 128};
                              }));
    SceneContent content = still(shown);
    content.relief_style.paint = paint;
    const Camera camera = straight(40, 30);
    const glm::ivec2 size(200, 150);
    SceneView view;
    const auto middle = [&] {
        const ColourImage picture = view.capture(content, camera, size);
        return pixel(picture, pixel_of(camera, {20.0, 15.0, 40.0}, size));
    };
    const Rgb plain = middle();
    content.look = {{1.0F, 0.2F, 0.1F}, 0.8, 0.0, 0.0};
    const Rgb tinted = middle();
    if (paint == ReliefPaint::turbo) {
        CHECK(tinted == plain);
    } else {
        CHECK(tinted[0] - tinted[2] > plain[0] - plain[2] + 40);
    }
    CHECK(window.errors().empty());
}

TEST_CASE("gloss gleams where the surface mirrors the light and fuzz where it is seen aslant") {
    HiddenWindow window;
    // From left to right: towards the light, flat, away from it.
    const Frame shown = frame(
        depth_image(60, 30, [](int i, int) { return i < 30 ? 100.0 : 100.0 + 3.0 * (i - 30); }),
        colour_image(60, 30, [](int, int) {
            return Rgb{90, 90, 90};
        }));
    SceneContent content = still(shown);
    const Camera camera = straight(60, 30);
    const glm::ivec2 size(300, 150);
    SceneView view;
    const auto brightness = [&](double x, double z) {
        const ColourImage picture = view.capture(content, camera, size);
        return pixel(picture, pixel_of(camera, {x, 15.0, z}, size))[1];
    };
    const int flat = brightness(15.0, 100.0);
    const int steep = brightness(45.0, 145.0);
    content.look = {.gloss = 1.0};
    CHECK(brightness(15.0, 100.0) > flat);
    CHECK(std::abs(brightness(45.0, 145.0) - steep) <= 2);
    content.look = {.fuzz = 1.0};
    CHECK(std::abs(brightness(15.0, 100.0) - flat) <= 2);
    CHECK(brightness(45.0, 145.0) > steep + 20);
}

TEST_CASE("beside a step the far face goes on under the near one, in its own colour") {
    const int scale = GENERATE(1, 32);  // up to 2048 x 1536 pixels
    HiddenWindow window;
    const int columns = 64 * scale;
    const int rows = 48 * scale;
    const double far = 10.0 * scale;
    const auto is_far = [&](int i) { return i < columns / 2; };
    Frame shown =
        frame(depth_image(columns, rows, [&](int i, int) { return is_far(i) ? 10.0 : 110.0; }),
              colour_image(64, 48, [](int i, int) {
                  return i < 32 ? Rgb{40, 60, 220} : Rgb{220, 60, 40};
              }));
    SceneContent content = still(shown);
    content.shape.relief_px = 255.0 * scale;
    content.relief_style.light = 0.0;
    Camera camera;  // from the far face's side
    camera.frame_relief(columns, rows, 110.0 * scale);
    const glm::ivec2 size(320, 240);
    SceneView view;
    const auto seen = [&](double x, double z) {
        const ColourImage picture = view.capture(content, camera, size);
        return pixel(picture, pixel_of(camera, {x * scale, 20.0 * scale, z}, size));
    };
    for (const double x : {10.0, 33.5, 36.0, 40.0, 46.0}) {
        CAPTURE(x);
        CHECK(difference(seen(x, far), {40, 60, 220}) < 40);
    }
    CHECK(difference(seen(50.0, 110.0 * scale), {220, 60, 40}) < 40);
    content.relief_style.silhouette_slope = 60.0 * scale;  // then it is no step, but a steep slope
    CHECK(difference(seen(46.0, far), {40, 60, 220}) > 60);
    CHECK(window.errors().empty());
}

TEST_CASE("a wall with bumps behind a plate looks as it does without the plate") {
    HiddenWindow window;
    constexpr int kColumns = 64;
    constexpr int kRows = 48;
    constexpr int kPlate = kColumns / 2;  // where it begins
    constexpr double kWall = 10.0;
    const auto grey = colour_image(kColumns, kRows, [](int, int) { return Rgb{128, 128, 128}; });
    const auto height = [](int i, int j) { return 0.5 + 0.5 * std::sin(0.9 * i + 0.5 * j); };
    BumpMap bump{kColumns, kRows, {}};
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i) bump.heights.push_back(static_cast<float>(height(i, j)));
    Camera camera;  // from the wall's side
    camera.frame_relief(kColumns, kRows, 110.0);
    const glm::ivec2 size(640, 480);
    SceneView view;
    const auto picture = [&](double plate) {
        const Frame shown = frame(
            depth_image(kColumns, kRows, [&](int i, int) { return i < kPlate ? kWall : plate; }),
            grey);
        SceneContent content = still(shown);
        content.shape = {255.0, 4.0};
        content.bump = &bump;
        return view.capture(content, camera, size);
    };
    const ColourImage alone = picture(kWall);
    const ColourImage behind = picture(110.0);
    int least = 255;
    int most = 0;
    for (int i = kPlate + 2; i < kPlate + 14; ++i) {
        for (int j = 12; j < 36; ++j) {
            const glm::ivec2 at =
                pixel_of(camera, {1.0 * i, 1.0 * j, kWall + 4.0 * height(i, j)}, size);
            CAPTURE(i, j);
            CHECK(difference(pixel(behind, at), pixel(alone, at)) < 24);
            least = std::min(least, pixel(alone, at)[0]);
            most = std::max(most, pixel(alone, at)[0]);
        }
    }
    CHECK(most - least > 60);  // the bumps are seen
}

TEST_CASE("seen straight on, there is no gap between the two sides of a step") {
    HiddenWindow window;
    const Frame shown = frame(depth_image(6, 6, [](int i, int) { return i < 3 ? 10.0 : 210.0; }));
    const Camera camera = straight(6, 6);
    const glm::ivec2 size(300, 300);
    SceneView view;
    const ColourImage backdrop = view.capture({}, camera, size);
    const ColourImage cut = view.capture(still(shown), camera, size);
    const glm::ivec2 from = pixel_of(camera, {1.0, 2.3, 0.0}, size);
    const glm::ivec2 to = pixel_of(camera, {4.0, 2.3, 0.0}, size);
    for (int x = from.x; x <= to.x; ++x) {
        CAPTURE(x);
        CHECK(difference(pixel(cut, {x, from.y}), pixel(backdrop, {x, from.y})) > 20);
    }
}

TEST_CASE("without frames, or with an image of one pixel, there is only the backdrop") {
    HiddenWindow window;
    const Camera camera = straight(6, 6);
    const glm::ivec2 size(64, 48);
    SceneView view;
    const ColourImage backdrop = view.capture({}, camera, size);
    const Frame empty;
    const Frame dot = frame(depth_image(1, 1, [](int, int) { return 100.0; }));
    const Frame row = frame(depth_image(64, 1, [](int, int) { return 100.0; }));
    const Frame other = frame(depth_image(6, 6, [](int, int) { return 100.0; }));
    for (const Frame* shown : {&empty, &dot, &row}) {
        CHECK(view.capture(still(*shown), camera, size).rgb == backdrop.rgb);
    }
    SceneContent mixed;
    mixed.depth = {&other, &dot, 0.5};  // sizes that do not match
    CHECK(view.capture(mixed, camera, size).rgb == backdrop.rgb);
    CHECK(view.capture(still(other), camera, size).rgb != backdrop.rgb);
    CHECK(window.errors().empty());
}

TEST_CASE("a view keeps no frame that it has drawn") {
    HiddenWindow window;
    SceneView view;
    Frame shown = frame(depth_image(9, 7, [](int i, int j) { return 9.0 * i + j; }),
                        colour_image(9, 7, [](int i, int j) {
                            return Rgb{i, j, 90};
                        }));
    shown.unseen = std::make_shared<const std::vector<std::uint8_t>>(std::size_t{9 * 7});
    const std::weak_ptr<const DepthImage> depth = shown.depth;
    const std::weak_ptr<const ColourImage> colour = shown.colour;
    const std::weak_ptr<const std::vector<std::uint8_t>> unseen = shown.unseen;
    CHECK(view.capture(still(shown), straight(9, 7), {64, 48}).rows == 48);
    shown = {};
    CHECK(depth.expired());
    CHECK(colour.expired());
    CHECK(unseen.expired());
}

TEST_CASE("a view that has shown other frames draws the same as a fresh one") {
    HiddenWindow window;
    const glm::ivec2 size(160, 120);
    Camera camera;
    camera.frame_relief(32, 24, 60.0);
    SceneView used;
    std::mt19937 random(3);
    BumpMap bump{4, 4, std::vector<float>(16, 0.0F)};
    for (int k = 0; k < 12; ++k) {
        // Frames are freed in every round, so that new frames may get their addresses.
        const auto noise = [&](int, int) { return static_cast<double>(random() % 256U); };
        const auto colours = [&](int, int) {
            return Rgb{static_cast<int>(random() % 256U), 90, 0};
        };
        const Frame a = frame(depth_image(32, 24, noise), colour_image(8, 6, colours));
        const Frame b = frame(depth_image(32, 24, noise), colour_image(8, 6, colours));
        const Frame c = frame(depth_image(32, 24, noise), colour_image(8, 6, colours));
        bump.heights[static_cast<std::size_t>(k)] = 1.0F;
        SceneContent content;
        content.shape = {60.0, 20.0};
        content.bump = &bump;
        content.relief_style.coarse = k % 4 == 3;
        const Frame* const order[] = {&a, &b, &c, &a, &a};
        for (int step = 0; step < 4; ++step) {
            content.depth = {order[step], order[step + 1], 0.25};
            content.colour = order[step];
            SceneView fresh;
            const ColourImage expected = fresh.capture(content, camera, size);
            CAPTURE(k, step);
            CHECK(used.capture(content, camera, size).rgb == expected.rgb);
        }
    }
    CHECK(window.errors().empty());
}

TEST_CASE("the force arrow points on the screen where the force points in the grid") {
    HiddenWindow window;
    const Frame shown =
        frame(depth_image(64, 48, [](int, int) { return 0.0; }), colour_image(1, 1, [](int, int) {
                  return Rgb{60, 60, 60};
              }));
    SceneContent content = still(shown);
    const Camera camera = straight(64, 48, 100.0);
    const glm::ivec2 size(640, 480);
    const Vec3 direction =
        GENERATE(Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(-0.6, -0.8, 0.0));
    content.markers.visible = true;
    content.markers.proxy = {32.0, 24.0, 50.0};
    content.markers.goal = content.markers.proxy;
    content.markers.force_newton = direction;
    content.markers.newton_per_px = 1.0 / 20.0;
    SceneView view;
    const ColourImage picture = view.capture(content, camera, size);
    const auto yellow = [&](double along_px) {
        const Vec3 p = content.markers.proxy + direction * along_px;
        const Rgb seen = pixel(picture, pixel_of(camera, p, size));
        return seen[0] > 120 && seen[1] > 110 && seen[2] < seen[0] - 50;
    };
    CHECK(yellow(7.0));
    CHECK(yellow(15.0));
    CHECK_FALSE(yellow(23.0));
    CHECK_FALSE(yellow(-7.0));
    CHECK(window.errors().empty());
}

TEST_CASE("the ring around the proxy shows the force as a part of the most, wherever it points") {
    HiddenWindow window;
    const Frame shown =
        frame(depth_image(64, 48, [](int, int) { return 0.0; }), colour_image(1, 1, [](int, int) {
                  return Rgb{60, 60, 60};
              }));
    SceneContent content = still(shown);
    const Camera camera = straight(64, 48, 100.0);
    const glm::ivec2 size(1280, 960);
    content.markers.visible = true;
    content.markers.proxy = {32.0, 24.0, 50.0};
    content.markers.goal = content.markers.proxy;
    content.markers.newton_per_px = 1e3;  // makes the arrow too short to be visible
    content.markers.most_newton = 4.0;
    const double share = GENERATE(0.1, 0.25, 0.6, 0.9, 1.0, 1.5);
    const Vec3 direction = GENERATE(Vec3(0.0, 0.0, 1.0), Vec3(0.6, 0.8, 0.0));
    content.markers.force_newton = direction * share * 4.0;
    SceneView view;
    const ColourImage picture = view.capture(content, camera, size);
    const glm::ivec2 centre = pixel_of(camera, content.markers.proxy, size);
    int wrong = 0;
    for (int k = 0; k < 360; ++k) {
        const double turn = (k + 0.5) / 360.0;  // clockwise from the top
        if (std::abs(turn - share) < 0.02 || turn < 0.02 || turn > 0.98) continue;  // its ends
        const double radius_px = 22.0 * 1.2 * 0.925;  // in the middle of the ring
        const glm::ivec2 at(
            std::lround(centre.x + radius_px * std::sin(2.0 * std::numbers::pi * turn)),
            std::lround(centre.y - radius_px * std::cos(2.0 * std::numbers::pi * turn)));
        const Rgb seen = pixel(picture, at);
        const bool lit = seen[0] > 120 && seen[1] > 110 && seen[2] < seen[0] - 50;
        if (lit != (turn < share)) ++wrong;
    }
    CHECK(wrong == 0);
    CHECK(window.errors().empty());
}

TEST_CASE("the skin gives way under the proxy, in a shadow, and nowhere else") {
    HiddenWindow window;
    const Frame shown =
        frame(depth_image(64, 48, [](int, int) { return 100.0; }), colour_image(1, 1, [](int, int) {
                  return Rgb{200, 200, 200};
              }));
    SceneContent content = still(shown);
    content.relief_style.light = 0.0;
    const Camera camera = straight(64, 48);
    const glm::ivec2 size(640, 480);
    SceneView view;
    const ColourImage before = view.capture(content, camera, size);
    content.dent = {.at = {32.0, 24.0, 100.0}, .radius_px = 5.0, .depth_px = 3.0, .shadow = 0.5};
    const Offscreen offscreen(size, 0);
    view.draw(content, camera, size);
    double deepest = 0.0, off_centre_px = 0.0;
    for (const Vec3& p : visible_points(camera, size, {64, 48})) {
        const double deep = 100.0 - p.z;
        const double away = std::hypot(p.x - 32.0, p.y - 24.0);
        CHECK_THAT(deep, WithinAbs(3.0 * std::exp(-away * away / 25.0), 0.12));
        if (deep > deepest) off_centre_px = away;
        deepest = std::max(deepest, deep);
    }
    CHECK_THAT(deepest, WithinAbs(3.0, 0.05));
    CHECK(off_centre_px < 1.0);
    const ColourImage after = view.capture(content, camera, size);
    const auto brightness = [&](const ColourImage& picture, Vec3 at) {
        return static_cast<int>(pixel(picture, pixel_of(camera, at, size))[0]);
    };
    CHECK(brightness(after, {32.0, 24.0, 97.0}) < 0.6 * brightness(before, {32.0, 24.0, 100.0}));
    for (const Vec3 far : {Vec3(10.0, 24.0, 100.0), Vec3(32.0, 4.0, 100.0)})
        CHECK(brightness(after, far) == brightness(before, far));
    CHECK(window.errors().empty());
}

TEST_CASE("the goal below the surface is still seen, fainter than one above it") {
    HiddenWindow window;
    const Frame shown =
        frame(depth_image(64, 48, [](int, int) { return 128.0; }), colour_image(1, 1, [](int, int) {
                  return Rgb{20, 40, 90};
              }));
    SceneContent content = still(shown);
    const Camera camera = straight(64, 48);
    const glm::ivec2 size(640, 480);
    SceneView view;
    const ColourImage without = view.capture(content, camera, size);
    content.markers.visible = true;
    content.markers.proxy = {50.0, 24.0, 128.5};
    const glm::ivec2 ring = pixel_of(camera, {20.0, 24.0, 0.0}, size) + glm::ivec2(6, 0);
    const auto redness = [&](double goal_z) {
        content.markers.goal = {20.0, 24.0, goal_z};
        return pixel(view.capture(content, camera, size), ring)[0];
    };
    const int plain = pixel(without, ring)[0];
    const int above = redness(160.0);
    const int below = redness(100.0);
    CHECK(below > plain + 20);
    CHECK(above > below + 20);
}

TEST_CASE("an image of 33 million pixels is drawn, thinned out") {
    HiddenWindow window;
    const Frame shown =
        frame(depth_image(7680, 4320, [](int i, int) { return i < 3840 ? 50 : 200; }),
              colour_image(2, 1, [](int i, int) {
                  return Rgb{i * 200, 100, 0};
              }));
    SceneContent content = still(shown);
    const Camera camera = straight(7680, 4320);
    const glm::ivec2 size(192, 108);
    SceneView view;
    const ColourImage picture = view.capture(content, camera, size);
    CHECK(difference(pixel(picture, {20, 54}), {0, 100, 0}) <= 2);
    CHECK(difference(pixel(picture, {170, 54}), {200, 100, 0}) <= 2);
    CHECK(window.errors().empty());
}

TEST_CASE("drawing leaves the framebuffer to others: no depth test, blending or scissors") {
    HiddenWindow window;
    const Frame shown = frame(depth_image(8, 8, [](int, int) { return 9.0; }));
    SceneContent content = still(shown);
    content.markers.visible = true;
    content.markers.contact = true;
    content.markers.goal = {4.0, 4.0, -20.0};
    SceneView view;
    glViewport(1, 2, 30, 20);
    const ColourImage picture = view.capture(content, straight(8, 8), {50, 40});
    CHECK(picture.columns == 50);
    CHECK(picture.rows == 40);
    GLint viewport[4] = {};
    GLint framebuffer = -1;
    glGetIntegerv(GL_VIEWPORT, viewport);
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &framebuffer);
    CHECK(viewport[2] == 30);
    CHECK(framebuffer == 0);
    for (const GLenum state :
         std::initializer_list<GLenum>{GL_DEPTH_TEST, GL_BLEND, GL_SCISSOR_TEST, GL_CULL_FACE}) {
        CHECK(glIsEnabled(state) == GL_FALSE);
    }
    view.draw(content, straight(8, 8), {0, 0});  // a minimised window
    CHECK(window.errors().empty());
}

TEST_CASE("a screenshot's first row is the upper one") {
    HiddenWindow window;
    const Offscreen offscreen({5, 4}, 0);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 3, 5, 1);
    glClearColor(1.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    const ColourImage picture = read_framebuffer({5, 4});
    for (int x = 0; x < 5; ++x) {
        CHECK(pixel(picture, {x, 0}) == Rgb{255, 0, 0});
        CHECK(pixel(picture, {x, 1}) == Rgb{0, 0, 0});
        CHECK(pixel(picture, {x, 3}) == Rgb{0, 0, 0});
    }
}

}  // namespace
}  // namespace dibhr
