// Adds the heights of two maps.
#include "core/video/guide/ridged_maps.hpp"

#include <algorithm>
#include <utility>

namespace dibhr {

namespace {

/// The sum of both at every pixel of the depth, where neither covers 0.
TouchMap sum_of(const TouchMap& painted, const TouchMap& ridges, int columns, int rows) {
    TouchMap sum = bare_map(TouchMapKind::height, columns, rows);
    sum.limits = {std::min(painted.limits.lowest, 0.0),
                  std::max(painted.limits.highest, 0.0) + ridges.limits.highest};
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double height_px = map_value(painted, i, j, columns, rows, 0.0) +
                                     map_value(ridges, i, j, columns, rows, 0.0);
            sum.at(i, j) = {sum.level_of(height_px), static_cast<std::uint16_t>(TouchMap::kWhole)};
        }
    }
    return sum;
}

}  // namespace

TouchMaps with_ridges(const TouchMaps* painted, const Regions& regions, int picture, int columns,
                      int rows) {
    TouchMaps maps = painted != nullptr ? *painted : TouchMaps{};
    TouchMap ridges = ridges_of(regions, picture, columns);
    maps.height =
        maps.height.empty() ? std::move(ridges) : sum_of(maps.height, ridges, columns, rows);
    lay_heights(maps, columns, rows);
    return maps;
}

}  // namespace dibhr
