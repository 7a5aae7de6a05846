// The surface: elevations, triangulation, bump map, frame.
#include "core/haptics/surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <set>
#include <string>

#include "core/haptics/neighbours.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

TEST_CASE("an elevation is relief times level over the highest level, exactly", "[surface]") {
    const double level = GENERATE(0.0, 1.0, 77.0, 254.0, 255.0);
    const double relief = GENERATE(255.0, 100.0, 33.3);
    const DepthImage image = test::flat(3, 2, level);
    const DepthSurface surface(image, image, 0.0, {relief, 0.0});
    CHECK(surface.elevation(2, 1) == relief * level / 255.0);
}

TEST_CASE("the blend moves every vertex linearly from one depth image to the other", "[surface]") {
    const DepthImage from = test::flat(4, 4, 10.0);
    const DepthImage to = test::flat(4, 4, 30.0);
    const double blend = GENERATE(0.0, 0.25, 0.5, 1.0);
    const DepthSurface surface(from, to, blend, {255.0, 0.0});
    CHECK_THAT(surface.elevation(1, 2), WithinAbs(10.0 + 20.0 * blend, 1e-12));
}

TEST_CASE("a blend outside 0 to 1 is held at the nearer image", "[surface]") {
    const DepthImage from = test::flat(2, 2, 10.0);
    const DepthImage to = test::flat(2, 2, 30.0);
    CHECK_THAT(DepthSurface(from, to, -1.0, {255.0, 0.0}).elevation(0, 0), WithinAbs(10.0, 1e-12));
    CHECK_THAT(DepthSurface(from, to, 7.0, {255.0, 0.0}).elevation(0, 0), WithinAbs(30.0, 1e-12));
}

TEST_CASE("the diagonal of a cell joins its right and its lower corner", "[surface]") {
    DepthImage image = test::flat(2, 2, 0.0);
    image.at(1, 0) = 100.0F;
    image.at(0, 1) = 100.0F;
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    CHECK_THAT(surface.elevation_at(0.5, 0.5), WithinAbs(100.0, 1e-12));
    CHECK_THAT(surface.elevation_at(0.25, 0.25), WithinAbs(50.0, 1e-12));
    CHECK_THAT(surface.elevation_at(0.75, 0.75), WithinAbs(50.0, 1e-12));
}

TEST_CASE("the surface between the vertices is continuous and between its corners", "[surface]") {
    const auto surfaces = test::hostile_surfaces(12, 9);
    test::Dice dice(3);
    for (const auto& [name, image] : surfaces) {
        CAPTURE(name);
        const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
        for (int k = 0; k < 500; ++k) {
            const double x = dice.uniform(0.0, 11.0);
            const double y = dice.uniform(0.0, 8.0);
            const double z = surface.elevation_at(x, y);
            const double near = surface.elevation_at(x + 1e-7, y - 1e-7);
            REQUIRE_THAT(near, WithinAbs(z, 1e-7 * 2.0 * 512.0));
            REQUIRE(z >= 0.0);
            REQUIRE(z <= surface.ceiling());
        }
    }
}

TEST_CASE("a bump map as large as the image adds roughness times its height at each vertex",
          "[surface]") {
    const DepthImage image = test::flat(3, 3, 50.0);
    BumpMap bump{3, 3, {0.0F, 0.5F, 1.0F, 0.25F, 0.0F, 0.75F, 1.0F, 0.0F, 0.5F}};
    const DepthSurface surface(image, image, 0.0, {255.0, 4.0}, &bump);
    CHECK_THAT(surface.elevation(2, 0), WithinAbs(54.0, 1e-12));
    CHECK_THAT(surface.elevation(0, 1), WithinAbs(51.0, 1e-12));
    CHECK(surface.ceiling() >= 259.0);
}

TEST_CASE("a bump map stretched beforehand gives the same bits, over other images as well",
          "[surface]") {
    for (const auto& [columns, rows] : {std::pair{37, 23}, {16, 9}, {5, 41}, {1, 1}}) {
        BumpMap bump{columns, rows, {}};
        for (int k = 0; k < columns * rows; ++k) {
            bump.heights.push_back(static_cast<float>(k * 7919 % 256) / 255.0F);
        }
        BumpMap stretched = bump;
        stretch(stretched, 23, 19);
        REQUIRE(is_stretched(stretched, 23, 19));
        for (const auto& [image_columns, image_rows] : {std::pair{23, 19}, {19, 23}, {46, 38}}) {
            const DepthImage image = test::flat(image_columns, image_rows, 50.0);
            const DepthSurface one_by_one(image, image, 0.0, {255.0, 4.0}, &bump);
            const DepthSurface beforehand(image, image, 0.0, {255.0, 4.0}, &stretched);
            for (int j = 0; j < image_rows; ++j) {
                for (int i = 0; i < image_columns; ++i) {
                    REQUIRE(beforehand.elevation(i, j) == one_by_one.elevation(i, j));
                }
            }
        }
    }
}

TEST_CASE("a bump map with a size of its own repeats, in its own proportions", "[surface]") {
    // Waves of 16 columns and 8 rows a copy; a copy is 24 px wide, and so 12 px high.
    BumpMap bump{16, 8, {}};
    const auto wave = [](double turns) {
        return 0.5 + 0.5 * std::sin(2.0 * std::numbers::pi * turns);
    };
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 16; ++column)
            bump.heights.push_back(static_cast<float>(0.5 * wave((column + 0.5) / 16.0) +
                                                      0.5 * wave((row + 0.5) / 8.0)));
    const DepthImage image = test::flat(100, 60, 50.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 10.0, 24.0}, &bump);
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 100; ++i) {
            const double waves = 5.0 * wave((i + 0.5) / 24.0) + 5.0 * wave((j + 0.5) / 12.0);
            REQUIRE_THAT(surface.elevation(i, j), WithinAbs(50.0 + waves, 0.5));  // of 8 samples
            if (i >= 24)
                REQUIRE_THAT(surface.elevation(i - 24, j),
                             WithinAbs(surface.elevation(i, j), 1e-6));
            if (j >= 12)
                REQUIRE_THAT(surface.elevation(i, j - 12),
                             WithinAbs(surface.elevation(i, j), 1e-6));
        }
    }
}

TEST_CASE("a repeated bump map stretched beforehand gives the same bits, at any size of a copy",
          "[surface]") {
    const DepthImage image = test::flat(23, 19, 50.0);
    for (const double size_px : {1e-300, 0.3, 1.0, 7.7, 22.0, 23.0, 4096.0}) {
        BumpMap bump{5, 3, {}};
        for (int k = 0; k < 15; ++k)
            bump.heights.push_back(static_cast<float>(k * 7919 % 256) / 255.0F);
        const SurfaceShape shape{255.0, 4.0, size_px};
        auto stretched = std::make_shared<const BumpMap>(bump);
        stretch(stretched, 23, 19, size_px);
        REQUIRE(is_stretched(*stretched, 23, 19, size_px));
        CHECK_FALSE(is_stretched(*stretched, 23, 19));
        const DepthSurface one_by_one(image, image, 0.0, shape, &bump);
        const DepthSurface beforehand(image, image, 0.0, shape, stretched.get());
        for (int j = 0; j < 19; ++j) {
            for (int i = 0; i < 23; ++i) {
                REQUIRE(beforehand.elevation(i, j) == one_by_one.elevation(i, j));
                REQUIRE(beforehand.elevation(i, j) >= 50.0);
                REQUIRE(beforehand.elevation(i, j) <= 54.0);
            }
        }
    }
}

TEST_CASE("a stretched bump map's heights are not worked out again", "[surface]") {
    const DepthImage image = test::flat(23, 19, 50.0);
    const DepthImage turned = test::flat(19, 23, 50.0);
    BumpMap bump{3, 2, {0.0F, 1.0F, 0.5F, 0.25F, 0.75F, 0.1F}};
    stretch(bump, 23, 19);
    const double before = DepthSurface(image, image, 0.0, {255.0, 4.0}, &bump).elevation(4, 5);
    const double over_turned =
        DepthSurface(turned, turned, 0.0, {255.0, 4.0}, &bump).elevation(4, 5);
    for (double& height : bump.at_vertices.heights) height += 1.0;
    CHECK_THAT(DepthSurface(image, image, 0.0, {255.0, 4.0}, &bump).elevation(4, 5),
               WithinAbs(before + 4.0, 1e-12));
    CHECK(DepthSurface(turned, turned, 0.0, {255.0, 4.0}, &bump).elevation(4, 5) == over_turned);
}

TEST_CASE("without roughness a bump map is not felt", "[surface]") {
    const DepthImage image = test::flat(3, 3, 50.0);
    const BumpMap bump{1, 1, {1.0F}};
    CHECK(DepthSurface(image, image, 0.0, {255.0, 0.0}, &bump).elevation(1, 1) == 50.0);
}

TEST_CASE("a point outside the image rectangle is moved onto its border", "[surface]") {
    const DepthImage image = test::flat(5, 4, 0.0);
    const DepthSurface surface(image, image, 0.0, {});
    CHECK(surface.clamped_to_frame({-3.0, 9.0, 7.0}) == Vec3(0.0, 3.0, 7.0));
    CHECK(surface.clamped_to_frame({4.5, 1.5, -1.0}) == Vec3(4.0, 1.5, -1.0));
}

TEST_CASE("every kind of primitive has a name of its own, up to the last", "[primitives]") {
    std::set<std::string> names;
    constexpr auto kLast = static_cast<std::size_t>(kLastPrimitiveKind);
    for (std::size_t k = 0; k <= kLast; ++k) names.insert(name_of(static_cast<PrimitiveKind>(k)));
    CHECK(names.size() == kLast + 1);
    CHECK(std::string(name_of(static_cast<PrimitiveKind>(kLast + 1))) == "none");
}

TEST_CASE("an edge's triangles have that edge, and an inner edge has two", "[primitives]") {
    const DepthImage image = test::flat(4, 4, 0.0);
    const DepthSurface surface(image, image, 0.0, {});
    for (const auto direction :
         {EdgeDirection::along_row, EdgeDirection::along_column, EdgeDirection::diagonal}) {
        const Primitive inner = edge(direction, 1, 1);
        const TrianglePair pair = triangles_of(surface, inner);
        REQUIRE(pair.first);
        REQUIRE(pair.second);
        CHECK(edge_of(*pair.first, direction) == inner);
        CHECK(edge_of(*pair.second, direction) == inner);
    }
    CHECK_FALSE(triangles_of(surface, edge(EdgeDirection::along_row, 0, 0)).second);
    CHECK_FALSE(triangles_of(surface, edge(EdgeDirection::along_row, 0, 3)).first);
    CHECK_FALSE(triangles_of(surface, edge(EdgeDirection::along_column, 0, 0)).second);
    CHECK_FALSE(triangles_of(surface, edge(EdgeDirection::along_column, 3, 0)).first);
}

TEST_CASE("the triangle towards a point is the one on its side of the edge, or the only one",
          "[primitives]") {
    const DepthImage image = test::flat(4, 4, 0.0);
    const DepthSurface surface(image, image, 0.0, {});
    for (const auto direction :
         {EdgeDirection::along_row, EdgeDirection::along_column, EdgeDirection::diagonal}) {
        const int last_i = direction == EdgeDirection::along_column ? 3 : 2;
        const int last_j = direction == EdgeDirection::along_row ? 3 : 2;
        for (int n = 0; n < (last_i + 1) * (last_j + 1); ++n) {
            const Primitive between = edge(direction, n % (last_i + 1), n / (last_i + 1));
            const TrianglePair pair = triangles_of(surface, between);
            for (const auto& [x, y] : {std::pair{0.0, 0.0}, {3.0, 3.0}, {1.0, 2.0}, {2.0, 0.5}}) {
                const bool first = is_towards_first(between, x, y) ? pair.first.has_value()
                                                                   : !pair.second.has_value();
                CHECK(triangle_towards(surface, between, x, y) ==
                      (first ? *pair.first : *pair.second));
            }
        }
    }
}

TEST_CASE("a vertex's six edges all end in it", "[primitives]") {
    const Primitive centre = vertex(2, 2);
    for (std::size_t k = 0; k < kSpokes.size(); ++k) {
        const EdgeEnds ends = ends_of(edge_at(centre, k));
        const bool begins = ends.begin_i == 2 && ends.begin_j == 2;
        const bool finishes = ends.end_i == 2 && ends.end_j == 2;
        CHECK(begins != finishes);
        CHECK((begins ? ends.end_i : ends.begin_i) == 2 + kSpokes[k].i);
        CHECK((begins ? ends.end_j : ends.begin_j) == 2 + kSpokes[k].j);
    }
}
