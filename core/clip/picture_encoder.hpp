// Pictures in, packets of a video out: H.264 where libav can write it, else MPEG-4.
#pragma once

#include <cstdint>

#include "core/av/track_encoder.hpp"

namespace dibhr {

struct ColourImage;

class PictureEncoder {
  public:
    /// Of a video of columns x rows, 2 or more, cut to even numbers.
    /// Throws InputError when libav has no encoder that takes it.
    PictureEncoder(int columns, int rows);

    /// A picture of another size is scaled into the video's, between black borders where it has
    /// another shape; one of less than 2 pixels a side, as of a window made that small, is left
    /// out. `shown_ms` is later than that of the picture before. Throws InputError.
    void encode(const ColourImage& picture, std::int64_t shown_ms, const TrackEncoder::Sink& sink);
    /// Gives what is still on its way; nothing may be encoded afterwards. Throws InputError.
    void drain(const TrackEncoder::Sink& sink);

    /// What a file has to know of the packets.
    [[nodiscard]] AvOwned<AVCodecParameters> coded() const { return encoder_.coded(); }

  private:
    const AVFrame& copied(const ColourImage& picture);
    const AVFrame& scaled(const AVFrame& from, int columns, int rows);
    void place(const ColourImage& picture);

    TrackEncoder encoder_;
    AvOwned<AVFrame> picture_{new_frame()};  // as it came, cut to even numbers
    AvOwned<AVFrame> scaled_{new_frame()};   // as it is placed
    AvOwned<SwsContext> scaler_{};
};

}  // namespace dibhr
