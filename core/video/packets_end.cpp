// Where a video ends, from its packets.
#include "core/video/packets_end.hpp"

extern "C" {
#include <libavcodec/packet.h>
#include <libavformat/avformat.h>
#include <libavutil/avutil.h>
#include <libavutil/rational.h>
}

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <system_error>

namespace dibhr {

namespace {

constexpr int kMostPackets = 30000;  ///< looked through for the end: a quarter of an hour at 30 Hz

struct ContextCloser {
    void operator()(AVFormatContext* context) const noexcept { avformat_close_input(&context); }
};
struct PacketCloser {
    void operator()(AVPacket* packet) const noexcept { av_packet_free(&packet); }
};

/// The packets of a file's first video stream.
class VideoPackets {
  public:
    explicit VideoPackets(const std::filesystem::path& file) {
        // Absolute and with its protocol, so that a colon in a name is no other one.
        std::error_code gone;
        const std::string url = "file:" + std::filesystem::absolute(file, gone).string();
        AVFormatContext* opened = nullptr;
        if (!packet_ || avformat_open_input(&opened, url.c_str(), nullptr, nullptr) != 0) return;
        context_.reset(opened);
        if (avformat_find_stream_info(opened, nullptr) < 0) return;
        for (unsigned k = 0; k < opened->nb_streams; ++k) {
            AVStream* const stream = opened->streams[k];
            const bool first =
                stream_ == nullptr && stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO;
            if (first) stream_ = stream;
            stream->discard = first ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
        }
    }

    [[nodiscard]] bool is_open() const noexcept { return stream_ != nullptr; }

    /// To the key frame at or before the time; false where the file cannot jump.
    bool jump(double time_s) {
        const auto at = std::llround(time_s / av_q2d(stream_->time_base));
        return av_seek_frame(context_.get(), stream_->index, start() + at, AVSEEK_FLAG_BACKWARD) >=
               0;
    }

    /// When the last whole packet from here on ends; negative when there is none, nothing when
    /// there are too many.
    std::optional<double> end_s() {
        double end_s = -1.0;
        for (int read = 0; av_read_frame(context_.get(), packet_.get()) >= 0; ++read) {
            if (read == kMostPackets) return std::nullopt;
            const bool whole = (packet_->flags & AV_PKT_FLAG_CORRUPT) == 0;
            const std::int64_t at = packet_->pts != AV_NOPTS_VALUE ? packet_->pts : packet_->dts;
            if (packet_->stream_index == stream_->index && whole && at != AV_NOPTS_VALUE) {
                end_s = std::max(end_s, static_cast<double>(at - start() + packet_->duration) *
                                            av_q2d(stream_->time_base));
            }
            av_packet_unref(packet_.get());
        }
        return end_s;
    }

  private:
    [[nodiscard]] std::int64_t start() const noexcept {
        return stream_->start_time == AV_NOPTS_VALUE ? 0 : stream_->start_time;
    }

    std::unique_ptr<AVFormatContext, ContextCloser> context_{};
    std::unique_ptr<AVPacket, PacketCloser> packet_{av_packet_alloc()};
    AVStream* stream_{nullptr};  // the context's
};

}  // namespace

std::optional<double> packets_end_s(const std::filesystem::path& file, double from_s) {
    VideoPackets packets(file);
    if (!packets.is_open()) return std::nullopt;
    std::optional<double> end_s;
    if (packets.jump(from_s)) end_s = packets.end_s();
    if (!end_s || *end_s < from_s) {  // or the file cannot jump: look through it
        VideoPackets all(file);
        if (!all.is_open()) return std::nullopt;
        end_s = all.end_s();
    }
    if (end_s && *end_s < 0.0) return std::nullopt;
    return end_s;
}

}  // namespace dibhr
