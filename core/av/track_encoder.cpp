// Frames to packets by libavcodec.
#include "core/av/track_encoder.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/error.h>
#include <libavutil/frame.h>
}

#include <new>
#include <utility>

namespace dibhr {

AvOwned<AVCodecContext> new_encoder(const AVCodec* encoder, int columns, int rows,
                                    int pixel_format) {
    AvOwned<AVCodecContext> codec(avcodec_alloc_context3(encoder));
    if (!codec) throw std::bad_alloc();
    codec->width = columns;
    codec->height = rows;
    codec->pix_fmt = static_cast<AVPixelFormat>(pixel_format);
    codec->time_base = {1, kTrackUnitsPerSecond};
    codec->thread_count = 1;
    codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    return codec;
}

TrackEncoder::TrackEncoder(AvOwned<AVCodecContext> opened) : codec_(std::move(opened)) {
    allocate_buffer(*frame_, codec_->pix_fmt, codec_->width, codec_->height);
    frame_->color_range = codec_->color_range;
}

AvOwned<AVCodecParameters> TrackEncoder::coded() const {
    AvOwned<AVCodecParameters> coded(avcodec_parameters_alloc());
    if (!coded || avcodec_parameters_from_context(coded.get(), codec_.get()) < 0)
        throw std::bad_alloc();
    return coded;
}

AVFrame& TrackEncoder::frame() {
    if (av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
    return *frame_;
}

int TrackEncoder::encode(std::int64_t shown_ms, const Sink& sink) {
    frame_->pts = shown_ms;
    return send(frame_.get(), sink);
}

int TrackEncoder::flush(const Sink& sink) {
    const int result = send(nullptr, sink);
    return result == AVERROR_EOF ? 0 : result;  // nothing was kept back
}

int TrackEncoder::send(const AVFrame* frame, const Sink& sink) {
    int result = avcodec_send_frame(codec_.get(), frame);
    if (result < 0) return result;
    while ((result = avcodec_receive_packet(codec_.get(), packet_.get())) == 0) {
        sink(*packet_);
        av_packet_unref(packet_.get());
    }
    return result == AVERROR(EAGAIN) || result == AVERROR_EOF ? 0 : result;
}

}  // namespace dibhr
