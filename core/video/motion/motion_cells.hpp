// The picture in cells, each of one surface or of a near and a far one, and sums over those alike.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/motion/motion_pictures.hpp"

namespace dibhr {

/// One value of each cell for what is near in it and for what is far.
struct MotionLayers {
    std::array<MotionPlane, 2> of{};

    void resize(int columns, int rows) {
        for (MotionPlane& plane : of) plane.resize(columns, rows);
    }
    void fill(float value) {
        for (MotionPlane& plane : of) std::fill(plane.values.begin(), plane.values.end(), value);
    }
};

/// What is summed over the pixels of a part of a surface, of the difference r between the second
/// picture, moved, and the first, whose slope is x and y.
/// The first three are of the difference alone.
enum class MotionSum { n, r, rr, x, y, xx, xy, yy, xr, yr };
inline constexpr std::size_t kMotionSums = 10;

/// Which of them are wanted: as many as it says.
enum class MotionMeasure : std::size_t { difference = 3, slopes = kMotionSums };

struct MotionSums {
    std::array<MotionLayers, kMotionSums> of{};

    void resize(int columns, int rows) {
        for (MotionLayers& layers : of) layers.resize(columns, rows);
    }
    void fill(float value) {
        for (MotionLayers& layers : of) layers.fill(value);
    }
    [[nodiscard]] MotionLayers& operator[](MotionSum sum) {
        return of[static_cast<std::size_t>(sum)];
    }
    [[nodiscard]] const MotionLayers& operator[](MotionSum sum) const {
        return of[static_cast<std::size_t>(sum)];
    }
};

/// Which way parts go [px of the largest picture].
struct MotionWays {
    MotionLayers right{}, down{};

    void resize(int columns, int rows) {
        right.resize(columns, rows);
        down.resize(columns, rows);
    }
    void fill(float value) {
        right.fill(value);
        down.fill(value);
    }
};

/// Cells of kMotionCell_px squared.
struct MotionCells {
    int columns{0};
    int rows{0};
    /// What is above it is the near part, the rest the far one; below all: there is no far part.
    MotionPlane between{};
    /// Depths of the parts [0, 255]; the highest is kNoPart where the cell has no such part.
    MotionLayers lowest{}, highest{};

    std::vector<std::uint8_t> both{};  ///< of each row: whether there is a far part in it

    static constexpr float kNoPart = -1e9F;

    [[nodiscard]] bool has(std::size_t part, int i, int j) const {
        return highest.of[part].row(j)[i] != kNoPart;
    }
    [[nodiscard]] bool any_in_row(std::size_t part, int j) const {
        return part == 0 || both[static_cast<std::size_t>(j)] != 0;
    }
};

/// Of each row of cells the columns [begin, end) that are looked at.
struct MotionSpan {
    int begin{0}, end{0};
};
using MotionSpans = std::vector<MotionSpan>;

/// By the depth of one frame [0, 255].
void make_cells(const MotionPlane& depth, MotionCells& cells);

/// Depths that differ by less may be of one surface [0, 255].
inline constexpr float kMotionAlike = 12.0F;

/// How alike two parts are in depth, in [0, 1], by the gap between their depths.
[[nodiscard]] inline float alike_across(float gap) {
    const float alike = 1.0F - gap * (1.0F / kMotionAlike);
    return std::min(std::max(alike, 0.0F), 1.0F);
}

/// For each part in the spans the sums over all parts up to `reach` cells away, the more the more
/// alike their depths are.
void gather_alike(const MotionCells& cells, const MotionSpans& spans, int reach,
                  MotionMeasure measure, const MotionSums& from, MotionSums& to);

}  // namespace dibhr
