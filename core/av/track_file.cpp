// Packets to a file by libavformat.
#include "core/av/track_file.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
}

#include <new>

#include "core/av/track_encoder.hpp"

namespace dibhr {

namespace {

AvOwned<AVFormatContext> new_file(const std::filesystem::path& file, const char* format) {
    AVFormatContext* context = nullptr;
    avformat_alloc_output_context2(&context, nullptr, format, url_of(file).c_str());
    if (context == nullptr) throw std::bad_alloc();
    return AvOwned<AVFormatContext>(context);
}

}  // namespace

TrackFile::TrackFile(const std::filesystem::path& file, const AVCodecParameters& coded,
                     const TrackFileForm& form)
    : format_(new_file(file, form.format)), subject_(form.subject) {
    AVStream* const stream = avformat_new_stream(format_.get(), nullptr);
    if (stream == nullptr || avcodec_parameters_copy(stream->codecpar, &coded) < 0)
        throw std::bad_alloc();
    stream->codecpar->codec_tag = 0;  // the format's own
    stream->time_base = {1, kTrackUnitsPerSecond};
    stream->sample_aspect_ratio = coded.sample_aspect_ratio;
    for (const auto& [key, value] : form.tags)
        av_dict_set(&stream->metadata, key.c_str(), value.c_str(), 0);
    format_->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    if (form.bytes != nullptr) {
        format_->flags |= AVFMT_FLAG_CUSTOM_IO;
        format_->pb = form.bytes;
    } else {
        require_written(avio_open(&format_->pb, format_->url, AVIO_FLAG_WRITE), subject_);
    }
    AvOptions options;
    for (const auto& [key, value] : form.options) options.set(key, value);
    require_written(avformat_write_header(format_.get(), options.data()), subject_);
    head_bytes_ = avio_tell(format_->pb);
}

void TrackFile::write(AVPacket& packet) {
    packet.stream_index = 0;
    packet.pos = -1;
    av_packet_rescale_ts(&packet, {1, kTrackUnitsPerSecond}, format_->streams[0]->time_base);
    require_written(av_write_frame(format_.get(), &packet), subject_);
}

void TrackFile::finish() {
    require_written(av_write_trailer(format_.get()), subject_);
    if ((format_->flags & AVFMT_FLAG_CUSTOM_IO) == 0)
        require_written(avio_closep(&format_->pb), subject_);
}

bool TrackFile::holds_packets() const noexcept {
    return avio_tell(format_->pb) > head_bytes_;
}

}  // namespace dibhr
