// libav's decoded frames as OpenCV's pictures, with all the levels that they hold; inside the room.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/av/objects.hpp"

struct AVStream;

namespace dibhr {

/// Of a level, of which the highest is 2^bits - 1.
[[nodiscard]] int bits_of(const AVFrame& frame) noexcept;
/// Coded as floating-point numbers, which have no levels.
[[nodiscard]] bool holds_floats(const AVFrame& frame) noexcept;
/// Coded without colours.
[[nodiscard]] bool is_grey(const AVFrame& frame) noexcept;
/// How many times as wide as high a pixel is to be shown; 1 where nobody says, or nothing that can
/// be.
[[nodiscard]] double pixel_aspect(const AVFrame& frame, const AVStream& stream) noexcept;
/// What people call a codec of that AVCodecID.
[[nodiscard]] std::string name_of_codec(int id);

/// Of the frames of one track.
class FramePictures {
  public:
    /// 8 bits: blue, green, red. Empty when it cannot be converted.
    [[nodiscard]] cv::Mat colour(const AVFrame& frame);
    /// Every level that was coded: of a grey picture, or of the luma of another, one channel of 8
    /// or 16 bits, or float where a limited ("TV") range is stretched to the whole one, which
    /// rounds nothing. Of pictures coded in red, green and blue those, blue first, of 8 or 16
    /// bits. Empty when it cannot be converted.
    [[nodiscard]] cv::Mat levels(const AVFrame& frame);

  private:
    [[nodiscard]] cv::Mat converted(const AVFrame& frame, int pixel_format, int type);

    AvOwned<SwsContext> scaler_{};
    std::optional<bool> limited_{};  // the range of the track's levels, told by the first picture
};

}  // namespace dibhr
