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
        drawn_elevations(*image, *image, 0.0, 1.0, grid, elevations);
        tear_rims(grid, elevations, kLimit, rims);
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
    drawn_elevations(*from, *to, 0.25, 2.0, grid, elevations);
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
    CHECK(std::count(torn.rims.loose.begin(), torn.rims.loose.end(), 0.0F) ==
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
        // Half way is on neither layer.
        CHECK(layers[k].tolerance_px + layers[k + 3].tolerance_px < 200.0F);
        CHECK(layers[k].tolerance_px < 100.0F);
    }
}

TEST_CASE("no layer hangs on a vertex in the blur between two faces") {
    const Torn torn(20, 10, 1, [](int i, int) { return i < 9 ? 20.0 : (i == 9 ? 110.0 : 220.0); });
    REQUIRE_FALSE(torn.rims.layers.empty());
    for (const RimVertex& vertex : torn.rims.layers) {
        const double z = torn.at(vertex.source);
        CHECK_THAT(std::abs(z - 120.0), WithinAbs(100.0, 1e-6));
    }
    for (std::size_t k = 0; k < torn.rims.loose.size(); ++k) {
        CHECK((torn.rims.loose[k] > 0.0F) == (k % 20 == 9));
    }
}

}  // namespace
}  // namespace dibhr
