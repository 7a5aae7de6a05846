// The pictures in which motion is searched: each frame as grey and depth, at four sizes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Values of pixels, rows x columns, row-major.
struct MotionPlane {
    int columns{0};
    int rows{0};
    std::vector<float> values{};

    void resize(int wide, int high) {
        columns = wide;
        rows = high;
        values.resize(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high));
    }
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(i);
    }
    [[nodiscard]] float* row(int j) { return values.data() + index(0, j); }
    [[nodiscard]] const float* row(int j) const { return values.data() + index(0, j); }
};

/// Number of sizes of a picture, each half of the one before: the last one has one pixel a cell.
inline constexpr int kMotionSizes = 4;
/// Side of a cell in the largest picture [px].
inline constexpr int kMotionCell_px = 8;
static_assert(kMotionCell_px == 1 << (kMotionSizes - 1));

/// Grey [0, 255] and depth [0, 255] of one frame, largest first. Columns and rows are those of the
/// depth image, thinned out `step` times and continued to whole cells.
struct MotionPictures {
    int step{1};
    std::array<MotionPlane, kMotionSizes> grey{};
    std::array<MotionPlane, kMotionSizes> level{};  ///< the depth
    /// The nearest depth in each pixel, and within 2 px of the largest picture: an outline belongs
    /// to the nearer surface.
    std::array<MotionPlane, kMotionSizes> here{}, near{};
};

/// By what the grey of the second pictures is multiplied to be as bright as that of the first: an
/// exposure that changes is no motion.
[[nodiscard]] float motion_gain(const MotionPictures& from, const MotionPictures& to);

/// Makes a frame's pictures; keeps scratch memory.
class MotionPictureMaker {
  public:
    /// `by_depth`: grey is the depth, too.
    void make(const Frame& frame, bool by_depth, MotionPictures& pictures);

  private:
    MotionPlane depth_{}, scratch_{};
};

/// The picture in which motion is searched has every n-th pixel of the frame: returns n.
[[nodiscard]] int motion_step(int columns, int rows);

}  // namespace dibhr
