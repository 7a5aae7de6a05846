// libav's Matroska writer, and its encoder that loses nothing.
#include "core/clip/live_file.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
#include <libavutil/frame.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
}

#include <array>
#include <cstddef>
#include <new>

#include "core/clip/av_file.hpp"
#include "core/error.hpp"

namespace dibhr {

LiveFile::LiveFile(const std::filesystem::path& file, const AVCodecContext& codec,
                   const std::map<std::string, std::string>& tags)
    : file_(file), format_(new_file(file, "matroska"), avformat_free_context) {
    AVStream* const stream = avformat_new_stream(format_.get(), nullptr);
    if (stream == nullptr || avcodec_parameters_from_context(stream->codecpar, &codec) < 0)
        throw std::bad_alloc();
    stream->time_base = {1, kClipTimeBase};
    for (const auto& [key, value] : tags)
        av_dict_set(&stream->metadata, key.c_str(), value.c_str(), 0);
    format_->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    format_->pb = file_.bytes();
    require_written(avformat_write_header(format_.get(), nullptr));
    file_.end_head();
}

void LiveFile::write(AVPacket& packet) {
    packet.stream_index = 0;
    packet.pos = -1;
    av_packet_rescale_ts(&packet, {1, kClipTimeBase}, format_->streams[0]->time_base);
    require_written(av_write_frame(format_.get(), &packet));
}

std::optional<FileContent> LiveFile::finish() {
    require_written(av_write_trailer(format_.get()));
    file_.finish();
    return file_.content();
}

void ExactEncoder::Free::operator()(AVCodecContext* codec) const {
    avcodec_free_context(&codec);
}
void ExactEncoder::Free::operator()(AVFrame* frame) const {
    av_frame_free(&frame);
}
void ExactEncoder::Free::operator()(AVPacket* packet) const {
    av_packet_free(&packet);
}

ExactEncoder::ExactEncoder(const LiveLevels& first) {
    if (first.bytes == 0)
        throw InputError("this live depth is of real numbers, and cannot be recorded");
    open(first.bytes == 2 ? AV_PIX_FMT_GRAY16 : AV_PIX_FMT_GRAY8, first.columns, first.rows,
         "plane");
}

ExactEncoder::ExactEncoder(const ColourImage& first) {
    open(AV_PIX_FMT_GBRP, first.columns, first.rows, "median");
}

ExactEncoder::~ExactEncoder() = default;

void ExactEncoder::open(int pixel_format, int columns, int rows, const char* prediction) {
    codec_.reset(avcodec_alloc_context3(avcodec_find_encoder(AV_CODEC_ID_FFVHUFF)));
    frame_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    if (!codec_ || !frame_ || !packet_) throw std::bad_alloc();
    codec_->width = columns;
    codec_->height = rows;
    codec_->pix_fmt = static_cast<AVPixelFormat>(pixel_format);
    codec_->time_base = {1, kClipTimeBase};
    codec_->thread_count = 1;
    codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    av_opt_set(codec_->priv_data, "pred", prediction, 0);
    if (avcodec_open2(codec_.get(), codec_->codec, nullptr) < 0)
        throw InputError("what is live is of a size that no video has, and cannot be recorded");
    frame_->format = pixel_format;
    frame_->width = columns;
    frame_->height = rows;
    if (av_frame_get_buffer(frame_.get(), 0) < 0) throw std::bad_alloc();
}

/// And that it may be written to.
void ExactEncoder::require_of_size(int columns, int rows) {
    if (columns != frame_->width || rows != frame_->height)
        throw InputError("what is live changed its size: record it again");
    if (av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
}

void ExactEncoder::encode(const LiveLevels& picture, std::int64_t shown_ms,
                          const PictureEncoder::Sink& sink) {
    require_of_size(picture.columns, picture.rows);
    const int row = picture.columns * picture.bytes;
    av_image_copy_plane(frame_->data[0], frame_->linesize[0], picture.levels.data(), row, row,
                        picture.rows);
    send(shown_ms, sink);
}

void ExactEncoder::encode(const ColourImage& picture, std::int64_t shown_ms,
                          const PictureEncoder::Sink& sink) {
    require_of_size(picture.columns, picture.rows);
    constexpr std::array<std::size_t, 3> kOfPlane{1, 2, 0};  // green, blue, red
    const auto columns = static_cast<std::size_t>(picture.columns);
    for (std::size_t plane = 0; plane < kOfPlane.size(); ++plane)
        for (int j = 0; j < picture.rows; ++j) {
            const std::uint8_t* const from =
                picture.rgb.data() + 3 * columns * static_cast<std::size_t>(j) + kOfPlane[plane];
            std::uint8_t* const to =
                frame_->data[plane] + std::ptrdiff_t{frame_->linesize[plane]} * j;
            for (std::size_t i = 0; i < columns; ++i) to[i] = from[3 * i];
        }
    send(shown_ms, sink);
}

void ExactEncoder::send(std::int64_t shown_ms, const PictureEncoder::Sink& sink) {
    frame_->pts = shown_ms;
    int result = avcodec_send_frame(codec_.get(), frame_.get());
    while (result >= 0) {
        result = avcodec_receive_packet(codec_.get(), packet_.get());
        if (result < 0) break;
        sink(*packet_);
        av_packet_unref(packet_.get());
    }
    if (result != AVERROR(EAGAIN)) throw InputError("libav cannot encode another picture");
}

}  // namespace dibhr
