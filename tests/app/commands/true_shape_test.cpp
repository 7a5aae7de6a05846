// The true shape of what a camera saw, written as a relief and touched by `dibhr touch`.
#include "core/video/depth/true_shape.hpp"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iomanip>
#include <opencv2/core.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/surface_files/surface_file.hpp"
#include "core/video/sources/sidecar.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/seen_shapes.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinRel;

namespace {

constexpr DepthRange kRange_mm{300.0, kWall_mm};

std::string text_of(double number) {
    std::ostringstream text;
    text << std::setprecision(17) << number;
    return text.str();
}

/// What the 640x480 camera saw, in whole millimetres, as a relief that the program reads.
OrthographicGrid write_true_shape(const TemporaryFolder& folder,
                                  const std::vector<float>& distances_mm) {
    const cv::Mat depth_mm = cv::Mat(in_whole_mm(distances_mm), true).reshape(1, kSeenRows);
    const OrthographicGrid grid = orthographic_grid(depth_mm.size(), kCamera, kRange_mm);
    TrueShape shape(depth_mm.size(), kCamera, kRange_mm, grid);
    DepthImage image = shape.orthographic_view(depth_mm, {}).depth;
    for (float& level : image.levels) level = std::isnan(level) ? 0.0F : level;
    const DepthSurface surface(image, image, 0.0, {shape.relief_px(), 0.0});
    OutputFile file(folder / "relief.png");
    write_surface({surface, grid.pitch_mm}, SurfaceFormat::png, file);
    file.commit();
    return grid;
}

/// Where a hand is that comes down on the surface again and again, and 5 mm into it, within
/// `reach_mm` of a place; `distance_mm`: that of the surface beside the place.
template <typename Distance>
std::string goals_around(const OrthographicGrid& grid, glm::dvec2 middle_mm, double reach_mm,
                         Distance&& distance_mm) {
    constexpr int kSteps = 10;
    std::string text = "t,x,y,z\n";
    double t_s = 0.0;
    for (int v = -kSteps; v <= kSteps; ++v) {
        for (int u = -kSteps; u <= kSteps; ++u) {
            const glm::dvec2 off = reach_mm / kSteps * glm::dvec2{u, v};
            if (glm::length(off) > reach_mm) continue;
            const double x = (middle_mm.x + off.x - grid.left_mm) / grid.pitch_mm;
            const double y = (middle_mm.y + off.y - grid.top_mm) / grid.pitch_mm;
            for (const double z_mm : {kRange_mm.near - 50.0, distance_mm(off) + 5.0}) {
                t_s += 0.001;
                text += text_of(t_s) + ',' + text_of(x) + ',' + text_of(y) + ',' +
                        text_of((kRange_mm.far - z_mm) / grid.pitch_mm) + '\n';
            }
        }
    }
    return text;
}

/// The proxies in contact, in millimetres and the camera's axes.
std::vector<glm::dvec3> touched(const TemporaryFolder& folder, const OrthographicGrid& grid) {
    const double relief_px = (kRange_mm.far - kRange_mm.near) / grid.pitch_mm;
    const ProgramResult result = run_dibhr(
        folder, {"touch", "--raw-depth", "--depth", "relief.png", "--goals", "goals.csv",
                 "--relief", text_of(relief_px), "--pixel-pitch", text_of(grid.pitch_mm)});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    std::vector<glm::dvec3> points;
    const std::vector<std::string> lines = split(result.output, '\n');
    for (std::size_t n = 1; n + 1 < lines.size(); ++n) {
        const std::vector<std::string> row = split(lines[n], ',');
        if (row.at(13) == "0") continue;
        points.emplace_back(std::stod(row[4]) * grid.pitch_mm + grid.left_mm,
                            std::stod(row[5]) * grid.pitch_mm + grid.top_mm,
                            kRange_mm.far - std::stod(row[6]) * grid.pitch_mm);
    }
    return points;
}

/// Rows from the lowest to the highest.
void write_pfm(const std::filesystem::path& file, const std::vector<float>& values) {
    std::string bytes =
        "Pf\n" + std::to_string(kSeenColumns) + " " + std::to_string(kSeenRows) + "\n-1\n";
    constexpr std::size_t kRow = kSeenColumns;
    for (auto end = values.size(); end > 0; end -= kRow)
        bytes.append(reinterpret_cast<const char*>(&values[end - kRow]), kRow * sizeof(float));
    write_text(file, bytes);
}

}  // namespace

TEST_CASE("a sphere that a camera saw is touched as a sphere of its radius", "[surface]") {
    const double distance_mm = GENERATE(500.0, 1000.0, 2000.0);
    CAPTURE(distance_mm);
    const TemporaryFolder folder;
    const glm::dvec3 centre{0.1 * distance_mm, 0.05 * distance_mm, distance_mm};
    const OrthographicGrid grid = write_true_shape(folder, seen_sphere(centre));
    const auto front_mm = [&](glm::dvec2 off) {
        return centre.z - std::sqrt(kSphere_mm * kSphere_mm - glm::dot(off, off));
    };
    write_text(folder / "goals.csv", goals_around(grid, centre, 0.8 * kSphere_mm, front_mm));
    const std::vector<glm::dvec3> points = touched(folder, grid);
    REQUIRE(points.size() > 300);
    CHECK_THAT(fitted_sphere(points).radius, WithinRel(kSphere_mm, 0.01));
}

TEST_CASE("a tilted table that a camera saw is touched as a plane", "[surface]") {
    const TemporaryFolder folder;
    const OrthographicGrid grid = write_true_shape(folder, seen_table(900.0, 0.3, -1.2));
    write_text(folder / "goals.csv", goals_around(grid, {0.0, 0.0}, 100.0, [](glm::dvec2 off) {
                   return 900.0 + 0.3 * off.x - 1.2 * off.y;
               }));
    const std::vector<glm::dvec3> points = touched(folder, grid);
    REQUIRE(points.size() > 300);
    CHECK(rms_off_plane(points) < 0.5);
}

TEST_CASE("a field of view is all that a camera of square pixels needs to be known by",
          "[surface]") {
    const TemporaryFolder folder;
    write_pfm(folder / "ball.pfm", in_whole_mm(seen_sphere({0.0, 0.0, 1000.0})));
    const auto surface = [&](const std::string& intrinsics) {
        const ProgramResult result =
            run_dibhr(folder, {"surface", "ball.pfm", "--depth-unit", "mm", "--geometry", "true",
                               "--intrinsics", intrinsics, "--out", "ball.stl"});
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
        return read_text(folder / "ball.stl");
    };
    const Intrinsics camera = in_pixels({.field_of_view_deg = 60.0}, kSeenColumns, kSeenRows);
    CHECK_THAT(camera.fx, WithinRel(kCamera.fx, 1e-12));
    CHECK(surface("60deg") == surface(text_of(camera)));
}

TEST_CASE("depth alone has no colour, in its true shape either", "[surface]") {
    const TemporaryFolder folder;
    write_pfm(folder / "ball.pfm", in_whole_mm(seen_sphere({0.0, 0.0, 1000.0})));
    const ProgramResult result =
        run_dibhr(folder, {"info", "ball.pfm", "--json", "--depth-unit", "mm", "--geometry", "true",
                           "--intrinsics", "60deg"});
    CHECK(result.exit_code == 0);
    CHECK(contains(result.output, "\"colour_columns\":null"));
    CHECK(contains(result.output, "\"form\":\"image, PFM\""));
}
