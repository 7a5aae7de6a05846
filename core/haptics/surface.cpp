// A surface from two images, and elevations between the vertices.
#include "core/haptics/surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/haptics/facet.hpp"

namespace dibhr {

namespace {

/// The two columns (or rows) of a bump map around vertex k of `count`, held at its border, and how
/// far k is from the first to the second. Pixel centres of both images in the same normalised
/// coordinates.
struct Between {
    Between(int k, int count, int bumps) noexcept {
        const double at = (k + 0.5) / count * bumps - 0.5;  // >= -0.5
        const int below = at < 0.0 ? -1 : static_cast<int>(at);
        first = std::max(below, 0);
        second = std::min(below + 1, bumps - 1);
        share = at - below;
    }
    int first{0};
    int second{0};
    double share{0.0};
};

/// Bilinear height of a bump map.
double height_between(const BumpMap& bump, const Between& x, const Between& y) noexcept {
    const auto height = [&bump](int column, int row) {
        return static_cast<double>(
            bump.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(bump.columns) +
                         static_cast<std::size_t>(column)]);
    };
    return (1.0 - y.share) *
               ((1.0 - x.share) * height(x.first, y.first) + x.share * height(x.second, y.first)) +
           y.share *
               ((1.0 - x.share) * height(x.first, y.second) + x.share * height(x.second, y.second));
}

}  // namespace

DepthSurface::DepthSurface(const DepthImage& from, const DepthImage& to, double blend,
                           SurfaceShape shape, const BumpMap* bump,
                           const std::vector<std::uint8_t>* unseen) noexcept
    : from_(from.levels.data()),
      to_(to.levels.data()),
      columns_(from.columns),
      rows_(from.rows),
      blend_(std::clamp(blend, 0.0, 1.0)),
      relief_px_(shape.relief_px),
      highest_level_(from.highest_level),
      roughness_px_(shape.roughness_px),
      bump_(shape.roughness_px == 0.0 ? nullptr : bump),
      unseen_(unseen == nullptr ? nullptr : unseen->data()) {
    assert(unseen == nullptr || unseen->size() == from.levels.size());
    if (bump_ != nullptr && is_stretched(*bump_, columns_, rows_)) {
        stretched_ = bump_->at_vertices.heights.data();
        assert(bump_->at_vertices.heights.size() == from.levels.size());
    }
    assert(columns_ >= 2 && rows_ >= 2);
    assert(to.columns == columns_ && to.rows == rows_ && to.highest_level == highest_level_);
}

double DepthSurface::elevation_at(double x, double y) const noexcept {
    const Vec3 p = clamped_to_frame({x, y, 0.0});
    return Facet(*this, triangle_at(p.x, p.y)).elevation_at(p.x, p.y);
}

bool DepthSurface::seen_at(double x, double y) const noexcept {
    if (unseen_ == nullptr) return true;
    const Vec3 p = clamped_to_frame({x, y, 0.0});
    const auto i = static_cast<std::size_t>(std::lround(p.x));
    const auto j = static_cast<std::size_t>(std::lround(p.y));
    return unseen_[j * static_cast<std::size_t>(columns_) + i] == 0;
}

double DepthSurface::bump_height(int i, int j) const noexcept {
    return height_between(*bump_, Between(i, columns_, bump_->columns),
                          Between(j, rows_, bump_->rows));
}

void stretch(BumpMap& bump, int columns, int rows) {
    bump.at_vertices = {};  // should memory run out
    std::vector<double> heights;
    heights.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j) {
        const Between y(j, rows, bump.rows);
        for (int i = 0; i < columns; ++i) {
            heights.push_back(height_between(bump, Between(i, columns, bump.columns), y));
        }
    }
    bump.at_vertices = {columns, rows, std::move(heights)};
}

bool is_stretched(const BumpMap& bump, int columns, int rows) noexcept {
    return bump.at_vertices.columns == columns && bump.at_vertices.rows == rows;
}

}  // namespace dibhr
