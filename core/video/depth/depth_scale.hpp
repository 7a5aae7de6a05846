// Converts levels of the source to levels of depth images, by their meaning, one rule a unit.
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
/// where v = level * scale. Values beyond an end of the range are clamped to it.
///
/// A depth image's level is that times its highest level. If the source has equal steps, a step
/// stays 1 (levels of integers), or levels are in millimetres.
class DepthScale {
  public:
    /// `bits` of the source's levels; kRealBits: real numbers. The range's ends must differ.
    DepthScale(const DepthMeaning& meaning, int bits);

    /// Levels as in the file; the highest one of these bits is the nearest. Real numbers count as
    /// levels of 8 bits, without clamping.
    [[nodiscard]] static DepthScale as_recorded(int bits);

    /// The level of a depth image. NaN for no data: not finite, or a no-data level of the meaning.
    /// A disparity not above 0 is the farthest level.
    [[nodiscard]] float operator()(double level) const;

    [[nodiscard]] double highest_level() const noexcept { return highest_; }
    /// Whether every level of the source is data.
    [[nodiscard]] bool is_always_data() const noexcept { return always_data_; }
    /// Nothing if levels are as recorded.
    [[nodiscard]] std::optional<DepthMeaning> meaning() const {
        return as_recorded_ ? std::nullopt : std::optional(meaning_);
    }

    /// The depth image of a picture of 1 to 4 channels of 8 or 16 bits, or real numbers. `used`: an
    /// image whose memory it takes. `level_of_code`: the picture holds codes of 8 bits in one
    /// channel, which stand for these levels; null: it holds levels.
    [[nodiscard]] DepthImage image_of(const cv::Mat& picture, DepthImage used = {},
                                      const std::vector<float>* level_of_code = nullptr) const;
    /// The picture's distances from the camera [mm], CV_32FC1, also beyond the range; NaN for no
    /// data. The meaning must be metric.
    [[nodiscard]] cv::Mat distances_mm(const cv::Mat& picture) const;

  private:
    [[nodiscard]] bool is_no_data(double level) const;
    void map_row(const float* numbers, int count, float* out) const;

    DepthMeaning meaning_;
    double highest_;
    double far_;      ///< the farthest value, linear in elevation
    double per_one_;  ///< nearness for each 1 of that linear value
    bool always_data_;
    bool as_recorded_{false};        ///< then real numbers are not clamped to the range
    std::vector<float> of_level_{};  ///< result for every integer level; empty: real numbers
};

}  // namespace dibhr
