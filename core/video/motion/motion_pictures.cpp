// Grey pictures and outlines at four sizes.
#include "core/video/motion/motion_pictures.hpp"

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr int kMostPixels = 400'000;  // of the picture in which motion is searched
constexpr int kReach_px = 2;          // of an outline around the nearer surface
constexpr double kWhite = 255.0;

int whole_cells(int pixels) {
    return (pixels + kMotionCell_px - 1) / kMotionCell_px * kMotionCell_px;
}

/// Repeats the last column and row up to whole cells.
void continue_edges(MotionPlane& plane, int columns, int rows) {
    for (int j = 0; j < rows; ++j) {
        float* row = plane.row(j);
        std::fill(row + columns, row + plane.columns, row[columns - 1]);
    }
    for (int j = rows; j < plane.rows; ++j)
        std::copy_n(plane.row(rows - 1), plane.columns, plane.row(j));
}

/// Every `step`-th level, scaled to white for the highest.
void thin_out(const DepthImage& depth, int step, MotionPlane& thin) {
    const int columns = (depth.columns + step - 1) / step;
    const int rows = (depth.rows + step - 1) / step;
    thin.resize(whole_cells(columns), whole_cells(rows));
    const auto scale = static_cast<float>(kWhite / depth.highest_level);
    for (int j = 0; j < rows; ++j) {
        const float* from = depth.levels.data() + depth.index(0, std::min(j * step, depth.rows));
        float* to = thin.row(j);
        for (int i = 0; i < columns; ++i, from += step) to[i] = scale * *from;
    }
    continue_edges(thin, columns, rows);
}

void grey_of(const ColourImage& colour, int columns, int rows, MotionPlane& grey) {
    // OpenCV has no read-only pictures; this one is only read.
    const cv::Mat rgb(colour.rows, colour.columns, CV_8UC3,
                      const_cast<std::uint8_t*>(colour.rgb.data()));
    cv::Mat whole;
    cv::cvtColor(rgb, whole, cv::COLOR_RGB2GRAY);
    if (whole.cols != columns || whole.rows != rows)
        cv::resize(whole, whole, {columns, rows}, 0.0, 0.0,
                   whole.cols > columns ? cv::INTER_AREA : cv::INTER_LINEAR);
    grey.resize(whole_cells(columns), whole_cells(rows));
    for (int j = 0; j < rows; ++j) {
        const std::uint8_t* from = whole.ptr(j);
        float* to = grey.row(j);
        for (int i = 0; i < columns; ++i) to[i] = static_cast<float>(from[i]);
    }
    continue_edges(grey, columns, rows);
}

/// Weights of 1/4, 1/2 and 1/4 for three pixels in a column, and in a row.
DIBHR_VECTOR_CLONES void soften_rows(const float* __restrict above, const float* __restrict here,
                                     const float* __restrict below, float* __restrict to,
                                     int count) {
    for (int i = 0; i < count; ++i) to[i] = 0.25F * (above[i] + below[i]) + 0.5F * here[i];
}
DIBHR_VECTOR_CLONES void soften_columns(const float* __restrict from, float* __restrict to,
                                        int count) {
    for (int i = 1; i + 1 < count; ++i)
        to[i] = 0.25F * (from[i - 1] + from[i + 1]) + 0.5F * from[i];
    to[0] = from[0];
    to[count - 1] = from[count - 1];
}

/// `to` may be `from`.
void soften(const MotionPlane& from, MotionPlane& scratch, MotionPlane& to) {
    scratch.resize(from.columns, from.rows);
    for (int j = 0; j < from.rows; ++j)
        soften_rows(from.row(std::max(j - 1, 0)), from.row(j),
                    from.row(std::min(j + 1, from.rows - 1)), scratch.row(j), from.columns);
    to.resize(from.columns, from.rows);
    for (int j = 0; j < from.rows; ++j) soften_columns(scratch.row(j), to.row(j), from.columns);
}

DIBHR_VECTOR_CLONES void nearest_of_rows(const float* __restrict row, float* __restrict nearest,
                                         int count) {
    for (int i = 0; i < count; ++i) nearest[i] = std::max(nearest[i], row[i]);
}
DIBHR_VECTOR_CLONES void nearest_of_columns(const float* __restrict from, float* __restrict to,
                                            int count) {
    for (int i = kReach_px; i + kReach_px < count; ++i) {
        const float beside =
            std::max(std::max(from[i - 2], from[i - 1]), std::max(from[i + 1], from[i + 2]));
        to[i] = std::max(beside, from[i]);
    }
}

void nearest_around(const MotionPlane& depth, MotionPlane& scratch, MotionPlane& near) {
    scratch.resize(depth.columns, depth.rows);
    near.resize(depth.columns, depth.rows);
    const int columns = depth.columns;
    for (int j = 0; j < depth.rows; ++j) {
        float* to = scratch.row(j);
        std::copy_n(depth.row(j), columns, to);
        for (int away = -kReach_px; away <= kReach_px; ++away)
            if (away != 0)
                nearest_of_rows(depth.row(std::clamp(j + away, 0, depth.rows - 1)), to, columns);
    }
    for (int j = 0; j < depth.rows; ++j) {
        const float* from = scratch.row(j);
        float* to = near.row(j);
        nearest_of_columns(from, to, columns);
        for (const int begin : {0, columns - kReach_px})
            for (int i = begin; i < begin + kReach_px; ++i)
                to[i] = *std::max_element(from + std::max(i - kReach_px, 0),
                                          from + std::min(i + kReach_px + 1, columns));
    }
}

DIBHR_VECTOR_CLONES void halve(const MotionPlane& from, MotionPlane& to) {
    to.resize(from.columns / 2, from.rows / 2);
    for (int j = 0; j < to.rows; ++j) {
        const float* upper = from.row(2 * j);
        const float* lower = from.row(2 * j + 1);
        float* row = to.row(j);
        const auto count = static_cast<std::ptrdiff_t>(to.columns);
        for (std::ptrdiff_t i = 0; i < count; ++i)
            row[i] =
                0.25F * ((upper[2 * i] + upper[2 * i + 1]) + (lower[2 * i] + lower[2 * i + 1]));
    }
}

DIBHR_VECTOR_CLONES void halve_to_nearest(const MotionPlane& from, MotionPlane& to) {
    to.resize(from.columns / 2, from.rows / 2);
    for (int j = 0; j < to.rows; ++j) {
        const float* upper = from.row(2 * j);
        const float* lower = from.row(2 * j + 1);
        float* row = to.row(j);
        const auto count = static_cast<std::ptrdiff_t>(to.columns);
        for (std::ptrdiff_t i = 0; i < count; ++i)
            row[i] = std::max(std::max(upper[2 * i], upper[2 * i + 1]),
                              std::max(lower[2 * i], lower[2 * i + 1]));
    }
}

}  // namespace

int motion_step(int columns, int rows) {
    int step = 1;
    while ((columns / step) * (rows / step) > kMostPixels) ++step;
    return step;
}

/// The median over places, most of which show the same, or what is alike.
float motion_gain(const MotionPictures& from, const MotionPictures& to) {
    constexpr float kDark = 16.0F;
    constexpr float kBright = 240.0F;
    const std::vector<float>& before = from.grey.back().values;
    const std::vector<float>& after = to.grey.back().values;
    std::vector<float> gains;
    constexpr std::size_t kEach = 3;
    gains.reserve(before.size() / kEach + 1);
    for (std::size_t k = 0; k < before.size(); k += kEach)
        if (std::min(before[k], after[k]) > kDark && std::max(before[k], after[k]) < kBright)
            gains.push_back(before[k] / after[k]);
    if (gains.empty()) return 1.0F;
    const auto middle = gains.begin() + static_cast<std::ptrdiff_t>(gains.size() / 2);
    std::nth_element(gains.begin(), middle, gains.end());
    return *middle;
}

void MotionPictureMaker::make(const Frame& frame, bool by_depth, MotionPictures& pictures) {
    const DepthImage& depth = *frame.drawn();
    pictures.step = motion_step(depth.columns, depth.rows);
    thin_out(depth, pictures.step, depth_);
    nearest_around(depth_, scratch_, pictures.near[0]);
    soften(depth_, scratch_, pictures.level[0]);
    if (by_depth) {
        pictures.here[0] = pictures.near[0];
        pictures.grey[0] = pictures.level[0];
    } else {
        std::swap(pictures.here[0], depth_);
        grey_of(*frame.rgb(), (depth.columns + pictures.step - 1) / pictures.step,
                (depth.rows + pictures.step - 1) / pictures.step, pictures.grey[0]);
        soften(pictures.grey[0], scratch_, pictures.grey[0]);
    }
    for (std::size_t k = 1; k < kMotionSizes; ++k) {
        halve(pictures.grey[k - 1], pictures.grey[k]);
        halve(pictures.level[k - 1], pictures.level[k]);
        halve_to_nearest(pictures.near[k - 1], pictures.near[k]);
        halve_to_nearest(pictures.here[k - 1], pictures.here[k]);
    }
}

}  // namespace dibhr
