// One video track through libav: its pictures in order of presentation time, with all the levels
// that they hold; inside the room.
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/video/video_packets.hpp"

struct AVCodecContext;
struct AVFrame;
struct SwsContext;

namespace dibhr {

/// Pictures come turned as the file says.
class VideoDecoder {
  public:
    /// Decodes nothing yet. Throws InputError: cut off, of an unknown kind, no video.
    VideoDecoder(const std::filesystem::path& file, int track);

    [[nodiscard]] const VideoPackets& packets() const noexcept { return packets_; }
    /// The name of the codec; as the container writes it, where that does.
    [[nodiscard]] std::string codec() const;

    /// The next picture; false at the end. Packets that cannot be decoded are passed over.
    bool decode();
    /// To the key frame at or before the time [s], which decode() then gives; false where the file
    /// cannot jump.
    bool jump(double time_s);

    // Of the decoded picture.

    /// From the track's beginning [s]; NaN when the file does not say.
    [[nodiscard]] double time_s() const noexcept;
    /// 8 bits: blue, green, red. Empty when it cannot be converted.
    [[nodiscard]] cv::Mat colour();
    /// Every level that was coded: of a grey picture, or of the luma of another, one channel of 8
    /// or 16 bits, or float where a limited ("TV") range is stretched to the whole one, which
    /// rounds nothing. Of pictures coded in red, green and blue those, blue first, of 8 or 16
    /// bits. Empty when it cannot be converted.
    [[nodiscard]] cv::Mat levels();
    /// Of a level, of which the highest is 2^bits - 1.
    [[nodiscard]] int bits() const noexcept;
    /// Coded as floating-point numbers, which have no levels.
    [[nodiscard]] bool has_floats() const noexcept;
    /// How many times as wide as high a pixel is to be shown, of colour() and levels(); 1 where the
    /// file does not say, or nothing that can be.
    [[nodiscard]] double pixel_aspect() const noexcept;
    /// Coded without colours.
    [[nodiscard]] bool is_grey() const noexcept;

  private:
    struct Closer {
        void operator()(AVCodecContext* context) const noexcept;
        void operator()(AVFrame* frame) const noexcept;
        void operator()(SwsContext* scaler) const noexcept;
    };

    [[nodiscard]] cv::Mat converted(int pixel_format, int type);
    [[nodiscard]] cv::Mat turned(cv::Mat picture) const;

    VideoPackets packets_;
    std::unique_ptr<AVCodecContext, Closer> decoder_{};
    std::unique_ptr<AVFrame, Closer> frame_;
    std::unique_ptr<SwsContext, Closer> scaler_{};
    int quarter_turns_{0};  // clockwise
    bool drained_{false};
    std::optional<bool> limited_{};  // the range of the track's levels, told by the first picture
};

}  // namespace dibhr
