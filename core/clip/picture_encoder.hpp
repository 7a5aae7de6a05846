// Pictures in, packets of a video out: H.264 where libav can write it, else MPEG-4.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

struct AVCodecContext;
struct AVFrame;
struct AVPacket;
struct SwsContext;

namespace dibhr {

struct ColourImage;

/// Times of pictures and packets are in units of 1/kClipTimeBase s.
inline constexpr int kClipTimeBase = 1000;

class PictureEncoder {
  public:
    /// Called with each packet, whose content it may take.
    using Sink = std::function<void(AVPacket&)>;

    /// Of a video of columns x rows, 2 or more, cut to even numbers.
    /// Throws InputError when libav has no encoder that takes it.
    PictureEncoder(int columns, int rows);
    ~PictureEncoder();
    PictureEncoder(const PictureEncoder&) = delete;
    PictureEncoder& operator=(const PictureEncoder&) = delete;

    /// A picture of another size is scaled into the video's, between black borders where it has
    /// another shape; one of less than 2 pixels a side, as of a window made that small, is left
    /// out. `shown_ms` is later than that of the picture before. Throws InputError.
    void encode(const ColourImage& picture, std::int64_t shown_ms, const Sink& sink);
    /// Gives what is still on its way; nothing may be encoded afterwards.
    void drain(const Sink& sink);

    [[nodiscard]] const AVCodecContext& codec() const { return *codec_; }

  private:
    const AVFrame& copied(const ColourImage& picture);
    const AVFrame& scaled(const AVFrame& from, int columns, int rows);
    void place(const ColourImage& picture);
    void take_packets(const Sink& sink);

    // As libav frees them.
    struct Free {
        void operator()(AVCodecContext* codec) const;
        void operator()(AVFrame* frame) const;
        void operator()(AVPacket* packet) const;
        void operator()(SwsContext* scaler) const;
    };
    std::unique_ptr<AVCodecContext, Free> codec_;
    std::unique_ptr<AVFrame, Free> picture_;  // as it came, cut to even numbers
    std::unique_ptr<AVFrame, Free> scaled_;   // as it is placed
    std::unique_ptr<AVFrame, Free> frame_;    // as it is encoded
    std::unique_ptr<AVPacket, Free> packet_;
    std::unique_ptr<SwsContext, Free> scaler_{};
};

}  // namespace dibhr
