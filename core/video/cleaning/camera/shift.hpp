// Reads rows of a frame where what another frame shows is in it: whole pixels away.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/camera/camera_motion.hpp"

namespace dibhr {

/// [px]
struct Shift {
    int right{0}, down{0};

    bool operator==(const Shift&) const = default;
};

/// Halves are away from zero, so that frames before and after err to opposite sides.
[[nodiscard]] inline Shift rounded(const PictureWay& way) {
    return {static_cast<int>(std::lround(way.right)), static_cast<int>(std::lround(way.down))};
}

/// `count` values of row `j` from column `left` on, each read that shift away: in place, else a
/// copy in `scratch`. Outside of the picture they are `missing`. `values`: of a picture of the size
/// of `size`.
template <typename Value>
[[nodiscard]] const Value* shifted_row(const Value* values, const DepthImage& size, Shift shift,
                                       int j, int left, std::size_t count, Value missing,
                                       Value* scratch) {
    const int row = j + shift.down;
    const int first = left + shift.right;
    const int end = first + static_cast<int>(count);
    const bool in_rows = row >= 0 && row < size.rows;
    if (in_rows && first >= 0 && end <= size.columns) return values + size.index(first, row);
    std::fill_n(scratch, count, missing);
    const int from = std::max(first, 0);
    const int to = std::min(end, size.columns);
    if (in_rows && from < to)
        std::copy_n(values + size.index(from, row), to - from, scratch + (from - first));
    return scratch;
}

}  // namespace dibhr
