// A surface's files, read back by OpenCV or byte by byte.
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/surface_files/surface_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kPitch_mm = 0.5;

/// Uneven, and different in every corner.
DepthImage uneven(int columns, int rows, double highest_level = 65535.0) {
    return image_of(columns, rows, highest_level, [=](int i, int j) {
        const double wave = 0.5 + 0.2 * std::sin(0.9 * i) + 0.2 * std::cos(0.7 * j + 0.1 * i);
        return std::floor(wave * highest_level);
    });
}

DepthSurface surface_of(const DepthImage& image, double relief_px = 100.0,
                        const BumpMap* bump = nullptr, double roughness_px = 0.0) {
    return {image, image, 0.0, {relief_px, roughness_px}, bump};
}

std::filesystem::path written(const TemporaryFolder& folder, const ExportedSurface& exported,
                              const std::string& name) {
    OutputFile file(folder / name);
    write_surface(exported, *surface_format_of(name), file);
    file.commit();
    return folder / name;
}

template <typename Number>
Number number_at(const std::string& bytes, std::size_t at) {
    REQUIRE(at + sizeof(Number) <= bytes.size());
    Number number;
    std::memcpy(&number, bytes.data() + at, sizeof(Number));
    return number;
}

glm::vec3 place_at(const std::string& bytes, std::size_t at) {
    return {number_at<float>(bytes, at), number_at<float>(bytes, at + 4),
            number_at<float>(bytes, at + 8)};
}

struct Triangle {
    glm::vec3 normal;
    std::array<glm::vec3, 3> corners;
};

std::vector<Triangle> stl_triangles(const std::string& bytes) {
    const auto count = number_at<std::uint32_t>(bytes, 80);
    REQUIRE(bytes.size() == 84 + std::size_t{50} * count);
    std::vector<Triangle> triangles;
    for (std::size_t at = 84; at < bytes.size(); at += 50) {
        triangles.push_back(
            {place_at(bytes, at),
             {place_at(bytes, at + 12), place_at(bytes, at + 24), place_at(bytes, at + 36)}});
    }
    return triangles;
}

using Bits = std::array<std::uint32_t, 3>;

Bits bits_of(glm::vec3 p) {
    return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
            std::bit_cast<std::uint32_t>(p.z)};
}

double volume_of(const std::vector<Triangle>& triangles) {
    double volume = 0.0;
    for (const Triangle& t : triangles) {
        const glm::dvec3 a = t.corners[0];
        const glm::dvec3 b = t.corners[1];
        const glm::dvec3 c = t.corners[2];
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return volume;
}

/// Whether each edge is there exactly once in each direction.
void check_closed(const std::vector<Triangle>& triangles) {
    std::map<std::pair<Bits, Bits>, int> edges;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[{bits_of(t.corners[k]), bits_of(t.corners[(k + 1) % 3])}];
        }
    }
    int open = 0;
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        if (count != 1 || back == edges.end()) ++open;
    }
    CHECK(open == 0);
}

struct Ply {
    std::string header;
    std::string body;
    std::size_t vertices{0};
    std::size_t faces{0};
};

Ply read_ply(const std::filesystem::path& file) {
    const std::string bytes = read_text(file);
    const std::string last = "end_header\n";
    const std::size_t end = bytes.find(last) + last.size();
    Ply ply{bytes.substr(0, end), bytes.substr(end)};
    const auto count_of = [&ply](const std::string& element) {
        return std::stoul(ply.header.substr(ply.header.find(element) + element.size()));
    };
    ply.vertices = count_of("element vertex ");
    ply.faces = count_of("element face ");
    return ply;
}

}  // namespace

TEST_CASE("the ending of a name says how a surface is written", "[surface]") {
    CHECK(surface_format_of("a.pfm") == SurfaceFormat::pfm);
    CHECK(surface_format_of("a.b.PNG") == SurfaceFormat::png);
    CHECK(surface_format_of("folder.stl/a.ply") == SurfaceFormat::ply);
    CHECK(surface_format_of("a.Stl") == SurfaceFormat::stl);
    for (const char* name : {"a", "-", "stl", ".stl", "a.obj", "a.png ", "a.stl/"}) {
        CAPTURE(name);
        CHECK_FALSE(surface_format_of(name));
    }
}

TEST_CASE("a PFM file holds the elevations in pixels, the upper row first for who reads it",
          "[surface]") {
    const TemporaryFolder folder;
    const DepthImage from = uneven(23, 17);
    const DepthImage to =
        image_of(23, 17, 65535.0, [](int i, int j) { return 1000 * i + 100 * j; });
    const BumpMap bump{2, 2, {0.0F, 0.25F, 0.5F, 1.0F}};
    const DepthSurface surface(from, to, 0.3, {180.0, 7.0}, &bump);
    const cv::Mat read =
        cv::imread(written(folder, {surface, kPitch_mm}, "a.pfm").string(), cv::IMREAD_UNCHANGED);
    REQUIRE(read.type() == CV_32FC1);
    REQUIRE(read.size() == cv::Size(23, 17));
    for (int j = 0; j < 17; ++j) {
        for (int i = 0; i < 23; ++i) {
            REQUIRE(read.at<float>(j, i) == static_cast<float>(surface.elevation(i, j)));
        }
    }
}

TEST_CASE("a PNG relief goes from black on the ground to white at the ceiling and tells its scale",
          "[surface]") {
    const TemporaryFolder folder;
    const DepthImage image = uneven(31, 12);
    const DepthSurface surface = surface_of(image, 50.0);
    const auto file = written(folder, {surface, kPitch_mm}, "a.png");
    const cv::Mat read = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    REQUIRE(read.type() == CV_16UC1);
    REQUIRE(read.size() == cv::Size(31, 12));
    for (int j = 0; j < 12; ++j) {
        for (int i = 0; i < 31; ++i) {
            REQUIRE(static_cast<float>(read.at<std::uint16_t>(j, i)) == image.at(i, j));
        }
    }
    const std::string bytes = read_text(file);
    CHECK(contains(bytes, "0: 0 px; 65535: 50 px, 25 mm; a pixel: 0.5 mm"));
    const std::size_t pitch = bytes.find("pHYs");
    REQUIRE(pitch != std::string::npos);
    CHECK(bytes.substr(pitch + 4, 9) == std::string("\0\0\x07\xD0\0\0\x07\xD0\x01", 9));
}

TEST_CASE("white is the highest that relief and roughness can make together", "[surface]") {
    const TemporaryFolder folder;
    const DepthImage image = image_of(4, 4, 255.0, [](int, int) { return 255; });
    const BumpMap bump{2, 2, {1.0F, 1.0F, 1.0F, 1.0F}};
    const auto file = written(folder, {surface_of(image, 30.0, &bump, 10.0), 1.0}, "a.png");
    const cv::Mat read = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    CHECK(cv::countNonZero(read != 65535) == 0);
    const auto smooth = written(folder, {surface_of(image, 0.0), 1.0}, "flat.png");
    CHECK(cv::countNonZero(cv::imread(smooth.string(), cv::IMREAD_UNCHANGED)) == 0);
}

TEST_CASE("a PLY mesh is the surface in millimetres with y up, split as it is for touch",
          "[surface]") {
    const TemporaryFolder folder;
    const DepthImage image = uneven(9, 7);
    const DepthSurface surface = surface_of(image);
    const Ply ply = read_ply(written(folder, {surface, kPitch_mm}, "a.ply"));
    REQUIRE(ply.vertices == 63);
    REQUIRE(ply.faces == 96);
    REQUIRE(ply.body.size() == ply.vertices * 12 + ply.faces * 13);
    for (int j = 0; j < 7; ++j) {
        for (int i = 0; i < 9; ++i) {
            const glm::vec3 place = place_at(
                ply.body, 12 * (static_cast<std::size_t>(j) * 9 + static_cast<std::size_t>(i)));
            CHECK_THAT(place.x, WithinAbs(kPitch_mm * i, 1e-5));
            CHECK_THAT(place.y, WithinAbs(kPitch_mm * (6 - j), 1e-5));
            CHECK_THAT(place.z, WithinAbs(kPitch_mm * surface.elevation(i, j), 1e-4));
        }
    }
    for (std::size_t face = 0; face < ply.faces; ++face) {
        const std::size_t at = ply.vertices * 12 + face * 13;
        REQUIRE(ply.body[at] == 3);
        std::array<glm::vec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto number = number_at<std::int32_t>(ply.body, at + 1 + 4 * k);
            REQUIRE(number >= 0);
            REQUIRE(static_cast<std::size_t>(number) < ply.vertices);
            corners[k] = place_at(ply.body, 12 * static_cast<std::size_t>(number));
        }
        const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        REQUIRE(normal.z > 0.0F);
        const glm::vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0F;
        const double touched =
            surface.elevation_at(middle.x / kPitch_mm, 6.0 - middle.y / kPitch_mm);
        REQUIRE_THAT(middle.z, WithinAbs(kPitch_mm * touched, 1e-4));
    }
}

TEST_CASE("the mesh has the colours of a picture of any size", "[surface]") {
    const TemporaryFolder folder;
    const DepthImage image = uneven(4, 2);
    // One pixel for two columns and rows, and two for one.
    const ColourImage small{2, 1, {10, 20, 30, 40, 50, 60}};
    ColourImage large{8, 4, {}};
    for (int pixel = 0; pixel < 32; ++pixel) {
        for (int c = 0; c < 3; ++c) large.rgb.push_back(static_cast<std::uint8_t>(pixel));
    }
    const auto colour_of = [](const Ply& ply, int i, int j) {
        return static_cast<int>(
            ply.body[15 * (static_cast<std::size_t>(j) * 4 + static_cast<std::size_t>(i)) + 12]);
    };
    const Ply coarse = read_ply(written(folder, {surface_of(image), 1.0, &small}, "small.ply"));
    CHECK(contains(coarse.header, "property uchar red"));
    CHECK(colour_of(coarse, 1, 0) == 10);
    CHECK(colour_of(coarse, 2, 1) == 40);
    const Ply fine = read_ply(written(folder, {surface_of(image), 1.0, &large}, "large.ply"));
    CHECK(colour_of(fine, 0, 0) == 9);
    CHECK(colour_of(fine, 3, 1) == 31);
    const ColourImage none{};
    CHECK_FALSE(contains(read_ply(written(folder, {surface_of(image), 1.0, &none}, "n.ply")).header,
                         "red"));
}

TEST_CASE("an STL plate is closed, and all its normals point outwards", "[surface]") {
    const int columns = GENERATE(2, 3, 24);
    const int rows = GENERATE(2, 19);
    CAPTURE(columns, rows);
    const TemporaryFolder folder;
    const DepthImage image = uneven(columns, rows);
    const DepthSurface surface = surface_of(image);
    const auto triangles = stl_triangles(read_text(written(folder, {surface, kPitch_mm}, "a.stl")));
    check_closed(triangles);
    for (const Triangle& t : triangles) {
        const glm::vec3 cross =
            glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
        REQUIRE(glm::length(cross) > 0.0F);
        REQUIRE(glm::dot(glm::normalize(cross), t.normal) > 0.9999F);
    }
    CHECK(volume_of(triangles) > 0.0);
}

TEST_CASE("an STL plate is 2 mm thick at its lowest place and stands on z = 0", "[surface]") {
    const TemporaryFolder folder;
    const DepthImage image = image_of(5, 4, 255.0, [](int i, int) { return 100 + 10 * i; });
    const auto triangles =
        stl_triangles(read_text(written(folder, {surface_of(image, 255.0), kPitch_mm}, "a.stl")));
    std::set<float> heights;
    for (const Triangle& t : triangles) {
        for (const glm::vec3& corner : t.corners) heights.insert(corner.z);
    }
    CHECK(heights == std::set<float>{0.0F, 2.0F, 7.0F, 12.0F, 17.0F, 22.0F});
    // 2 mm x 1.5 mm wide, 12 mm high on average.
    CHECK_THAT(volume_of(triangles), WithinAbs(2.0 * 1.5 * 12.0, 1e-3));
}

TEST_CASE("what has no elevation is written as ground", "[surface]") {
    const TemporaryFolder folder;
    DepthImage image = image_of(3, 3, 255.0, [](int, int) { return 51; });
    image.at(1, 1) = std::numeric_limits<float>::quiet_NaN();
    image.at(2, 2) = std::numeric_limits<float>::infinity();
    const DepthSurface surface = surface_of(image, 50.0);
    CHECK(elevation_range(surface).lowest_px == 0.0);
    CHECK(elevation_range(surface).highest_px == 10.0);
    const auto pfm = cv::imread(written(folder, {surface, 1.0}, "a.pfm").string(), -1);
    CHECK(pfm.at<float>(1, 1) == 0.0F);
    CHECK(pfm.at<float>(2, 2) == 0.0F);
    CHECK(pfm.at<float>(0, 0) == 10.0F);
    const auto png = cv::imread(written(folder, {surface, 1.0}, "a.png").string(), -1);
    CHECK(png.at<std::uint16_t>(1, 1) == 0);
    CHECK(png.at<std::uint16_t>(0, 0) == 13107);
    check_closed(stl_triangles(read_text(written(folder, {surface, 1.0}, "a.stl"))));
}

TEST_CASE("a file that cannot be written is refused and leaves nothing", "[surface]") {
    const DepthImage image = uneven(300, 300);
    for (const SurfaceFormat format : kSurfaceFormats) {
        OutputFile full("/dev/full");
        CAPTURE(name_of(format));
        CHECK_THROWS_AS(write_surface({surface_of(image), 1.0}, format, full), InputError);
    }
}
