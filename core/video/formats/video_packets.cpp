// Opens a file, and reads and jumps in one of its tracks.
#include "core/video/formats/video_packets.hpp"

extern "C" {
#include <libavcodec/codec_id.h>
#include <libavcodec/packet.h>
#include <libavformat/avformat.h>
#include <libavutil/avutil.h>
#include <libavutil/dict.h>
#include <libavutil/pixdesc.h>
#include <libavutil/rational.h>
}

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

constexpr double kMissing_s = 0.5;     ///< a shorter loss at the end may be rounding,
constexpr double kMissingPart = 0.15;  ///< a smaller part may be a long last frame

constexpr int kMostPackets = 30000;  ///< searched for the end: a quarter of an hour at 30 Hz

bool is_video(const AVStream& stream) noexcept {
    return stream.codecpar->codec_type == AVMEDIA_TYPE_VIDEO &&
           (stream.disposition & AV_DISPOSITION_ATTACHED_PIC) == 0;
}

/// The allowed formats: containers and streams that hold all their data. Formats that name other
/// files or hosts are left out (HLS, DASH, IMF and concat, SDP, rows of pictures, scripts).
constexpr const char* kContainers =
    "matroska,mov,avi,nut,mpegts,mpeg,mpegvideo,flv,asf,ogg,ivf,mxf,yuv4mpegpipe,h264,hevc,av1,obu,"
    "m4v,mjpeg,gif,apng,dv,vc1";

std::vector<AVStream*> video_streams(const AVFormatContext* context) {
    std::vector<AVStream*> found;
    for (unsigned k = 0; context != nullptr && k < context->nb_streams; ++k) {
        if (is_video(*context->streams[k])) found.push_back(context->streams[k]);
    }
    return found;
}

/// Probes the streams by decoding some pictures, none beyond the bound.
bool find_streams(AVFormatContext* context) {
    AvOptions options(context->nb_streams);
    options.set("max_pixels", std::to_string(kMostPixels));
    return avformat_find_stream_info(context, options.data()) >= 0;
}

/// Null when it cannot be opened. Throws InputError when its pictures are beyond the bound.
AvOwned<AVFormatContext> opened(const std::filesystem::path& file) {
    AvOptions options;
    options.set("format_whitelist", kContainers);
    options.set("protocol_whitelist", "file");
    AVFormatContext* context = nullptr;
    if (avformat_open_input(&context, url_of(file).c_str(), nullptr, options.data()) != 0)
        return nullptr;
    AvOwned<AVFormatContext> opened(context);
    for (const AVStream* const stream : video_streams(context)) {
        const AVCodecParameters& claimed = *stream->codecpar;
        if (claimed.width > 0 && claimed.height > 0)
            require_plausible_size(file, claimed.width, claimed.height, 1);
    }
    return find_streams(context) ? std::move(opened) : nullptr;
}

std::string tag_of(const AVStream& stream, const char* name) {
    const AVDictionaryEntry* const entry = av_dict_get(stream.metadata, name, nullptr, 0);
    return entry == nullptr ? std::string() : std::string(entry->value);
}

}  // namespace

VideoPackets::VideoPackets(const std::filesystem::path& file, int track) : context_(opened(file)) {
    const std::vector<AVStream*> streams = video_streams(context_.get());
    for (AVStream* const stream : streams) {
        if (track-- == 0) stream_ = stream;
    }
    only_track_ = streams.size() == 1;
    for (unsigned k = 0; context_ && k < context_->nb_streams; ++k) {
        AVStream* const stream = context_->streams[k];
        stream->discard = stream == stream_ ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
    }
}

double VideoPackets::frames_per_s() const noexcept {
    const double rate = av_q2d(av_guess_frame_rate(context_.get(), stream_, nullptr));
    return rate > 0.0 && rate <= 1000.0 ? rate : 0.0;
}

double VideoPackets::length_s() const noexcept {
    if (context_->duration <= 0) return static_cast<double>(stream_->duration) * unit_s();
    const double duration_s = static_cast<double>(context_->duration) / AV_TIME_BASE;
    // A header's duration counts from 0 of its clock, libav's own from the first picture.
    const bool of_header = context_->duration_estimation_method == AVFMT_DURATION_FROM_STREAM;
    return of_header ? duration_s - static_cast<double>(start()) * unit_s() : duration_s;
}

bool VideoPackets::counts_frames() const noexcept {
    constexpr double kAgree = 0.02;
    const auto count = static_cast<double>(stream_->nb_frames);
    return count > 0.0 &&
           std::abs(length_s() * frames_per_s() - count) <= std::max(2.0, kAgree * count);
}

std::int64_t VideoPackets::frames() const noexcept {
    if (stream_->nb_frames > 0) return stream_->nb_frames;
    const double frames = std::round(length_s() * frames_per_s());
    return frames >= 1.0 && frames < 1e9 ? static_cast<std::int64_t>(frames) : 0;
}

double VideoPackets::start_s() const noexcept {
    // A transport stream begins at any time.
    const bool own_clock = (context_->iformat->flags & AVFMT_TS_DISCONT) != 0;
    if (own_clock) return std::numeric_limits<double>::quiet_NaN();
    // Where decoding begins at 0, the file's time begins there (MP4 without an edit list, or in
    // fragments; FLV; NUT, which has no decoding times): the delay until the first picture, which
    // waits for others to be decoded, does not count.
    const double start_s = static_cast<double>(start()) * unit_s();
    const double waited_for = stream_->codecpar->video_delay;
    const bool begins_at_0 = first_decoded_ == AV_NOPTS_VALUE
                                 ? std::abs(start_s * frames_per_s() - waited_for) < 0.1
                                 : first_decoded_ == 0;
    return only_track_ && begins_at_0 ? 0.0 : start_s;
}

std::string VideoPackets::tag(const char* name) const {
    return tag_of(*stream_, name);
}

std::string VideoPackets::attachment(std::string_view name) const {
    for (unsigned k = 0; k < context_->nb_streams; ++k) {
        const AVStream& stream = *context_->streams[k];
        const AVCodecParameters& held = *stream.codecpar;
        if (held.codec_type != AVMEDIA_TYPE_ATTACHMENT || held.extradata_size <= 0 ||
            tag_of(stream, "filename") != name)
            continue;
        const auto* const begin = reinterpret_cast<const char*>(held.extradata);
        return {begin, static_cast<std::size_t>(held.extradata_size)};
    }
    return {};
}

AVPacket* VideoPackets::next() noexcept {
    av_packet_unref(packet_.get());
    while (av_read_frame(context_.get(), packet_.get()) >= 0) {
        if (packet_->stream_index == stream_->index) {
            if (!first_decoded_) first_decoded_ = packet_->dts;
            return packet_.get();
        }
        av_packet_unref(packet_.get());
    }
    return nullptr;
}

bool VideoPackets::jump(double time_s) noexcept {
    const std::int64_t to = start() + std::llround(time_s / unit_s());
    return av_seek_frame(context_.get(), stream_->index, to, AVSEEK_FLAG_BACKWARD) >= 0;
}

std::optional<double> VideoPackets::key_frame_s(double time_s) const noexcept {
    const std::int64_t to = start() + std::llround(time_s / unit_s());
    const int at = av_index_search_timestamp(stream_, to, AVSEEK_FLAG_BACKWARD);
    const AVIndexEntry* const entry = at < 0 ? nullptr : avformat_index_get_entry(stream_, at);
    if (entry == nullptr) return std::nullopt;
    return seconds(entry->timestamp);
}

double VideoPackets::seconds(std::int64_t stamp) const noexcept {
    if (stamp == AV_NOPTS_VALUE) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(stamp - start()) * unit_s();
}

double VideoPackets::unit_s() const noexcept {
    return av_q2d(stream_->time_base);
}

std::int64_t VideoPackets::start() const noexcept {
    return stream_->start_time == AV_NOPTS_VALUE ? 0 : stream_->start_time;
}

namespace {

/// Whether the packet's picture is shown: an edit list leaves out some, and VP8 has reference
/// pictures that are never shown (RFC 6386, section 9.1: the bit show_frame).
bool shows_picture(const AVPacket& packet, AVCodecID codec) {
    constexpr unsigned kShown = 0x10;
    if ((packet.flags & AV_PKT_FLAG_DISCARD) != 0) return false;
    return codec != AV_CODEC_ID_VP8 || packet.size < 1 || (packet.data[0] & kShown) != 0;
}

/// The end of the following packets; negative without packets, nothing for too many.
std::optional<double> end_of_packets_s(VideoPackets& packets) {
    double end_s = -1.0;
    int read = 0;
    for (const AVPacket* packet = packets.next(); packet != nullptr; packet = packets.next()) {
        if (++read > kMostPackets) return std::nullopt;
        if ((packet->flags & AV_PKT_FLAG_CORRUPT) != 0) continue;
        const std::int64_t at = packet->pts != AV_NOPTS_VALUE ? packet->pts : packet->dts;
        if (at != AV_NOPTS_VALUE) end_s = std::max(end_s, packets.seconds(at + packet->duration));
    }
    return end_s;
}

}  // namespace

std::optional<double> packets_end_s(const std::filesystem::path& file, int track, double from_s) {
    VideoPackets packets(file, track);
    if (!packets.is_open()) return std::nullopt;
    std::optional<double> end_s;
    if (packets.jump(from_s)) end_s = end_of_packets_s(packets);
    if (!end_s || *end_s < from_s) {  // or the file cannot jump: search all of it
        VideoPackets all(file, track);
        if (!all.is_open()) return std::nullopt;
        end_s = end_of_packets_s(all);
    }
    if (end_s && *end_s < 0.0) return std::nullopt;
    return end_s;
}

double least_end_s(double header_duration_s) {
    return header_duration_s - std::max(kMissing_s, kMissingPart * header_duration_s);
}

void require_whole(const std::filesystem::path& file, int track, double header_duration_s) {
    const double least_s = least_end_s(header_duration_s);
    if (!(least_s > 0.0)) return;
    const std::optional<double> end_s = packets_end_s(file, track, least_s);
    if (!end_s || *end_s >= least_s) return;
    throw InputError(shown(file) + " is cut off or has a damaged header: it ends at " +
                     number_text(*end_s, 1) + " s of " + number_text(header_duration_s, 1) +
                     " s; copy or export it again");
}

std::vector<double> packet_times_s(const std::filesystem::path& file, int track) {
    VideoPackets packets(file, track);
    std::vector<double> times_s;
    if (!packets.is_open()) return times_s;
    const AVCodecID codec = packets.stream()->codecpar->codec_id;
    for (const AVPacket* packet = packets.next(); packet != nullptr; packet = packets.next()) {
        if (!shows_picture(*packet, codec)) continue;
        if (std::cmp_equal(times_s.size(), kMostPictures)) return {};
        times_s.push_back(
            packets.seconds(packet->pts != AV_NOPTS_VALUE ? packet->pts : packet->dts));
    }
    return times_s;
}

std::vector<VideoTrack> video_tracks(const std::filesystem::path& file) {
    const AvOwned<AVFormatContext> context = opened(file);
    std::vector<VideoTrack> tracks;
    for (const AVStream* const stream : video_streams(context.get())) {
        VideoTrack track;
        track.title = tag_of(*stream, "title");
        const auto format = static_cast<AVPixelFormat>(stream->codecpar->format);
        if (const AVPixFmtDescriptor* const kind = av_pix_fmt_desc_get(format)) {
            track.bits = kind->comp[0].depth;
            track.grey = kind->nb_components == 1 &&
                         (kind->flags & (AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BITSTREAM)) == 0;
        }
        tracks.push_back(std::move(track));
    }
    return tracks;
}

}  // namespace dibhr
