// libav's Matroska writer, and its encoder of levels.
#include "core/clip/live_file.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
#include <libavutil/frame.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
}

#include <new>

#include "core/clip/av_file.hpp"
#include "core/error.hpp"

namespace dibhr {

LiveFile::LiveFile(const std::filesystem::path& file, const AVCodecContext& codec,
                   const std::map<std::string, std::string>& tags)
    : format_(new_file(file, "matroska"), close_and_free) {
    AVStream* const stream = avformat_new_stream(format_.get(), nullptr);
    if (stream == nullptr || avcodec_parameters_from_context(stream->codecpar, &codec) < 0)
        throw std::bad_alloc();
    stream->time_base = {1, kClipTimeBase};
    for (const auto& [key, value] : tags)
        av_dict_set(&stream->metadata, key.c_str(), value.c_str(), 0);
    format_->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    int result = avio_open(&format_->pb, format_->url, AVIO_FLAG_WRITE);
    if (result >= 0) result = avformat_write_header(format_.get(), nullptr);
    require_written(result);
}

void LiveFile::write(AVPacket& packet) {
    packet.stream_index = 0;
    packet.pos = -1;
    av_packet_rescale_ts(&packet, {1, kClipTimeBase}, format_->streams[0]->time_base);
    require_written(av_write_frame(format_.get(), &packet));
}

void LiveFile::finish() {
    require_written(av_write_trailer(format_.get()));
    require_written(avio_closep(&format_->pb));
}

void LevelsEncoder::Free::operator()(AVCodecContext* codec) const {
    avcodec_free_context(&codec);
}
void LevelsEncoder::Free::operator()(AVFrame* frame) const {
    av_frame_free(&frame);
}
void LevelsEncoder::Free::operator()(AVPacket* packet) const {
    av_packet_free(&packet);
}

LevelsEncoder::LevelsEncoder(const LiveLevels& first)
    : codec_(avcodec_alloc_context3(avcodec_find_encoder(AV_CODEC_ID_FFVHUFF))),
      frame_(av_frame_alloc()),
      packet_(av_packet_alloc()) {
    if (!codec_ || !frame_ || !packet_) throw std::bad_alloc();
    codec_->width = first.columns;
    codec_->height = first.rows;
    codec_->pix_fmt = first.bytes == 2 ? AV_PIX_FMT_GRAY16 : AV_PIX_FMT_GRAY8;
    codec_->time_base = {1, kClipTimeBase};
    codec_->thread_count = 1;
    codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    av_opt_set(codec_->priv_data, "pred", "plane", 0);
    if (first.bytes == 0 || avcodec_open2(codec_.get(), codec_->codec, nullptr) < 0)
        throw InputError(
            "this live depth is of real numbers, or of a size that no video has, and cannot be "
            "recorded");
    frame_->format = codec_->pix_fmt;
    frame_->width = first.columns;
    frame_->height = first.rows;
    if (av_frame_get_buffer(frame_.get(), 0) < 0) throw std::bad_alloc();
}

LevelsEncoder::~LevelsEncoder() = default;

void LevelsEncoder::encode(const LiveLevels& picture, std::int64_t shown_ms,
                           const PictureEncoder::Sink& sink) {
    if (av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
    const int row = picture.columns * picture.bytes;
    av_image_copy_plane(frame_->data[0], frame_->linesize[0], picture.levels.data(), row, row,
                        picture.rows);
    frame_->pts = shown_ms;
    int result = avcodec_send_frame(codec_.get(), frame_.get());
    while (result >= 0) {
        result = avcodec_receive_packet(codec_.get(), packet_.get());
        if (result < 0) break;
        sink(*packet_);
        av_packet_unref(packet_.get());
    }
    if (result != AVERROR(EAGAIN)) throw InputError("libav cannot encode another depth picture");
}

}  // namespace dibhr
