// Writes MP4 by libav.
#include "core/clip/mp4_file.hpp"

extern "C" {
#include <libavcodec/packet.h>
#include <libavformat/avformat.h>
}

#include <algorithm>
#include <string>
#include <utility>

#include "core/av/track_encoder.hpp"
#include "core/error.hpp"
#include "core/video/formats/video_packets.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kPiece_us = 1'000'000;  // what is lost when the program dies

TrackFileForm form_of(Mp4Index index) {
    if (index == Mp4Index::at_begin)
        return {.format = "mp4", .options = {{"movflags", "faststart"}}};
    return {.format = "mp4",
            .options = {{"movflags", "frag_keyframe+empty_moov+default_base_moof"},
                        {"frag_duration", std::to_string(kPiece_us)}}};
}

}  // namespace

Mp4File::Mp4File(const fs::path& file, const AVCodecParameters& coded, Mp4Index index)
    : file_(file, coded, form_of(index)) {}

void Mp4File::write(AVPacket& packet) {
    write_held(packet.dts);
    av_packet_move_ref(held_.get(), &packet);
    holds_packet_ = true;
}

void Mp4File::write_held(std::int64_t until_ms) {
    if (!std::exchange(holds_packet_, false)) return;
    held_->duration = until_ms - held_->dts;
    file_.write(*held_);
    av_packet_unref(held_.get());
}

void Mp4File::finish(std::int64_t end_ms) {
    write_held(end_ms);
    file_.finish();
}

void copy_with_index_at_begin(const fs::path& from, const fs::path& to, std::int64_t last_ms,
                              std::int64_t end_ms) {
    VideoPackets packets(from);
    if (!packets.is_open()) throw InputError("cannot be read again");
    const AVStream& stream = *packets.stream();
    Mp4File copy(to, *stream.codecpar, Mp4Index::at_begin);
    std::int64_t latest_ms = -1;
    while (AVPacket* const packet = packets.next()) {
        av_packet_rescale_ts(packet, stream.time_base, {1, kTrackUnitsPerSecond});
        latest_ms = std::max(latest_ms, packet->pts);
        copy.write(*packet);
    }
    if (latest_ms != last_ms) throw InputError("cannot be read again to its end");
    copy.finish(end_ms);
}

}  // namespace dibhr
