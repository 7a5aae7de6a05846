// Encodes pictures to packets of a video: H.264 where libav can write it, else MPEG-4.
#pragma once

#include <cstdint>

#include "core/av/track_encoder.hpp"

namespace dibhr {

struct ColourImage;

class PictureEncoder {
  public:
    /// For a video of columns x rows, at least 2 each, reduced to even numbers.
    /// Throws InputError when libav has no encoder for that size.
    PictureEncoder(int columns, int rows);

    /// Scales a picture of another size into the video's, with black borders where the shape
    /// differs; drops one of less than 2 pixels a side, as of a tiny window. `shown_ms` must be
    /// later than that of the picture before. Throws InputError.
    void encode(const ColourImage& picture, std::int64_t shown_ms, const TrackEncoder::Sink& sink);
    /// Gives the remaining packets; no encode() afterwards. Throws InputError.
    void drain(const TrackEncoder::Sink& sink);

    /// The parameters of the packets that a file needs.
    [[nodiscard]] AvOwned<AVCodecParameters> coded() const { return encoder_.coded(); }

  private:
    const AVFrame& copied(const ColourImage& picture);
    const AVFrame& scaled(const AVFrame& from, int columns, int rows);
    void place(const ColourImage& picture);

    TrackEncoder encoder_;
    AvOwned<AVFrame> picture_{new_frame()};  // unscaled, cropped to even numbers
    AvOwned<AVFrame> scaled_{new_frame()};   // scaled to its place in the video
    AvOwned<SwsContext> scaler_{};
};

}  // namespace dibhr
