// libav's MP4 writer.
#include "core/clip/mp4_file.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
}

#include <algorithm>
#include <new>
#include <utility>

#include "core/clip/av_file.hpp"
#include "core/clip/picture_encoder.hpp"
#include "core/error.hpp"
#include "core/video/video_packets.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kPiece_us = 1'000'000;  // what is lost when the program dies

}  // namespace

struct Mp4File::Held {
    AVPacket* packet{av_packet_alloc()};
    bool filled{false};

    Held() {
        if (packet == nullptr) throw std::bad_alloc();
    }
    ~Held() { av_packet_free(&packet); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
};

Mp4File::Mp4File(const fs::path& file, const AVCodecParameters& coded, Mp4Index index)
    : format_(new_file(file, "mp4"), close_and_free), held_(std::make_unique<Held>()) {
    AVStream* const stream = avformat_new_stream(format_.get(), nullptr);
    if (stream == nullptr || avcodec_parameters_copy(stream->codecpar, &coded) < 0)
        throw std::bad_alloc();
    stream->codecpar->codec_tag = 0;  // the format's own
    stream->time_base = {1, kClipTimeBase};
    format_->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    AVDictionary* options = nullptr;
    av_dict_set(
        &options, "movflags",
        index == Mp4Index::at_begin ? "faststart" : "frag_keyframe+empty_moov+default_base_moof",
        0);
    if (index == Mp4Index::in_pieces) av_dict_set_int(&options, "frag_duration", kPiece_us, 0);
    int result = avio_open(&format_->pb, format_->url, AVIO_FLAG_WRITE);
    if (result >= 0) result = avformat_write_header(format_.get(), &options);
    av_dict_free(&options);
    require_written(result);
    head_bytes_ = avio_tell(format_->pb);
}

Mp4File::~Mp4File() = default;

bool Mp4File::plays() const noexcept {
    return avio_tell(format_->pb) > head_bytes_;
}

void Mp4File::write(AVPacket& packet) {
    write_held(packet.dts);
    av_packet_move_ref(held_->packet, &packet);
    held_->filled = true;
}

void Mp4File::write_held(std::int64_t until_ms) {
    if (!std::exchange(held_->filled, false)) return;
    AVPacket& packet = *held_->packet;
    packet.duration = until_ms - packet.dts;
    packet.stream_index = 0;
    packet.pos = -1;
    av_packet_rescale_ts(&packet, {1, kClipTimeBase}, format_->streams[0]->time_base);
    require_written(av_write_frame(format_.get(), &packet));
    av_packet_unref(&packet);
}

void Mp4File::finish(std::int64_t end_ms) {
    write_held(end_ms);
    require_written(av_write_trailer(format_.get()));
    require_written(avio_closep(&format_->pb));
}

void copy_with_index_at_begin(const fs::path& from, const fs::path& to, std::int64_t last_ms,
                              std::int64_t end_ms) {
    VideoPackets packets(from);
    if (!packets.is_open()) throw InputError("cannot be read again");
    const AVStream& stream = *packets.stream();
    Mp4File copy(to, *stream.codecpar, Mp4Index::at_begin);
    std::int64_t latest_ms = -1;
    while (AVPacket* const packet = packets.next()) {
        av_packet_rescale_ts(packet, stream.time_base, {1, kClipTimeBase});
        latest_ms = std::max(latest_ms, packet->pts);
        copy.write(*packet);
    }
    if (latest_ms != last_ms) throw InputError("cannot be read again to its end");
    copy.finish(end_ms);
}

}  // namespace dibhr
