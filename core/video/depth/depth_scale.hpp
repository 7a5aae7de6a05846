// How high a level of the source stands: by its meaning, one rule a unit.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// The highest level of depth images by that meaning, of a source whose levels have so many bits.
[[nodiscard]] double highest_level_of(const DepthMeaning& meaning, int bits);

/// Where a level stands between the farthest (0) and the nearest (1) of the range, linear in the
/// distance from the camera:
///   levels     (v - far) / (near - far)
///   mm, m      (far - v) / (far - near)
///   disparity  (1/far - 1/v) / (1/far - 1/near), for the distance is 1/v of some unknown unit
/// where v = level * scale. What is beyond an end of the range stands at that end.
///
/// A depth image's levels are that, times its highest level: where one step of the source is the
/// same everywhere it stays a step of 1 (levels of integers), or is in millimetres.
class DepthScale {
  public:
    /// `bits` of the source's levels; kRealBits: real numbers. The range's ends must differ.
    DepthScale(const DepthMeaning& meaning, int bits);

    /// Levels as the file has them, of which the highest of so many bits is the nearest. Real
    /// numbers stand as high as levels of 8 bits, and as far beyond them as they are.
    [[nodiscard]] static DepthScale as_recorded(int bits);

    /// NaN for no data: not finite, one of the levels that mean nothing, or, of a distance or a
    /// disparity, not above zero where that cannot be.
    [[nodiscard]] float operator()(double level) const;

    [[nodiscard]] double highest_level() const noexcept { return highest_; }
    /// No level of the source is no data.
    [[nodiscard]] bool is_always_data() const noexcept { return always_data_; }
    /// Nothing where levels are as recorded.
    [[nodiscard]] std::optional<DepthMeaning> meaning() const {
        return as_recorded_ ? std::nullopt : std::optional(meaning_);
    }

    /// Of a picture of 1 to 4 channels of 8 or 16 bits, or real numbers.
    [[nodiscard]] DepthImage image_of(const cv::Mat& picture) const;
    /// The same picture's distances from the camera [mm], CV_32FC1, also beyond the range; NaN for
    /// no data. Of a meaning that is metric.
    [[nodiscard]] cv::Mat distances_mm(const cv::Mat& picture) const;

  private:
    [[nodiscard]] bool is_no_data(double level) const;
    void map_row(const float* numbers, DepthImage& depth, int row) const;

    DepthMeaning meaning_;
    double highest_;
    double far_;      ///< on the line on which elevation is linear
    double per_one_;  ///< nearness of one on that line
    bool always_data_;
    bool as_recorded_{false};        ///< then real numbers may stand beyond the ends of the range
    std::vector<float> of_level_{};  ///< of every integer level; empty: of real numbers
};

}  // namespace dibhr
