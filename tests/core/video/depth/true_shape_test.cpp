// Known shapes seen by a pinhole camera, in orthographic view and touched.
#include "core/video/depth/true_shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/haptics/touch.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/seen_shapes.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr DepthRange kRange_mm{300.0, kWall_mm};
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

cv::Mat picture_of(const std::vector<float>& distances_mm) {
    return cv::Mat(distances_mm, true).reshape(1, kSeenRows);
}

TrueShape true_shape() {
    const cv::Size size(kSeenColumns, kSeenRows);
    return {size, kCamera, kRange_mm, orthographic_grid(size, kCamera, kRange_mm)};
}

DepthImage straight(const std::vector<float>& distances_mm) {
    return true_shape().orthographic_view(picture_of(distances_mm), {}).depth;
}

/// As cleaning leaves it: pixels that are not seen are on the ground.
DepthImage touchable(DepthImage image) {
    for (float& level : image.levels) level = std::isnan(level) ? 0.0F : level;
    return image;
}

/// The point of the grid nearest to a place right of and below the camera's axis [mm].
std::size_t index_at(const TrueShape& shape, const DepthImage& image, double x_mm, double y_mm) {
    const OrthographicGrid& grid = shape.grid();
    return image.index(static_cast<int>(std::lround((x_mm - grid.left_mm) / grid.pitch_mm)),
                       static_cast<int>(std::lround((y_mm - grid.top_mm) / grid.pitch_mm)));
}

/// Proxies of a hand that comes down on the surface at many places [mm], in the camera's axes,
/// where x and y are within `reach_mm` of `middle_mm`.
std::vector<glm::dvec3> touched_points(const DepthImage& image, const TrueShape& shape,
                                       glm::dvec3 middle_mm, double reach_mm) {
    const OrthographicGrid& grid = shape.grid();
    TouchParameters parameters;
    parameters.shape.relief_px = shape.relief_px();
    const DepthSurface surface(image, image, 0.0, parameters.shape);
    TouchRenderer renderer;
    std::vector<glm::dvec3> points;
    constexpr int kSteps = 12;
    for (int k = 0; k < (2 * kSteps + 1) * (2 * kSteps + 1); ++k) {
        const glm::dvec2 off =
            reach_mm / kSteps *
            glm::dvec2{k % (2 * kSteps + 1) - kSteps, k / (2 * kSteps + 1) - kSteps};
        if (glm::length(off) > reach_mm) continue;
        const double x = (middle_mm.x + off.x - grid.left_mm) / grid.pitch_mm;
        const double y = (middle_mm.y + off.y - grid.top_mm) / grid.pitch_mm;
        renderer.update(surface, {x, y, surface.ceiling() + 5.0}, parameters, {}, {});
        const Vec3 inside{x, y, surface.elevation_at(x, y) - 4.0};
        const Touch& touch = renderer.update(surface, inside, parameters, {}, {});
        REQUIRE(touch.proxy.contact);
        const Vec3 proxy = touch.proxy.position;
        points.emplace_back(proxy.x * grid.pitch_mm + grid.left_mm,
                            proxy.y * grid.pitch_mm + grid.top_mm,
                            kRange_mm.far - proxy.z * grid.pitch_mm);
    }
    return points;
}

}  // namespace

TEST_CASE("a sphere is felt as a sphere of its own radius at every distance", "[true_shape]") {
    const double distance_mm = GENERATE(500.0, 1000.0, 2000.0);
    const bool whole_mm = GENERATE(false, true);
    CAPTURE(distance_mm, whole_mm);
    // Off the axis the camera sees it from a side, and the picture of it is no circle.
    const glm::dvec3 centre{0.2 * distance_mm, -0.1 * distance_mm, distance_mm};
    const std::vector<float> seen = seen_sphere(centre);
    const TrueShape shape = true_shape();
    const DepthImage image = touchable(straight(whole_mm ? in_whole_mm(seen) : seen));
    const std::vector<glm::dvec3> points = touched_points(image, shape, centre, 0.8 * kSphere_mm);
    REQUIRE(points.size() > 400);
    const Sphere fitted = fitted_sphere(points);
    CHECK_THAT(fitted.radius, WithinRel(kSphere_mm, 0.01));
    CHECK_THAT(glm::distance(fitted.centre, centre), WithinAbs(0.0, 1.0));
    double most_off_mm = 0.0;
    for (const glm::dvec3 p : points)
        most_off_mm = std::fmax(most_off_mm, std::fabs(glm::distance(p, centre) - kSphere_mm));
    CHECK(most_off_mm < 1.5);
}

TEST_CASE("a tilted table is felt as a plane", "[true_shape]") {
    const double slope_x = GENERATE(0.0, 0.4);
    const double slope_y = GENERATE(-1.5, 0.7);
    const bool whole_mm = GENERATE(false, true);
    CAPTURE(slope_x, slope_y, whole_mm);
    const std::vector<float> seen = seen_table(900.0, slope_x, slope_y);
    const TrueShape shape = true_shape();
    const DepthImage image = touchable(straight(whole_mm ? in_whole_mm(seen) : seen));
    const std::vector<glm::dvec3> points = touched_points(image, shape, {0.0, 0.0, 900.0}, 150.0);
    CHECK(rms_off_plane(points) < (whole_mm ? 0.5 : 0.01));
    for (const glm::dvec3 p : points)
        REQUIRE_THAT(p.z, WithinAbs(900.0 + slope_x * p.x + slope_y * p.y, whole_mm ? 2.0 : 0.05));
}

TEST_CASE("a wall across the axis is flat to the last bit, wherever it is", "[true_shape]") {
    const float distance_mm = GENERATE(300.0F, 777.0F, 2500.0F);
    const TrueShape shape = true_shape();
    const DepthImage image = straight(seen([&](glm::dvec3) { return distance_mm; }));
    const double half_mm = distance_mm * 319.0 / kCamera.fx;
    const auto seen_points = std::count_if(image.levels.begin(), image.levels.end(),
                                           [](float level) { return !std::isnan(level); });
    CHECK(std::count(image.levels.begin(), image.levels.end(),
                     static_cast<float>(kRange_mm.far) - distance_mm) == seen_points);
    const double expected = 2.0 * half_mm * (2.0 * distance_mm * 239.0 / kCamera.fy) /
                            (shape.grid().pitch_mm * shape.grid().pitch_mm);
    CHECK_THAT(static_cast<double>(seen_points), WithinRel(expected, 0.02));
    if (distance_mm == 2500.0F) CHECK(seen_points == image.columns * image.rows);
}

TEST_CASE("what is hidden behind an edge is no surface, and nothing leads there", "[true_shape]") {
    // A board from the axis to the right, 500 mm away, before a wall 2000 mm away.
    const TrueShape shape = true_shape();
    const DepthImage image =
        straight(seen([](glm::dvec3 ray) { return ray.x > 0.0 && ray.x < 0.2 ? 500.0 : 2000.0; }));
    const auto level_at = [&](double x_mm) {
        return image.levels[index_at(shape, image, x_mm, 0.0)];
    };
    CHECK(level_at(-200.0) == 500.0F);
    CHECK(level_at(50.0) == 2000.0F);
    CHECK(level_at(95.0) == 2000.0F);
    for (double x_mm = 110.0; x_mm < 390.0; x_mm += 10.0) {
        CAPTURE(x_mm);
        CHECK(std::isnan(level_at(x_mm)));
    }
    CHECK(level_at(420.0) == 500.0F);
    CHECK(std::all_of(image.levels.begin(), image.levels.end(), [](float level) {
        return std::isnan(level) || level == 500.0F || level == 2000.0F;
    }));
}

TEST_CASE("where the camera looks around something near, the near one is felt", "[true_shape]") {
    // A board right of the view's middle: between it and the axis the camera sees the wall behind
    // it.
    const TrueShape shape = true_shape();
    const DepthImage image =
        straight(seen([](glm::dvec3 ray) { return ray.x > 0.1 ? 500.0 : 2000.0; }));
    const auto level_at = [&](double x_mm) {
        return image.levels[index_at(shape, image, x_mm, 0.0)];
    };
    CHECK(level_at(40.0) == 500.0F);
    CHECK(level_at(60.0) == 2000.0F);
    CHECK(level_at(190.0) == 2000.0F);
}

TEST_CASE("no data is no surface, and what is out of the range is held in it", "[true_shape]") {
    const TrueShape shape = true_shape();
    const float none =
        GENERATE(as<float>{}, kNone, 0.0F, -5.0F, std::numeric_limits<float>::infinity(),
                 -std::numeric_limits<float>::infinity());
    CAPTURE(none);
    const DepthImage image = straight(seen([&](glm::dvec3 ray) {
        if (ray.x < -0.2) return 1e30F;
        if (ray.x > 0.2) return 1e-30F;
        return ray.y < 0.0 ? none : 1000.0F;
    }));
    const auto level_at = [&](double x_mm, double y_mm) {
        return image.levels[index_at(shape, image, x_mm, y_mm)];
    };
    CHECK(std::isnan(level_at(0.0, -100.0)));
    CHECK(level_at(0.0, 100.0) == 1500.0F);
    CHECK(level_at(-600.0, 100.0) == 0.0F);
    CHECK(level_at(100.0, 100.0) == static_cast<float>(image.highest_level));
    const DepthImage nothing = straight(seen([&](glm::dvec3) { return none; }));
    CHECK(std::all_of(nothing.levels.begin(), nothing.levels.end(),
                      [](float level) { return std::isnan(level); }));
}

TEST_CASE("each point has the colour of the pixel in which it was seen", "[true_shape]") {
    const cv::Size size = GENERATE(cv::Size(640, 480), cv::Size(1920, 1440), cv::Size(256, 192));
    CAPTURE(size.width);
    // Blue grows over the width of the picture, red over its height.
    cv::Mat colour(size, CV_8UC3);
    for (int j = 0; j < size.height; ++j) {
        for (int i = 0; i < size.width; ++i)
            colour.at<cv::Vec3b>(j, i) = {static_cast<std::uint8_t>(256 * i / size.width), 0,
                                          static_cast<std::uint8_t>(256 * j / size.height)};
    }
    TrueShape shape = true_shape();
    const OrthographicPicture picture =
        shape.orthographic_view(picture_of(seen_sphere({50.0, 20.0, 700.0})), colour);
    REQUIRE(picture.colour.columns == picture.depth.columns);
    REQUIRE(picture.colour.rows == picture.depth.rows);
    const OrthographicGrid& grid = shape.grid();
    int coloured_without_point = 0;
    double most_off = 0.0;
    for (int j = 0; j < picture.depth.rows; ++j) {
        for (int i = 0; i < picture.depth.columns; ++i) {
            const std::size_t k = picture.depth.index(i, j);
            const std::uint8_t* const rgb = &picture.colour.rgb[3 * k];
            const float level = picture.depth.levels[k];
            if (std::isnan(level)) {
                if (rgb[0] != 0 || rgb[1] != 0 || rgb[2] != 0) ++coloured_without_point;
                continue;
            }
            const double distance_mm = kRange_mm.far - level;
            const double u =
                kCamera.cx + kCamera.fx * (grid.left_mm + i * grid.pitch_mm) / distance_mm;
            const double v =
                kCamera.cy + kCamera.fy * (grid.top_mm + j * grid.pitch_mm) / distance_mm;
            most_off = std::fmax(most_off, std::fabs(rgb[2] - 256.0 * (u + 0.5) / 640.0));
            most_off = std::fmax(most_off, std::fabs(rgb[0] - 256.0 * (v + 0.5) / 480.0));
        }
    }
    CHECK(coloured_without_point == 0);
    CHECK(most_off <= 2.0);
}

TEST_CASE("the grid is as fine as the nearest pixels, unless it were too large", "[true_shape]") {
    const Intrinsics camera{500.0, 500.0, 319.5, 239.5};
    const cv::Size size(640, 480);
    const OrthographicGrid shallow = orthographic_grid(size, camera, {400.0, 500.0});
    CHECK_THAT(shallow.pitch_mm, WithinAbs(0.8, 1e-12));
    CHECK(shallow.columns == 639 * 5 / 4 + 1);
    const OrthographicGrid deep = orthographic_grid(size, camera, {400.0, 4000.0});
    CHECK_THAT(1.0 * deep.columns * deep.rows, WithinRel(524288.0, 0.005));
    const OrthographicGrid large = orthographic_grid(
        cv::Size(3840, 2160), Intrinsics{3000, 3000, 1919.5, 1079.5}, {400.0, 4000.0});
    CHECK_THAT(1.0 * large.columns * large.rows, WithinRel(3840.0 * 2160.0, 0.005));
    CHECK_THAT(deep.left_mm + deep.pitch_mm * (deep.columns - 1), WithinAbs(-deep.left_mm, 1e-9));
}

TEST_CASE("a camera whose axis is beside the picture is seen straight on, too", "[true_shape]") {
    const cv::Size size(64, 48);
    const Intrinsics camera{60.0, 60.0, -100.0, 24.0};
    const DepthRange range_mm{500.0, 1000.0};
    TrueShape shape(size, camera, range_mm, orthographic_grid(size, camera, range_mm));
    const cv::Mat depth(48, 64, CV_32FC1, cv::Scalar(750.0));
    const DepthImage image = shape.orthographic_view(depth, {}).depth;
    CHECK(shape.grid().left_mm > 800.0);
    CHECK(image.levels[index_at(shape, image, 750.0 * 130.0 / 60.0, 0.0)] == 250.0F);
}

TEST_CASE("the same pictures give the same bits", "[true_shape]") {
    const cv::Mat depth = picture_of(seen_sphere({50.0, 20.0, 700.0}));
    const cv::Mat colour(100, 200, CV_8UC3, cv::Scalar(10, 20, 30));
    TrueShape shape = true_shape();
    const OrthographicPicture first = shape.orthographic_view(depth, colour);
    const OrthographicPicture other =
        shape.orthographic_view(picture_of(seen_table(900.0, 0.0, 1.0)), {});
    CHECK(other.colour.rgb.empty());
    const OrthographicPicture again = shape.orthographic_view(depth, colour);
    CHECK(std::memcmp(first.depth.levels.data(), again.depth.levels.data(),
                      first.depth.levels.size() * sizeof(float)) == 0);
    CHECK(first.colour.rgb == again.colour.rgb);
}

TEST_CASE("intrinsics of no camera and ranges that are none are refused in a plain line",
          "[true_shape]") {
    const auto refused = [](cv::Size size, const Intrinsics& camera, const DepthRange& range_mm) {
        return refusal([&] { (void)orthographic_grid(size, camera, range_mm); });
    };
    const cv::Size size(640, 480);
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Intrinsics& camera :
         {Intrinsics{}, Intrinsics{-500, 500, 319, 239}, Intrinsics{500, nan, 319, 239},
          Intrinsics{500, inf, 319, 239}, Intrinsics{500, 500, nan, 239},
          Intrinsics{500, 500, 319, -inf}, Intrinsics{1e-9, 500, 319, 239},
          Intrinsics{500, 1e12, 319, 239}, Intrinsics{500, 500, 1e300, 239}}) {
        CAPTURE(camera.fx, camera.fy, camera.cx, camera.cy);
        CHECK(contains(refused(size, camera, kRange_mm), "FX,FY,CX,CY"));
    }
    for (const DepthRange& range_mm :
         {DepthRange{}, DepthRange{0.0, 100.0}, DepthRange{-1.0, 100.0}, DepthRange{200.0, 100.0},
          DepthRange{100.0, 100.0}, DepthRange{nan, 100.0}, DepthRange{100.0, nan},
          DepthRange{100.0, inf}}) {
        CAPTURE(range_mm.near, range_mm.far);
        CHECK(contains(refused(size, kCamera, range_mm), "range"));
    }
}

TEST_CASE("a view of one grid pitch still is a surface", "[true_shape]") {
    const cv::Size size(640, 2);
    const Intrinsics camera{50, 190, 319, 0.5};
    const DepthRange range_mm{400, 401};
    const OrthographicGrid grid = orthographic_grid(size, camera, range_mm);
    CHECK(grid.rows == 2);
    TrueShape shape(size, camera, range_mm, grid);
    const cv::Mat depth(size, CV_32FC1, cv::Scalar(400.0));
    CHECK(shape.orthographic_view(depth, {}).depth.rows == 2);
}

TEST_CASE("with samples of the clip the grid spans what they show", "[true_shape]") {
    const cv::Size size(kSeenColumns, kSeenRows);
    const DepthRange range_mm{500.0, kWall_mm};
    const auto sphere_alone = [](glm::dvec3 centre) {
        std::vector<float> distances_mm = seen_sphere(centre);
        for (float& distance : distances_mm) distance = distance < kWall_mm ? distance : kNone;
        distances_mm.front() = 10000.0F;  // out of the range
        return picture_of(distances_mm);
    };
    std::vector<cv::Mat> samples{sphere_alone({-150.0, 0.0, 900.0}),
                                 sphere_alone({250.0, -50.0, 1000.0})};
    samples.front().at<float>(0, 0) = 400.0F;  // a stray pixel
    const OrthographicGrid grid = orthographic_grid(size, kCamera, range_mm, samples);
    const double right_mm = grid.left_mm + (grid.columns - 1) * grid.pitch_mm;
    const double lowest_mm = grid.top_mm + (grid.rows - 1) * grid.pitch_mm;
    // Left to right 600 mm, top to bottom 250 mm, and a tenth more on each side.
    CHECK_THAT(grid.left_mm, WithinAbs(-310.0, 20.0));
    CHECK_THAT(right_mm, WithinAbs(410.0, 20.0));
    CHECK_THAT(grid.top_mm, WithinAbs(-175.0, 15.0));
    CHECK_THAT(lowest_mm, WithinAbs(125.0, 15.0));
    CHECK_THAT(grid.pitch_mm, WithinAbs(500.0 / kCamera.fx, 1e-9));
    // Points beside it are left out, and those in it do not change.
    TrueShape all = true_shape();
    TrueShape shape(size, kCamera, range_mm, grid);
    const cv::Mat depth = picture_of(seen_sphere({250.0, -50.0, 1000.0}));
    const DepthImage image = shape.orthographic_view(depth, {}).depth;
    const DepthImage whole = all.orthographic_view(depth, {}).depth;
    CHECK_THAT(image.levels[index_at(shape, image, 250.0, -50.0)],
               WithinAbs(whole.levels[index_at(all, whole, 250.0, -50.0)], 0.5));
    const std::vector<cv::Mat> empty{cv::Mat(size, CV_32FC1, cv::Scalar(kNone))};
    CHECK(orthographic_grid(size, kCamera, range_mm, empty).columns ==
          orthographic_grid(size, kCamera, range_mm).columns);
}
