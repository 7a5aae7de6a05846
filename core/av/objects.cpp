// How libav's objects are made and freed.
#include "core/av/objects.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
#include <libavutil/error.h>
#include <libavutil/frame.h>
#include <libavutil/mem.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <new>
#include <system_error>

#include "core/error.hpp"
#include "core/files/write_failure.hpp"

namespace dibhr {

void AvFree::operator()(AVCodecContext* codec) const noexcept {
    avcodec_free_context(&codec);
}

void AvFree::operator()(AVCodecParameters* coded) const noexcept {
    avcodec_parameters_free(&coded);
}

void AvFree::operator()(AVFormatContext* format) const noexcept {
    if (format->oformat == nullptr) {
        avformat_close_input(&format);
        return;
    }
    if ((format->flags & AVFMT_FLAG_CUSTOM_IO) == 0) avio_closep(&format->pb);
    avformat_free_context(format);
}

void AvFree::operator()(AVFrame* frame) const noexcept {
    av_frame_free(&frame);
}

void AvFree::operator()(AVIOContext* bytes) const noexcept {
    av_freep(&bytes->buffer);
    avio_context_free(&bytes);
}

void AvFree::operator()(AVPacket* packet) const noexcept {
    av_packet_free(&packet);
}

void AvFree::operator()(SwsContext* scaler) const noexcept {
    sws_freeContext(scaler);
}

AvOwned<AVFrame> new_frame() {
    AvOwned<AVFrame> frame(av_frame_alloc());
    if (!frame) throw std::bad_alloc();
    return frame;
}

AvOwned<AVPacket> new_packet() {
    AvOwned<AVPacket> packet(av_packet_alloc());
    if (!packet) throw std::bad_alloc();
    return packet;
}

void allocate_buffer(AVFrame& frame, int pixel_format, int columns, int rows) {
    if (frame.width == columns && frame.height == rows) return;
    av_frame_unref(&frame);
    frame.format = pixel_format;
    frame.width = columns;
    frame.height = rows;
    if (av_frame_get_buffer(&frame, 0) < 0) throw std::bad_alloc();
}

AvOptions::~AvOptions() {
    for (AVDictionary*& dictionary : dictionaries_) av_dict_free(&dictionary);
}

void AvOptions::set(const std::string& key, const std::string& value) {
    for (AVDictionary*& dictionary : dictionaries_)
        av_dict_set(&dictionary, key.c_str(), value.c_str(), 0);
}

std::string url_of(const std::filesystem::path& file) {
    std::error_code gone;
    return "file:" + std::filesystem::absolute(file, gone).string();
}

std::string reason_of(int error) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> words{};
    av_strerror(error, words.data(), words.size());
    return words.data();
}

void require_written(int result, const std::string& subject) {
    if (result < 0)
        throw InputError(subject + "cannot be written (" + reason_of(result) + "); " +
                         step_after_failed_writing(AVUNERROR(result)));
}

}  // namespace dibhr
