// libav's FFV1 encoder and Matroska writer.
#include "core/estimate/depth_video.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libavutil/imgutils.h>
#include <libavutil/rational.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kUnitsPerSecond = 1000;  // Matroska's own

void require_done(int result) {
    if (result >= 0) return;
    std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
    av_strerror(result, reason.data(), reason.size());
    throw InputError("the depth video cannot be written (" + std::string(reason.data()) +
                     "); choose another folder or make room for it");
}

AVFormatContext* new_matroska(const fs::path& file) {
    AVFormatContext* format = nullptr;
    std::error_code gone;
    const std::string url = "file:" + fs::absolute(file, gone).string();
    avformat_alloc_output_context2(&format, nullptr, "matroska", url.c_str());
    if (format == nullptr) throw std::bad_alloc();
    return format;
}

AVCodecContext* new_codec(const DepthVideoShape& shape) {
    const AVCodec* const encoder = avcodec_find_encoder(AV_CODEC_ID_FFV1);
    if (encoder == nullptr)
        throw InputError(
            "no depth video can be made: this libavcodec has no FFV1 encoder; install the "
            "distribution's full libavcodec");
    AVCodecContext* codec = avcodec_alloc_context3(encoder);
    if (codec == nullptr) throw std::bad_alloc();
    constexpr int kFinest = 1 << 16;
    codec->width = shape.columns;
    codec->height = shape.rows;
    codec->sample_aspect_ratio = av_d2q(shape.pixel_aspect, kFinest);
    codec->pix_fmt = shape.bits == 8 ? AV_PIX_FMT_GRAY8 : AV_PIX_FMT_GRAY16LE;
    codec->color_range = AVCOL_RANGE_JPEG;
    codec->time_base = {1, kUnitsPerSecond};
    codec->gop_size = 1;  // any frame can be sought
    codec->level = 3;     // with slices, which are decoded side by side, and check sums
    codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    return codec;
}

}  // namespace

void DepthVideo::Free::operator()(AVCodecContext* codec) const {
    avcodec_free_context(&codec);
}

void DepthVideo::Free::operator()(AVFormatContext* format) const {
    avio_closep(&format->pb);
    avformat_free_context(format);
}

void DepthVideo::Free::operator()(AVFrame* frame) const {
    av_frame_free(&frame);
}

void DepthVideo::Free::operator()(AVPacket* packet) const {
    av_packet_free(&packet);
}

DepthVideo::DepthVideo(const fs::path& file, const DepthVideoShape& shape)
    : format_(new_matroska(file)),
      codec_(new_codec(shape)),
      frame_(av_frame_alloc()),
      packet_(av_packet_alloc()) {
    if (!frame_ || !packet_) throw std::bad_alloc();
    require_done(avcodec_open2(codec_.get(), nullptr, nullptr));
    frame_->format = codec_->pix_fmt;
    frame_->width = shape.columns;
    frame_->height = shape.rows;
    frame_->color_range = codec_->color_range;
    if (av_frame_get_buffer(frame_.get(), 0) < 0) throw std::bad_alloc();
    AVStream* const stream = avformat_new_stream(format_.get(), nullptr);
    if (stream == nullptr || avcodec_parameters_from_context(stream->codecpar, codec_.get()) < 0)
        throw std::bad_alloc();
    stream->time_base = codec_->time_base;
    stream->sample_aspect_ratio = codec_->sample_aspect_ratio;
    require_done(avio_open(&format_->pb, format_->url, AVIO_FLAG_WRITE));
    require_done(avformat_write_header(format_.get(), nullptr));
}

DepthVideo::~DepthVideo() = default;

void DepthVideo::add(const cv::Mat& levels, double shown_s, double interval_s) {
    if (av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
    av_image_copy_plane(frame_->data[0], frame_->linesize[0], levels.data,
                        static_cast<int>(levels.step),
                        static_cast<int>(levels.elemSize()) * levels.cols, levels.rows);
    frame_->pts = std::llround(shown_s * kUnitsPerSecond);
    interval_ms_ = std::max<std::int64_t>(std::llround(interval_s * kUnitsPerSecond), 1);
    require_done(avcodec_send_frame(codec_.get(), frame_.get()));
    take_packets();
}

void DepthVideo::take_packets() {
    int got = 0;
    while ((got = avcodec_receive_packet(codec_.get(), packet_.get())) == 0) {
        packet_->duration = interval_ms_;
        packet_->stream_index = 0;
        av_packet_rescale_ts(packet_.get(), codec_->time_base, format_->streams[0]->time_base);
        require_done(av_write_frame(format_.get(), packet_.get()));
        av_packet_unref(packet_.get());
    }
    if (got != AVERROR(EAGAIN) && got != AVERROR_EOF) require_done(got);
}

void DepthVideo::finish() {
    require_done(avcodec_send_frame(codec_.get(), nullptr));
    take_packets();
    require_done(av_write_trailer(format_.get()));
    require_done(avio_closep(&format_->pb));
}

}  // namespace dibhr
