// Where the drawn grid is cut at silhouettes, and what is drawn there.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "render/silhouette_cuts.hpp"
#include "render/silhouette_layers.hpp"
#include "tests/render/scenes.hpp"
#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

using Catch::Matchers::WithinAbs;

constexpr double kLimit = 12.0;

struct Cut {
    std::shared_ptr<const DepthImage> image{};
    ReliefGrid grid{};
    std::vector<float> elevations{};
    SilhouetteCuts cuts{};
    SilhouetteLayers layers{};

    Cut(int columns, int rows, int step, const std::function<double(int, int)>& elevation)
        : image(depth_image(columns, rows, elevation)), grid{columns, rows, step} {
        const BlendedDepth depth{*image, *image};
        drawn_elevations(depth, grid, elevations);
        find_cuts(depth, grid, elevations, kLimit, cuts);
        const glm::vec4 eye_at_the_left(-0.5F, 0.0F, 1.0F, 0.0F);
        build_layers({depth, grid, elevations, cuts, nullptr, eye_at_the_left}, layers);
    }
    [[nodiscard]] std::size_t cut_in_row(int j) const {
        const auto columns = static_cast<std::size_t>(grid.columns());
        const auto row = static_cast<std::size_t>(j);
        return static_cast<std::size_t>(
            std::count_if(cuts.cells.begin(), cuts.cells.end(),
                          [=](std::size_t cell) { return cell / columns == row; }));
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

TEST_CASE("a slope without a step behind it is whole, however steep, at any grid step") {
    const int step = GENERATE(1, 2, 3);
    const double slope = GENERATE(5.0, 13.0, 40.0, 150.0);
    const auto ramp = [slope](int i, int) { return slope * std::clamp(i - 12, 0, 8); };
    const auto dome = [slope](int i, int j) {
        const double off = std::hypot(i - 20.0, j - 15.0) / 8.0;
        return 3.0 * slope * std::exp(-off * off);
    };
    for (const std::function<double(int, int)>& shape :
         {std::function<double(int, int)>(ramp), std::function<double(int, int)>(dome)}) {
        const Cut whole(40, 30, step, shape);
        CHECK(whole.cuts.cells.empty());
        CHECK(whole.layers.front.indices.empty());
        CHECK(whole.layers.behind.indices.empty());
        CHECK(whole.layers.under.indices.empty());
    }
}

TEST_CASE("a fold is whole, and a step of more than twice the limit is cut") {
    const double height = GENERATE(6.0, 20.0, 23.0, 26.0, 200.0);
    const bool falls = GENERATE(false, true);
    const Cut cut(40, 30, 3, [=](int i, int) { return (i < 20) == falls ? height : 0.0; });
    CHECK(cut.cuts.cells.empty() == (height < 2.0 * kLimit));
}

TEST_CASE("a step over up to three pixels is cut, a wider one is a slope") {
    const int width = GENERATE(1, 2, 3, 4, 8);
    const Cut cut(40, 30, 1, [=](int i, int) { return 50.0 * std::clamp(i - 20, 0, width); });
    CHECK(cut.cuts.cells.empty() == (width > 3));
}

TEST_CASE("a picture of any size is cut all over or not at all") {
    const int side = GENERATE(64, 512, 2048);
    const int step = side / 32;
    // Boards with a gap of some pixels between them, from the first row to the last one.
    const Cut cut(side, side, step, [=](int i, int) { return i / step % 2 == 0 ? 150.0 : 0.0; });
    const std::size_t in_first = cut.cut_in_row(0);
    CHECK(in_first == static_cast<std::size_t>(cut.grid.columns() - 2));
    for (int j = 1; j + 1 < cut.grid.rows(); ++j) CHECK(cut.cut_in_row(j) == in_first);
}

TEST_CASE("at a step the front is at the near face and what is behind at the far one") {
    const int step = GENERATE(1, 3);
    const int blur = GENERATE(0, 1);  // pixels half way
    const Cut cut(61, 31, step,
                  [=](int i, int) { return i < 20 ? 20.0 : (i < 20 + blur ? 120.0 : 220.0); });
    REQUIRE_FALSE(cut.layers.front.indices.empty());
    for (const LayerVertex& vertex : cut.layers.front.vertices)
        CHECK_THAT(static_cast<double>(vertex.elevation_px), WithinAbs(220.0, 1e-3));
    int farthest = 0;
    for (const LayerVertex& vertex : cut.layers.behind.vertices) {
        CHECK_THAT(static_cast<double>(vertex.elevation_px), WithinAbs(20.0, 1e-3));
    }
    for (const LayerVertex& vertex : cut.layers.under.vertices) {
        if (vertex.elevation_px > 20.5F) continue;  // the end of the fill, at the near face
        CHECK_THAT(static_cast<double>(vertex.elevation_px), WithinAbs(20.0, 1e-3));
        farthest = std::max(farthest, cut.grid.image_i(vertex.corner.i));
    }
    CHECK(farthest >= 20 + blur + 20);  // seen at a slope of a half, 200 px down: all of the rest
}

TEST_CASE("between two images their blend is cut") {
    const int step = GENERATE(1, 5);
    const double blend = GENERATE(0.0, 0.3, 1.0);
    const auto flat = depth_image(33, 33, [](int, int) { return 20.0; });
    const auto stepped = depth_image(33, 33, [](int i, int) { return i < 17 ? 20.0 : 60.0; });
    const ReliefGrid grid{33, 33, step};
    const BlendedDepth depth{*flat, *stepped, blend};
    std::vector<float> elevations;
    SilhouetteCuts cuts;
    drawn_elevations(depth, grid, elevations);
    find_cuts(depth, grid, elevations, kLimit, cuts);
    CHECK(cuts.cells.empty() == (40.0 * blend <= 2.0 * kLimit));
}

}  // namespace
}  // namespace dibhr
