// Converts libav's decoded frames to OpenCV pictures without losing levels; inside the room.
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/av/objects.hpp"

struct AVStream;

namespace dibhr {

/// Bits of a level; the highest level is 2^bits - 1.
[[nodiscard]] int bits_of(const AVFrame& frame) noexcept;
/// Of the memory that it refers to.
[[nodiscard]] std::size_t bytes_of(const AVFrame& frame) noexcept;
/// Whether it is coded as floating-point numbers, which have no levels.
[[nodiscard]] bool holds_floats(const AVFrame& frame) noexcept;
/// Whether it is coded without colours.
[[nodiscard]] bool is_grey(const AVFrame& frame) noexcept;
/// Width of a shown pixel divided by its height; 1 where not stated, or impossible.
[[nodiscard]] double pixel_aspect(const AVFrame& frame, const AVStream& stream) noexcept;
/// The usual name of the codec with that AVCodecID.
[[nodiscard]] std::string name_of_codec(int id);

/// Rotated clockwise.
[[nodiscard]] cv::Mat turned(const cv::Mat& picture, int quarter_turns);

/// A frame's levels, or codes that stand for them.
struct CodedLevels {
    cv::Mat picture{};
    /// The levels of 8-bit codes of a limited ("TV") range, stretched to the full one without
    /// rounding; null: the picture holds levels.
    std::shared_ptr<const std::vector<float>> level_of_code{};
};

/// Converts the frames of one track.
class FramePictures {
  public:
    /// 8 bits: blue, green, red. Empty when it cannot be converted.
    [[nodiscard]] cv::Mat colour(const AVFrame& frame);
    /// Every coded level. Of grey pictures, and of the luma of others, one channel of 8 or 16 bits,
    /// or float where a limited ("TV") range is stretched to the full one without rounding. Of
    /// pictures coded in red, green and blue these three, blue first, of 8 or 16 bits, and of 8
    /// bits also alpha where it is coded. Empty when it cannot be converted.
    [[nodiscard]] cv::Mat levels(const AVFrame& frame);
    /// The same, but codes of 8 bits of a limited range are not stretched.
    [[nodiscard]] CodedLevels coded_levels(const AVFrame& frame);

  private:
    [[nodiscard]] cv::Mat converted(const AVFrame& frame, int pixel_format, int type);

    AvOwned<SwsContext> scaler_{};
    std::optional<bool> limited_{};  // whether levels have a limited range; by the first picture
    std::shared_ptr<const std::vector<float>> level_of_code_{};  // of such 8-bit codes
};

}  // namespace dibhr
