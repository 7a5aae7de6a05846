// A stroke is a row of dabs; each dab changes the pixels under it.
#include "app/viewer/painting/map_stroke.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace dibhr {

namespace {

constexpr double kSoftFrom = 0.7;       // of the radius
constexpr double kDabsPerRadius = 4.0;  // along a stroke

/// Strength of the brush at a distance from its middle [radii].
double softness(double distance) {
    if (distance >= 1.0) return 0.0;
    const double t = std::clamp((1.0 - distance) / (1.0 - kSoftFrom), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

std::uint16_t level_of_share(double share) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * TouchMap::kWhole));
}

}  // namespace

TouchMap resized(const TouchMap& map, TouchMapKind kind, int columns, int rows) {
    if (map.columns == columns && map.rows == rows) return map;
    TouchMap other = bare_map(kind, columns, rows);
    if (map.empty()) return other;
    other.limits = map.limits;
    TouchMap cover = map;
    cover.limits = {0.0, 1.0};
    for (TouchMap::Pixel& pixel : cover.pixels) pixel = {pixel.cover, level_of_share(1.0)};
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double share = map_value(cover, i, j, columns, rows, 0.0);
            // `value` is weighted by the cover (0 where nothing covers): divide by it.
            const double value = map_value(map, i, j, columns, rows, 0.0);
            if (share > 0.0)
                other.at(i, j) = {other.level_of(value / share), level_of_share(share)};
        }
    }
    return other;
}

MapStroke::MapStroke(const TouchMaps& before, std::vector<Lay> lays, BrushTip tip, int columns,
                     int rows)
    : before_(before),
      lays_(std::move(lays)),
      tip_(tip),
      columns_(columns),
      rows_(rows),
      laid_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {
    for (const Lay& lay : lays_) {
        TouchMap& map = before_.of(lay.kind);
        map = resized(map, lay.kind, columns, rows);
    }
    maps_ = before_;
    lay_heights(maps_, columns_, rows_);
}

void MapStroke::go_to(const Vec3& place) {
    const Vec3 from = last_.value_or(place);
    const double way = std::hypot(place.x - from.x, place.y - from.y);
    const int dabs = static_cast<int>(std::ceil(kDabsPerRadius * way / tip_.radius_px));
    if (!last_) dab(place.x, place.y);
    for (int k = 1; k <= dabs; ++k) {
        const double share = static_cast<double>(k) / dabs;
        dab(from.x + share * (place.x - from.x), from.y + share * (place.y - from.y));
    }
    last_ = place;
    const bool raises = std::any_of(lays_.begin(), lays_.end(), [](const Lay& lay) {
        return lay.kind == TouchMapKind::height;
    });
    if (raises) lay_heights(maps_, columns_, rows_);
}

void MapStroke::dab(double x, double y) {
    const double radius = std::max(tip_.radius_px, 0.5);
    const int first_i = std::max(static_cast<int>(std::ceil(x - radius)), 0);
    const int last_i = std::min(static_cast<int>(x + radius), columns_ - 1);
    const int first_j = std::max(static_cast<int>(std::ceil(y - radius)), 0);
    const int last_j = std::min(static_cast<int>(y + radius), rows_ - 1);
    for (int j = first_j; j <= last_j; ++j) {
        for (int i = first_i; i <= last_i; ++i) {
            const double share = tip_.strength * softness(std::hypot(i - x, j - y) / radius);
            float& laid = laid_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                                static_cast<std::size_t>(i)];
            if (share <= static_cast<double>(laid)) continue;
            laid = static_cast<float>(share);
            lay_pixel(i, j, share);
        }
    }
}

void MapStroke::lay_pixel(int i, int j, double share) {
    for (const Lay& lay : lays_) {
        const TouchMap& under = before_.of(lay.kind);
        TouchMap& map = maps_.of(lay.kind);
        const TouchMap::Pixel& was = under.at(i, j);
        const double kept = (1.0 - share) * was.cover / TouchMap::kWhole;
        const double added = lay.value ? share : 0.0;
        TouchMap::Pixel& pixel = map.at(i, j);
        pixel.cover = level_of_share(kept + added);
        if (added > 0.0)
            pixel.level = map.level_of((kept * under.value_of(was) + added * lay.value(i, j)) /
                                       (kept + added));
    }
}

}  // namespace dibhr
