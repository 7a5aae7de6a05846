// Where the drawn grid is torn at silhouettes.
#include "render/relief_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "tests/render/scenes.hpp"
#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

using Catch::Matchers::WithinAbs;

constexpr double kLimit = 12.0;

struct Torn {
    ReliefGrid grid{};
    std::vector<float> elevations{};
    Rims rims{};

    Torn(int columns, int rows, int step, const std::function<double(int, int)>& elevation)
        : grid{columns, rows, step} {
        const auto image = depth_image(columns, rows, elevation);
        const BlendedDepth depth{*image, *image};
        drawn_elevations(depth, grid, elevations);
        tear_rims(depth, grid, elevations, kLimit, rims);
    }
    [[nodiscard]] float at(GridVertex v) const {
        return elevations[static_cast<std::size_t>(v.j) * static_cast<std::size_t>(grid.columns()) +
                          v.i];
    }
};

TEST_CASE("the drawn elevation blends both images at every drawn vertex") {
    const auto from = depth_image(8, 5, [](int i, int j) { return 10.0 * i + j; });
    const auto to = depth_image(8, 5, [](int i, int j) { return 100.0 - i * j; });
    const ReliefGrid grid{8, 5, 3};
    std::vector<float> elevations;
    drawn_elevations({*from, *to, 0.25, 2.0}, grid, elevations);
    REQUIRE(elevations.size() == 12);
    for (int j = 0; j < grid.rows(); ++j) {
        for (int i = 0; i < grid.columns(); ++i) {
            const int x = grid.image_i(i);
            const int y = grid.image_j(j);
            const double expected = 2.0 * (0.75 * (10.0 * x + y) + 0.25 * (100.0 - x * y));
            const auto k = static_cast<std::size_t>(j * grid.columns() + i);
            CHECK_THAT(static_cast<double>(elevations[k]), WithinAbs(expected, 1e-3));
        }
    }
}

TEST_CASE("a slope gentler than the limit is not torn, at any grid step") {
    const int step = GENERATE(1, 2, 3);
    const Torn torn(40, 30, step, [](int i, int j) { return 11.0 * i + 3.0 * j; });
    CHECK(torn.rims.layers.empty());
    CHECK(std::count(torn.rims.torn.begin(), torn.rims.torn.end(), 0.0F) ==
          torn.grid.columns() * torn.grid.rows());
}

TEST_CASE("each triangle over a step becomes a layer on the near face and one on the far face") {
    const int step = GENERATE(1, 3);
    const Torn torn(31, 31, step, [](int i, int) { return i < 14 ? 20.0 : 220.0; });
    const auto& layers = torn.rims.layers;
    const int cells = torn.grid.rows() - 1;
    REQUIRE(layers.size() == static_cast<std::size_t>(cells) * 2 * 2 * 3);
    for (std::size_t k = 0; k < layers.size(); k += 6) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            CHECK_THAT(torn.at(layers[k + corner].source), WithinAbs(220.0, 1e-6));
            CHECK_THAT(torn.at(layers[k + 3 + corner].source), WithinAbs(20.0, 1e-6));
        }
        // They meet half way.
        CHECK_THAT(static_cast<double>(layers[k].tolerance_px), WithinAbs(100.0, 1e-3));
        CHECK_THAT(static_cast<double>(layers[k + 3].tolerance_px), WithinAbs(100.0, 1e-3));
    }
}

TEST_CASE("no layer hangs on a vertex in the blur between two faces") {
    const Torn torn(20, 10, 1, [](int i, int) { return i < 9 ? 20.0 : (i == 9 ? 110.0 : 220.0); });
    REQUIRE_FALSE(torn.rims.layers.empty());
    for (const RimVertex& vertex : torn.rims.layers) {
        const double z = torn.at(vertex.source);
        CHECK_THAT(std::abs(z - 120.0), WithinAbs(100.0, 1e-6));
    }
    for (std::size_t k = 0; k < torn.rims.torn.size(); ++k) {  // all cells with that vertex
        const bool beside = k < std::size_t{9 * 20} && (k % 20 == 8 || k % 20 == 9);
        CHECK((torn.rims.torn[k] > 0.0F) == beside);
    }
}

TEST_CASE("between two images their blend is torn") {
    const int step = GENERATE(1, 5);
    const double blend = GENERATE(0.0, 0.3, 1.0);
    const auto flat = depth_image(33, 33, [](int, int) { return 20.0; });
    const auto stepped = depth_image(33, 33, [](int i, int) { return i < 17 ? 20.0 : 40.0; });
    const ReliefGrid grid{33, 33, step};
    const BlendedDepth depth{*flat, *stepped, blend};
    std::vector<float> elevations;
    Rims rims;
    drawn_elevations(depth, grid, elevations);
    tear_rims(depth, grid, elevations, kLimit, rims);
    CHECK(rims.layers.empty() == (20.0 * blend <= kLimit));
}

TEST_CASE("what is torn does not depend on how coarse the drawn grid is") {
    const int step = GENERATE(1, 4, 7);
    SECTION("a step of 20 px from one pixel to the next is, all along") {
        const Torn torn(59, 59, step, [](int i, int j) { return 2 * i + j < 90 ? 20.0 : 40.0; });
        for (int j = 0; j + 1 < torn.grid.rows(); ++j) {
            const int x = (90 - torn.grid.image_j(j)) / 2 - 1;  // before the step, in the first row
            const int cell = std::min(x / step, torn.grid.columns() - 2);
            CHECK(torn.rims.torn[static_cast<std::size_t>(j * torn.grid.columns() + cell)] > 0.0F);
        }
    }
    SECTION("the same 20 px over 5 pixels are not") {
        const Torn torn(59, 59, step,
                        [](int i, int) { return 20.0 + 4.0 * std::clamp(i - 20, 0, 5); });
        CHECK(torn.rims.layers.empty());
    }
}

}  // namespace
}  // namespace dibhr
