// Which vertices of the depth image are drawn, and where the relief is torn.
#include "render/relief_grid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace dibhr {

namespace {

// 10 x 17 cells are 340 triangles on 198 vertices. Mesa's software pipeline shades vertices in runs
// of 1023 indices (341 triangles) with a map of 256 vertices, so a tile fits one run.
constexpr int kTileColumns = 17;
constexpr int kTileRows = 10;

void add_tile(GridMesh& mesh, int left, int top, int right, int bottom) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto width = static_cast<std::uint32_t>(right - left + 1);
    for (int j = top; j <= bottom; ++j) {
        for (int i = left; i <= right; ++i) {
            mesh.vertices.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)});
        }
    }
    // Both triangles of a cell end with its upper right vertex, so the last vertex names the cell.
    for (int j = top; j < bottom; ++j) {
        for (int i = left; i < right; ++i) {
            const auto here = first + static_cast<std::uint32_t>(j - top) * width +
                              static_cast<std::uint32_t>(i - left);
            const auto below = here + width;
            mesh.indices.insert(mesh.indices.end(),
                                {here, below, here + 1, below, below + 1, here + 1});
        }
    }
}

// Shares of the step between two faces. kOnFace: a vertex this near the higher (lower) end is on
// the near (far) face. kLayerTolerance: a fragment this near its layer is drawn; no gap is seen
// straight on.
constexpr float kOnFace = 0.3F;
constexpr float kOnSlope = 0.2F;  // a vertex this near a face's extrapolated slope is on the face
constexpr float kLayerTolerance = 0.5F;
// Bounds the work for a relief that is steep almost everywhere, where outlines mean little.
constexpr std::size_t kMostLayerVertices = 120'000;

/// The elevation of a pixel of the whole image [px].
class PixelElevation {
  public:
    explicit PixelElevation(const BlendedDepth& depth)
        : from_(depth.from.levels.data()),
          to_(depth.to.levels.data()),
          from_part_(static_cast<float>(depth.px_per_level * (1.0 - depth.blend))),
          to_part_(static_cast<float>(depth.px_per_level * depth.blend)) {}

    [[nodiscard]] float operator()(std::size_t pixel) const {
        return from_[pixel] * from_part_ + to_[pixel] * to_part_;
    }

  private:
    const float* from_;
    const float* to_;
    float from_part_, to_part_;  // of a level [px]
};

struct Corner {
    int i{0};
    int j{0};
};

using Triangle = std::array<Corner, 3>;

float distance(float a, float b) {
    return a > b ? a - b : b - a;
}

class Tearing {
  public:
    Tearing(const BlendedDepth& depth, const ReliefGrid& grid, const std::vector<float>& elevations,
            double slope_limit, Rims& rims)
        : image_(depth.from),
          elevation_(depth),
          grid_(grid),
          columns_(grid.columns()),
          rows_(grid.rows()),
          limit_px_(static_cast<float>(slope_limit)),
          elevations_(elevations),
          loose_(elevations.size(), false),
          rims_(rims) {}

    void run() {
        rims_.layers.clear();
        rims_.torn.assign(elevations_.size(), 0.0F);
        each_cell([this](int i, int j) {
            if (is_steep(i, j)) mark_torn_and_loose(i, j);
        });
        each_cell([this](int i, int j) {
            if (is_torn(i, j) || has_loose_corner(i, j)) tear(i, j);
        });
    }

  private:
    /// The vertices of a triangle's cell and one more on each side, and the heights of both faces.
    struct Around {
        Corner first{};
        Corner last{};
        float low{0.0F};
        float high{0.0F};
    };

    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(i);
    }
    [[nodiscard]] float at(int i, int j) const { return elevations_[index(i, j)]; }

    template <class Visit>
    void each_cell(const Visit& visit) const {
        for (int j = 0; j + 1 < rows_; ++j)
            for (int i = 0; i + 1 < columns_; ++i) visit(i, j);
    }

    static std::array<Corner, 4> corners(int i, int j) {
        return {{{i, j}, {i + 1, j}, {i, j + 1}, {i + 1, j + 1}}};
    }

    [[nodiscard]] bool loose(Corner c) const { return loose_[index(c.i, c.j)]; }
    [[nodiscard]] bool is_torn(int i, int j) const { return rims_.torn[index(i, j)] > 0.0F; }
    [[nodiscard]] bool has_loose_corner(int i, int j) const {
        const auto around = corners(i, j);
        return std::any_of(around.begin(), around.end(),
                           [this](Corner corner) { return loose(corner); });
    }

    [[nodiscard]] bool is_steep(int i, int j) const {
        const auto [low, high] =
            std::minmax({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        const float range = high - low;
        if (!(2.0F * range * range > limit_px_ * limit_px_)) return false;
        for (int y = grid_.image_j(j); y < grid_.image_j(j + 1); ++y) {
            const std::size_t row = image_.index(0, y);
            const std::size_t below = image_.index(0, y + 1);
            for (int x = grid_.image_i(i); x < grid_.image_i(i + 1); ++x) {
                const auto at_x = static_cast<std::size_t>(x);
                if (is_steep(elevation_(row + at_x), elevation_(row + at_x + 1),
                             elevation_(below + at_x), elevation_(below + at_x + 1)))
                    return true;
            }
        }
        return false;
    }

    /// Whether one of the two triangles of these four neighbours is steep.
    [[nodiscard]] bool is_steep(float here, float right, float below, float beyond) const {
        const auto steep = [this](float x, float y) {
            return x * x + y * y > limit_px_ * limit_px_;
        };
        return steep(right - here, below - here) || steep(beyond - below, beyond - right);
    }

    [[nodiscard]] Around around(const Triangle& triangle) const {
        // The second corner of either triangle of a cell is the cell's lower left one.
        const int i = triangle[1].i;
        const int j = triangle[1].j - 1;
        Around found{{std::max(i - 1, 0), std::max(j - 1, 0)},
                     {std::min(i + 2, columns_ - 1), std::min(j + 2, rows_ - 1)},
                     std::numeric_limits<float>::max(),
                     std::numeric_limits<float>::lowest()};
        const auto include = [&](Corner c) {
            if (loose(c)) return;
            found.low = std::min(found.low, at(c.i, c.j));
            found.high = std::max(found.high, at(c.i, c.j));
        };
        for (const Corner& corner : triangle) include(corner);
        if (found.high - found.low > limit_px_ * static_cast<float>(grid_.step)) return found;
        for (int y = found.first.j; y <= found.last.j; ++y) {
            for (int x = found.first.i; x <= found.last.i; ++x) include({x, y});
        }
        return found;
    }

    /// Marks the cell as torn. Marks a corner as loose if it continues neither face's slope.
    void mark_torn_and_loose(int i, int j) {
        rims_.torn[index(i, j)] = 1.0F;
        for (const Corner& corner : corners(i, j)) {
            const float z = at(corner.i, corner.j);
            Corner up = corner;
            Corner down = corner;
            for (int y = std::max(corner.j - 1, 0); y <= std::min(corner.j + 1, rows_ - 1); ++y) {
                for (int x = std::max(corner.i - 1, 0); x <= std::min(corner.i + 1, columns_ - 1);
                     ++x) {
                    if (at(x, y) > at(up.i, up.j)) up = {x, y};
                    if (at(x, y) < at(down.i, down.j)) down = {x, y};
                }
            }
            const float near = kOnSlope * (at(up.i, up.j) - at(down.i, down.j));
            if (distance(z, extrapolated(corner, up)) > near &&
                distance(z, extrapolated(corner, down)) > near) {
                loose_[index(corner.i, corner.j)] = true;
            }
        }
    }

    /// The elevation at `end`, extrapolated from the slope behind its neighbour `next`.
    [[nodiscard]] float extrapolated(Corner end, Corner next) const {
        const float z = at(next.i, next.j);
        const int i = 2 * next.i - end.i;
        const int j = 2 * next.j - end.j;
        if (i < 0 || j < 0 || i >= columns_ || j >= rows_) return z;
        return 2.0F * z - at(i, j);
    }

    /// A cell for which the layers have no room stays whole.
    void tear(int i, int j) {
        const bool has_room = rims_.layers.size() < kMostLayerVertices;
        rims_.torn[index(i, j)] = has_room ? 1.0F : 0.0F;
        if (!has_room) return;
        tear(Triangle{{{i, j}, {i, j + 1}, {i + 1, j}}});
        tear(Triangle{{{i + 1, j}, {i, j + 1}, {i + 1, j + 1}}});
    }

    void tear(const Triangle& triangle) {
        const Around faces = around(triangle);
        const float range = faces.high - faces.low;
        if (!(range > 0.0F)) return;  // no face around
        add_layer(triangle, faces, faces.high, kLayerTolerance * range);
        add_layer(triangle, faces, faces.low, kLayerTolerance * range);
    }

    void add_layer(const Triangle& triangle, const Around& faces, float face, float tolerance) {
        const float near = kOnFace * (faces.high - faces.low);
        for (const Corner& corner : triangle) {
            rims_.layers.push_back(
                {vertex(corner), vertex(nearest_on(face, near, corner, faces)), tolerance});
        }
    }

    static GridVertex vertex(Corner c) {
        return {static_cast<std::uint16_t>(c.i), static_cast<std::uint16_t>(c.j)};
    }

    /// The vertex around that is on the face and closest to the corner, often the corner itself.
    [[nodiscard]] Corner nearest_on(float face, float near, Corner corner,
                                    const Around& faces) const {
        Corner best = corner;
        int least = std::numeric_limits<int>::max();
        for (int y = faces.first.j; y <= faces.last.j; ++y) {
            for (int x = faces.first.i; x <= faces.last.i; ++x) {
                const int dx = x - corner.i;
                const int dy = y - corner.j;
                const int square = dx * dx + dy * dy;
                if (square < least && !loose(Corner{x, y}) && distance(at(x, y), face) <= near) {
                    best = {x, y};
                    least = square;
                }
            }
        }
        return best;
    }

    const DepthImage& image_;  // used for the size only
    PixelElevation elevation_;
    const ReliefGrid& grid_;
    int columns_;
    int rows_;
    float limit_px_;  // steeper from pixel to pixel is a silhouette
    const std::vector<float>& elevations_;
    std::vector<bool> loose_;  // in the blur between two faces
    Rims& rims_;
};

}  // namespace

int ReliefGrid::image_i(int i) const noexcept {
    return std::min(i * step, image_columns - 1);
}
int ReliefGrid::image_j(int j) const noexcept {
    return std::min(j * step, image_rows - 1);
}

ReliefGrid plan_grid(int image_columns, int image_rows, std::size_t most_vertices, int most_side) {
    ReliefGrid grid{image_columns, image_rows, 1};
    if (!grid.drawable()) return grid;
    const int side = std::clamp(most_side, 2, 65536);
    const auto vertices = std::max<std::size_t>(most_vertices, 4);
    while (static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows()) >
               vertices ||
           std::max(grid.columns(), grid.rows()) > side) {
        ++grid.step;
    }
    return grid;
}

GridMesh tile_grid(const ReliefGrid& grid) {
    GridMesh mesh;
    if (!grid.drawable()) return mesh;
    const auto cells =
        static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows());
    mesh.vertices.reserve(cells + cells / 4);
    mesh.indices.reserve(cells * 6);
    for (int top = 0; top < grid.rows() - 1; top += kTileRows) {
        for (int left = 0; left < grid.columns() - 1; left += kTileColumns) {
            add_tile(mesh, left, top, std::min(left + kTileColumns, grid.columns() - 1),
                     std::min(top + kTileRows, grid.rows() - 1));
        }
    }
    return mesh;
}

std::vector<GridVertex> border_strip(const ReliefGrid& grid) {
    std::vector<GridVertex> strip;
    if (!grid.drawable()) return strip;
    const int right = grid.columns() - 1;
    const int bottom = grid.rows() - 1;
    const auto add = [&](int i, int j) {
        const GridVertex vertex{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)};
        strip.insert(strip.end(), {vertex, vertex});
    };
    for (int i = 0; i < right; ++i) add(i, 0);
    for (int j = 0; j < bottom; ++j) add(right, j);
    for (int i = right; i > 0; --i) add(i, bottom);
    for (int j = bottom; j >= 0; --j) add(0, j);
    return strip;
}

void drawn_elevations(const BlendedDepth& depth, const ReliefGrid& grid,
                      std::vector<float>& elevations) {
    const PixelElevation elevation(depth);
    elevations.resize(static_cast<std::size_t>(grid.columns()) *
                      static_cast<std::size_t>(grid.rows()));
    float* next = elevations.data();
    for (int j = 0; j < grid.rows(); ++j) {
        for (int i = 0; i < grid.columns(); ++i)
            *next++ = elevation(depth.from.index(grid.image_i(i), grid.image_j(j)));
    }
}

void tear_rims(const BlendedDepth& depth, const ReliefGrid& grid,
               const std::vector<float>& elevations, double slope_limit, Rims& rims) {
    Tearing(depth, grid, elevations, slope_limit, rims).run();
}

}  // namespace dibhr
