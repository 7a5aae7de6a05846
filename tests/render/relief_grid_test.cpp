// The drawn vertices: as many as allowed, always to the border, each triangle once.
#include "render/relief_grid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

using Corner = std::pair<int, int>;
using Triangle = std::array<Corner, 3>;

Triangle triangle(const GridMesh& mesh, std::size_t first_index) {
    Triangle made;
    for (std::size_t k = 0; k < 3; ++k) {
        const GridVertex& v = mesh.vertices.at(mesh.indices.at(first_index + k));
        made[k] = {v.i, v.j};
    }
    return made;
}

TEST_CASE("a grid is as fine as the limit allows and ends at the image's last column and row") {
    const auto [columns, rows] = GENERATE(std::pair{640, 480}, std::pair{7680, 4320},
                                          std::pair{2, 2}, std::pair{101, 7}, std::pair{40000, 3});
    const auto most = GENERATE(std::size_t{50'000}, std::size_t{1'000'000});
    const ReliefGrid grid = plan_grid(columns, rows, most, 16384);
    CAPTURE(columns, rows, most, grid.step);
    const auto count = [](const ReliefGrid& g) {
        return static_cast<std::size_t>(g.columns()) * static_cast<std::size_t>(g.rows());
    };
    CHECK(count(grid) <= most);
    CHECK(std::max(grid.columns(), grid.rows()) <= 16384);
    CHECK(grid.image_i(grid.columns() - 1) == columns - 1);
    CHECK(grid.image_j(grid.rows() - 1) == rows - 1);
    CHECK(grid.image_i(grid.columns() - 2) < columns - 1);
    if (grid.step > 1) {
        const ReliefGrid finer{columns, rows, grid.step - 1};
        CHECK((count(finer) > most || std::max(finer.columns(), finer.rows()) > 16384));
    }
}

TEST_CASE("an image of one column or row has nothing to draw") {
    CHECK_FALSE(plan_grid(1, 480, 50'000, 16384).drawable());
    CHECK(tile_grid(ReliefGrid{1, 480, 1}).indices.empty());
    CHECK(border_strip(ReliefGrid{640, 1, 1}).empty());
}

TEST_CASE("each cell has its two triangles once, split from upper right to lower left") {
    const ReliefGrid grid{40, 23, 1};
    const GridMesh mesh = tile_grid(grid);
    std::set<Triangle> drawn;
    for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
        Triangle corners = triangle(mesh, k);
        std::sort(corners.begin(), corners.end());
        drawn.insert(corners);
    }
    CHECK(drawn.size() == mesh.indices.size() / 3);
    CHECK(drawn.size() == std::size_t{2 * 39 * 22});
    for (const Triangle& t : drawn) {
        const auto [i, j] = *std::min_element(t.begin(), t.end());
        const bool near_origin = t == Triangle{Corner{i, j}, Corner{i, j + 1}, Corner{i + 1, j}};
        const bool far_corner = t == Triangle{Corner{i, j}, Corner{i + 1, j - 1}, Corner{i + 1, j}};
        CHECK((near_origin || far_corner));
    }
}

TEST_CASE("without its cut cells the surface has each other cell's triangles once") {
    const ReliefGrid grid{90, 47, 1};
    const int every = GENERATE(1, 2, 7, 300, 100'000);  // cells from one cut cell to the next
    const GridMesh mesh = tile_grid(grid);
    std::vector<float> cut(std::size_t{90} * 47, 0.0F);
    for (std::size_t k = 0; k < cut.size(); k += static_cast<std::size_t>(every)) cut[k] = 1.0F;
    UncutMesh uncut;
    leave_out(cut, grid, mesh.tiles, uncut);
    std::vector<std::uint32_t> drawn = uncut.rest;
    for (const IndexRun& run : uncut.whole) {
        const auto first = mesh.indices.begin() + run.first;
        drawn.insert(drawn.end(), first, first + run.count);
    }
    std::multiset<Corner> cells;
    for (std::size_t k = 0; k < drawn.size(); k += 3) {
        Corner cell{grid.columns(), grid.rows()};
        for (std::size_t n = k; n < k + 3; ++n) {
            const GridVertex& vertex = mesh.vertices.at(drawn.at(n));
            cell = {std::min(cell.first, int{vertex.i}), std::min(cell.second, int{vertex.j})};
        }
        cells.insert(cell);
    }
    for (int j = 0; j + 1 < grid.rows(); ++j) {
        for (int i = 0; i + 1 < grid.columns(); ++i) {
            const bool is_cut = cut[static_cast<std::size_t>(j * grid.columns() + i)] > 0.0F;
            CHECK(cells.count({i, j}) == (is_cut ? 0U : 2U));
        }
    }
}

TEST_CASE("the border strip goes once around and closes") {
    const ReliefGrid grid{9, 6, 2};
    const std::vector<GridVertex> strip = border_strip(grid);
    REQUIRE(strip.size() == 2U * (2U * (5U + 4U) - 4U + 1U));
    CHECK(strip.front().i == strip.back().i);
    CHECK(strip.front().j == strip.back().j);
    for (const GridVertex& v : strip) {
        CHECK((v.i == 0 || v.i == grid.columns() - 1 || v.j == 0 || v.j == grid.rows() - 1));
    }
}

}  // namespace
}  // namespace dibhr
