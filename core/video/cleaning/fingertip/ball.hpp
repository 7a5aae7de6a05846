// Shared by the parts of the dilation: the ball, images with padding, and lists.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/cleaning_options.hpp"

namespace dibhr::fingertip {

/// Each piece reaches this far beyond its rim, so that rounding leaves no gap between two pieces.
inline constexpr float kOverlap_px = 1e-3F;
inline constexpr float kNothing = -std::numeric_limits<float>::infinity();
inline constexpr float kSteepest = 1e18F;  ///< its square is far from a float's highest

/// The nearest whole number not below, and not above; only for values that an int holds.
inline int round_up(float x) {
    const int cut = static_cast<int>(x);
    return cut + (static_cast<float>(cut) < x ? 1 : 0);
}
inline int round_down(float x) {
    const int cut = static_cast<int>(x);
    return cut - (static_cast<float>(cut) > x ? 1 : 0);
}

/// Clamped to [-limit, limit]; NaN becomes -limit.
inline float clamped(float x, float limit) {
    const float low = x > -limit ? x : -limit;
    return low < limit ? low : limit;
}

struct Ball {
    Ball() = default;
    Ball(const Fingertip& finger, double highest_level)
        : radius_px(finger.radius_px),
          radius(static_cast<float>(finger.radius_px)),
          radius_levels(static_cast<float>(finger.radius_px * highest_level / finger.relief_px)),
          px_per_level(static_cast<float>(finger.relief_px / highest_level)),
          levels_per_px(static_cast<float>(highest_level / finger.relief_px)) {}

    double radius_px{0.0};
    float radius{0.0F};         ///< the same as float [px]
    float radius_levels{0.0F};  ///< the radius [levels]
    float px_per_level{0.0F};
    float levels_per_px{0.0F};

    bool operator==(const Ball&) const = default;

    /// The ball's height over its centre, at a distance from its axis [px]; 0 beyond the radius.
    [[nodiscard]] double height_px(double away_px) const {
        return std::sqrt(std::max(0.0, radius_px * radius_px - away_px * away_px));
    }
};

/// An image with padding on all sides. Values written into the padding are not kept.
class PaddedImage {
  public:
    void fit(int columns, int rows, int padding, float in_padding) {
        if (columns == columns_ && rows == rows_ && padding == padding_) return;
        columns_ = columns;
        rows_ = rows;
        padding_ = padding;
        pitch_ = columns + 2 * padding;
        levels_.assign(
            static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(rows + 2 * padding),
            in_padding);
    }
    void copy(const DepthImage& image) {
        for (int j = 0; j < rows_; ++j)
            std::copy_n(image.levels.data() + image.index(0, j), columns_, pixel(0, j));
    }

    [[nodiscard]] float* pixel(int i, int j) { return levels_.data() + at(i, j); }
    [[nodiscard]] const float* pixel(int i, int j) const { return levels_.data() + at(i, j); }
    [[nodiscard]] int pitch() const { return pitch_; }

  private:
    [[nodiscard]] std::ptrdiff_t at(int i, int j) const {
        return std::ptrdiff_t{j + padding_} * pitch_ + i + padding_;
    }

    int columns_{0}, rows_{0}, padding_{0}, pitch_{0};
    std::vector<float> levels_{};
};

/// So many flags are looked at together. Lists of flags have a multiple of this size, with 0 last.
inline constexpr std::size_t kFlagsAtOnce = 8;

[[nodiscard]] inline std::size_t whole_flags(std::size_t count) {
    return (count + kFlagsAtOnce - 1) / kFlagsAtOnce * kFlagsAtOnce;
}

[[nodiscard]] inline bool any_flag(const std::uint8_t* first) {
    std::uint64_t all = 0;
    std::memcpy(&all, first, sizeof all);
    return all != 0;
}

/// Writes the indices of the flags that are 1 into `numbers`, with room for one index more, and
/// returns how many there are. The flags are 1 or 0.
[[nodiscard]] inline std::size_t number_flagged(const std::vector<std::uint8_t>& flags,
                                                int* numbers) {
    std::size_t flagged = 0;
    for (std::size_t first = 0; first < flags.size(); first += kFlagsAtOnce) {
        if (!any_flag(flags.data() + first)) continue;
        for (std::size_t i = first; i < first + kFlagsAtOnce; ++i) {
            numbers[flagged] = static_cast<int>(i);
            flagged += static_cast<std::size_t>(flags[i]);
        }
    }
    return flagged;
}

/// Pixels that are computed together; the surplus ones at the end are not kept.
inline constexpr int kAtOnce = 8;

}  // namespace dibhr::fingertip
