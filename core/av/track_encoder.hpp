// The one encode loop: the pictures of a video track in, its packets out.
#pragma once

#include <cstdint>
#include <functional>

#include "core/av/objects.hpp"

struct AVCodec;

namespace dibhr {

/// The time unit of pictures and packets in every track that is written.
inline constexpr int kTrackUnitsPerSecond = 1000;

/// An encoder for pictures of that AVPixelFormat, on the calling thread alone, for files that store
/// the codec's header separately. Not opened: the caller sets the codec's own options and opens it.
/// Throws std::bad_alloc.
[[nodiscard]] AvOwned<AVCodecContext> new_encoder(const AVCodec* encoder, int columns, int rows,
                                                  int pixel_format);

class TrackEncoder {
  public:
    /// Called with each packet, whose content it may take.
    using Sink = std::function<void(AVPacket&)>;

    /// Takes an opened codec. Throws std::bad_alloc.
    explicit TrackEncoder(AvOwned<AVCodecContext> opened);

    /// The codec parameters that a file stores. Throws std::bad_alloc.
    [[nodiscard]] AvOwned<AVCodecParameters> coded() const;
    /// The picture that is encoded next, for the caller to fill: of the codec's size and pixel
    /// format. Throws std::bad_alloc.
    [[nodiscard]] AVFrame& frame();

    /// `shown_ms` is later than that of the picture before. libav's result: negative when it fails.
    [[nodiscard]] int encode(std::int64_t shown_ms, const Sink& sink);
    /// Gives the packets that the codec kept back, once, after the last picture. libav's result.
    [[nodiscard]] int flush(const Sink& sink);

  private:
    int send(const AVFrame* frame, const Sink& sink);

    AvOwned<AVCodecContext> codec_;
    AvOwned<AVFrame> frame_{new_frame()};
    AvOwned<AVPacket> packet_{new_packet()};
};

}  // namespace dibhr
