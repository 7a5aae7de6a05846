// The touchable surface at one moment: two depth images, a blend, a bump map and painted maps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/touch_maps.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

// The triangles, edges and vertices the depth image spans, named by integers.

enum class PrimitiveKind { none, triangle, edge, vertex };
inline constexpr auto kLastPrimitiveKind = PrimitiveKind::vertex;

/// The diagonal of cell (i, j) joins (i+1, j) and (i, j+1), and so splits it into two triangles.
enum class TriangleSide {
    near_origin,  ///< corners (i, j), (i+1, j), (i, j+1)
    far_corner,   ///< corners (i+1, j+1), (i, j+1), (i+1, j)
};

enum class EdgeDirection {
    along_row,     ///< (i, j) to (i+1, j)
    along_column,  ///< (i, j) to (i, j+1)
    diagonal,      ///< (i+1, j) to (i, j+1)
};

/// The active primitive. `side` means something for a triangle, `direction` for an edge; (i, j) is
/// the cell of a triangle or diagonal, the first end of another edge, the vertex itself; (-1, -1)
/// for none.
struct Primitive {
    PrimitiveKind kind{PrimitiveKind::none};
    TriangleSide side{TriangleSide::near_origin};
    EdgeDirection direction{EdgeDirection::along_row};
    int i{-1};
    int j{-1};

    bool operator==(const Primitive&) const = default;
};

[[nodiscard]] constexpr Primitive triangle(TriangleSide side, int i, int j) noexcept {
    return {PrimitiveKind::triangle, side, EdgeDirection::along_row, i, j};
}
[[nodiscard]] constexpr Primitive edge(EdgeDirection direction, int i, int j) noexcept {
    return {PrimitiveKind::edge, TriangleSide::near_origin, direction, i, j};
}
[[nodiscard]] constexpr Primitive vertex(int i, int j) noexcept {
    return {PrimitiveKind::vertex, TriangleSide::near_origin, EdgeDirection::along_row, i, j};
}

/// "none", "triangle", "edge" or "vertex", as in the output rows.
[[nodiscard]] constexpr const char* name_of(PrimitiveKind kind) noexcept {
    switch (kind) {
        case PrimitiveKind::triangle:
            return "triangle";
        case PrimitiveKind::edge:
            return "edge";
        case PrimitiveKind::vertex:
            return "vertex";
        case PrimitiveKind::none:
            break;
    }
    return "none";
}

/// A view that owns nothing and costs nothing to make: an elevation is computed when it is read,
/// `relief * lerp(from, to, blend) / highest level + roughness * bump(u, v) + height`. The
/// images and maps must outlive it and stay as they are; the images have the same size and highest
/// level, and are at least 2 x 2.
class DepthSurface {
  public:
    /// `blend` in [0, 1] (clamped): 0 is `from`, 1 is `to`. `bump` may be null.
    /// `unseen`: 1 for every vertex where no surface was ever seen, row-major; null: seen all over.
    /// `maps`: null: none; their heights count when they are laid over images of this size.
    DepthSurface(const DepthImage& from, const DepthImage& to, double blend, SurfaceShape shape,
                 const BumpMap* bump = nullptr, const std::vector<std::uint8_t>* unseen = nullptr,
                 const TouchMaps* maps = nullptr) noexcept;

    [[nodiscard]] int columns() const noexcept { return columns_; }
    [[nodiscard]] int rows() const noexcept { return rows_; }

    /// Elevation of vertex (i, j) [px]; 0 <= i < columns, 0 <= j < rows.
    [[nodiscard]] double elevation(int i, int j) const noexcept {
        const std::size_t k = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(i);
        double level = static_cast<double>(from_[k]);
        if (to_ != from_) level += blend_ * (static_cast<double>(to_[k]) - level);
        // Dividing last keeps whole levels exact: relief * level / highest level.
        const double z = relief_px_ * level / highest_level_;
        return is_bare_ ? z : z + added_height(i, j, k);
    }

    /// Asks the memory for what `elevation(i, j)` reads, and does not wait. Outside the image: does
    /// nothing. Inlined always: GCC leaves out a call that only fetches.
    [[gnu::always_inline]] void fetch(int i, int j) const noexcept {
        if (!has_vertex(i, j)) return;
        const std::size_t k = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(i);
        __builtin_prefetch(from_ + k);
        if (to_ != from_) __builtin_prefetch(to_ + k);
        if (heights_ != nullptr) __builtin_prefetch(heights_ + k);
        if (stretched_ != nullptr) __builtin_prefetch(stretched_ + k);
    }

    [[nodiscard]] bool has_bump() const noexcept { return bump_ != nullptr; }

    [[nodiscard]] bool has_vertex(int i, int j) const noexcept {
        return static_cast<unsigned>(i) < static_cast<unsigned>(columns_) &&
               static_cast<unsigned>(j) < static_cast<unsigned>(rows_);
    }

    /// Whether there was ever a surface at the vertex nearest to (x, y), clamped to the image
    /// rectangle.
    [[nodiscard]] bool seen_at(double x, double y) const noexcept;

    /// Friction and stiffness [N/mm] at (x, y), clamped to the image rectangle: from the maps, or
    /// `everywhere` without a map.
    [[nodiscard]] Friction friction_at(double x, double y, Friction everywhere) const noexcept;
    [[nodiscard]] double stiffness_at(double x, double y, double everywhere) const noexcept;

    /// The place of vertex (i, j).
    [[nodiscard]] Vec3 vertex_at(int i, int j) const noexcept { return {i, j, elevation(i, j)}; }

    /// Elevation of the triangulated surface under (x, y) [px], clamped to the image rectangle.
    [[nodiscard]] double elevation_at(double x, double y) const noexcept;

    /// The TRIANGLE under (x, y), clamped to the image rectangle; either one where two meet.
    [[nodiscard]] Primitive triangle_at(double x, double y) const noexcept {
        const int i = cell_at(x, columns_ - 2);
        const int j = cell_at(y, rows_ - 2);
        return triangle(
            x - i + (y - j) <= 1.0 ? TriangleSide::near_origin : TriangleSide::far_corner, i, j);
    }

    /// No vertex is higher than this [px], as long as no level exceeds the highest.
    [[nodiscard]] double ceiling() const noexcept {
        const double roughness = bump_ == nullptr ? 0.0 : std::max(roughness_px_, 0.0);
        const double height = heights_ == nullptr ? 0.0 : maps_->at_vertices.highest_px;
        return std::max(relief_px_, 0.0) + roughness + height;
    }

    /// (x, y) moved into the image rectangle [0, columns-1] x [0, rows-1]; z stays.
    [[nodiscard]] Vec3 clamped_to_frame(Vec3 p) const noexcept {
        return {std::clamp(p.x, 0.0, columns_ - 1.0), std::clamp(p.y, 0.0, rows_ - 1.0), p.z};
    }

    /// Moved into the box around the scene in which everything is computed: kReach_px beyond the
    /// image on all sides, the ground and the ceiling.
    [[nodiscard]] Vec3 clamped_to_reach(Vec3 p) const noexcept {
        return {std::clamp(p.x, -kReach_px, columns_ - 1.0 + kReach_px),
                std::clamp(p.y, -kReach_px, rows_ - 1.0 + kReach_px),
                std::clamp(p.z, -kReach_px, ceiling() + kReach_px)};
    }

    /// Farther than any hand goes, near enough that round-off stays below a billionth of a pixel.
    static constexpr double kReach_px = 1e5;

  private:
    /// The cell under a coordinate, 0 to `last`. Clamped before the cast: it may be any finite one.
    [[nodiscard]] static int cell_at(double along, int last) noexcept {
        return static_cast<int>(std::clamp(along, 0.0, static_cast<double>(last)));
    }

    /// Bumps and painted height at vertex (i, j), the k-th [px].
    [[nodiscard]] double added_height(int i, int j, std::size_t k) const noexcept {
        const double height = heights_ == nullptr ? 0.0 : static_cast<double>(heights_[k]);
        if (bump_ == nullptr) return height;
        const double bump = stretched_ == nullptr ? bump_height(i, j) : stretched_[k];
        return heights_ == nullptr ? roughness_px_ * bump : roughness_px_ * bump + height;
    }

    /// Bilinear height of the bump map at vertex (i, j), in [0, 1].
    [[nodiscard]] double bump_height(int i, int j) const noexcept;

    [[nodiscard]] double map_value_at(const TouchMap& map, double x, double y,
                                      double otherwise) const noexcept;

    const float* from_{nullptr};
    const float* to_{nullptr};
    int columns_{0};
    int rows_{0};
    double blend_{0.0};
    double relief_px_{0.0};
    double highest_level_{255.0};
    double roughness_px_{0.0};
    double bump_size_px_{0.0};
    const BumpMap* bump_{nullptr};
    const std::uint8_t* unseen_{nullptr};
    const double* stretched_{nullptr};  ///< the bump map's heights at the vertices, if known
    const TouchMaps* maps_{nullptr};
    const float* heights_{nullptr};  ///< the height map's at the vertices; null: none
    bool is_bare_{true};             ///< neither bumps nor heights
};

/// Lays a bump map of that size (SurfaceShape::bump_size_px) over depth images of columns x rows,
/// at least 1 x 1, beforehand: an update there takes about half as long. Over others its heights
/// are computed one by one when they are read, to the same bits. Takes 8 bytes and some
/// nanoseconds a VERTEX. To be called again when the bump map's own heights change.
void stretch(BumpMap& bump, int columns, int rows, double bump_size_px = 0.0);

/// The same for a shared map: a stretched copy takes its place, unless it is stretched already.
/// Without an image, or memory, it stays as it is.
void stretch(std::shared_ptr<const BumpMap>& bump, int columns, int rows, double bump_size_px);

/// Whether the map is stretched over images of this size.
[[nodiscard]] bool is_stretched(const BumpMap& bump, int columns, int rows,
                                double bump_size_px = 0.0) noexcept;

}  // namespace dibhr
