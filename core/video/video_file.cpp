// A video file as pictures in order of presentation time, with an exact seek.
#include "core/video/video_file.hpp"

extern "C" {
#include <libavcodec/packet.h>
#include <libavformat/avformat.h>
#include <libavutil/avutil.h>
#include <libavutil/rational.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/libraries.hpp"
#include "core/video/media.hpp"

namespace dibhr {

namespace {

constexpr double kNearAhead_s = 1.0;   ///< up to here decoding on is as quick as a jump
constexpr double kMissing_s = 0.5;     ///< less than this at the end is a container's rounding,
constexpr double kMissingPart = 0.15;  ///< and less than this part may be a long last frame
constexpr double kLongest_s = 1e6;     ///< bounds a seek into a file of unknown length

std::string text_of_fourcc(int fourcc) {
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) {
        const char c = static_cast<char>((fourcc >> shift) & 0xff);
        if (c > ' ' && c < 127) text += c;
    }
    return text;
}

/// Matroska and WebM have no four-letter code; they name the codec in their header.
std::string matroska_codec(const std::filesystem::path& file) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kNames{
        {{"V_VP8", "VP8"},
         {"V_VP9", "VP9"},
         {"V_AV1", "AV1"},
         {"V_FFV1", "FFV1"},
         {"V_MPEG4/ISO/AVC", "H.264"},
         {"V_MPEGH/ISO/HEVC", "HEVC"},
         {"V_MJPEG", "MJPEG"},
         {"V_THEORA", "Theora"},
         {"V_PNG", "PNG"}}};
    std::string head(16384, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    for (const auto& [key, name] : kNames)
        if (head.find(key) != std::string::npos) return std::string(name);
    return {};
}

bool is_sixteen_bit_grey(int pixel_format) {
    // 'Y' '1' 0 16 (little endian) and 16 0 '1' 'Y' (big endian), FFmpeg's codes of gray16.
    return pixel_format == 0x10003159 || pixel_format == 0x59310010;
}

bool open_capture(cv::VideoCapture& capture, const std::filesystem::path& file) {
    try {
        // Absolute, so that a colon in a name is no protocol.
        return capture.open(std::filesystem::absolute(file).string(), cv::CAP_FFMPEG);
    } catch (const cv::Exception&) {
        return false;
    }
}

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
        const std::int64_t to = start() + at;
        return av_seek_frame(context_.get(), stream_->index, to, AVSEEK_FLAG_BACKWARD) >= 0;
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

/// When the last frame of the first video stream ends, as far as its packets are whole, counted
/// from the stream's beginning [s]; looked for from `from_s` on, and from the beginning where that
/// finds none. Nothing when the file cannot be opened, its packets have no times, or the end is too
/// far to look for.
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

/// A whole file ends there at the earliest.
double least_end_s(double promised_s) {
    return promised_s - std::max(kMissing_s, kMissingPart * promised_s);
}

/// A copy that broke off still opens: its header promises more than the file holds.
void require_whole(const std::filesystem::path& file, double promised_s) {
    const double least_s = least_end_s(promised_s);
    if (!(least_s > 0.0)) return;
    const std::optional<double> end_s = packets_end_s(file, least_s);
    if (!end_s || *end_s >= least_s) return;
    throw InputError(shown(file) + " is cut off: it ends at " + number_text(*end_s, 1) + " s of " +
                     number_text(promised_s, 1) + " s; copy or export it again");
}

}  // namespace

VideoFile::VideoFile(const std::filesystem::path& file) {
    set_up_libraries();
    facts_.file = file;
    open();
    read_facts();
    const double promised_s = facts_.duration_s;
    if (!grab())
        throw InputError(shown(file) + " holds no picture that can be decoded: record it again");
    ahead_.push_back({retrieve(), time_s_, index_});
    facts_.columns = ahead_.front().picture.cols;
    facts_.rows = ahead_.front().picture.rows;
    require_size(file, facts_.columns, facts_.rows);
    require_whole(file, promised_s);
    promised_s_ = promised_s;
}

void VideoFile::open() {
    if (!open_capture(capture_, facts_.file))
        throw InputError(
            shown(facts_.file) +
            " cannot be opened as a video: it is cut off, has no video stream or is of "
            "an unknown kind; record or convert it again");
    index_ = -1;
    time_s_ = 0.0;
    grabbed_ = false;
    jumped_ = false;
    counted_ = true;
    ended_ = false;
}

void VideoFile::read_facts() {
    const double rate = capture_.get(cv::CAP_PROP_FPS);
    if (rate > 0.0 && rate <= 1000.0) interval_s_ = 1.0 / rate;
    facts_.frames_per_s = 1.0 / interval_s_;
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    if (count >= 1.0 && count < 1e9) {  // unknown lengths show as huge or negative
        facts_.frames = static_cast<std::int64_t>(count);
        facts_.duration_s = count * interval_s_;
    }
    facts_.codec = text_of_fourcc(static_cast<int>(capture_.get(cv::CAP_PROP_FOURCC)));
    if (facts_.codec.empty()) facts_.codec = matroska_codec(facts_.file);
    const auto format = static_cast<int>(capture_.get(cv::CAP_PROP_CODEC_PIXEL_FORMAT));
    if (is_sixteen_bit_grey(format)) facts_.remark = "16-bit levels are read as 8 bits";
}

/// Its packets were whole when it was opened.
void VideoFile::notice_early_end() {
    const double end_s = time_s_ + interval_s_;
    if (jumped_ || !(end_s < least_end_s(promised_s_))) return;
    facts_.trouble = shown(facts_.file) + " breaks off at " + number_text(end_s, 1) + " s of " +
                     number_text(promised_s_, 1) +
                     " s since it was opened: what is left plays on; copy or export it again";
}

bool VideoFile::grab() {
    if (grabbed_) {
        grabbed_ = false;
        return true;
    }
    ended_ = !capture_.grab();
    if (ended_) {
        notice_early_end();
        if (!jumped_ && counted_ && index_ >= 0 &&
            index_ + 1 == static_cast<std::int64_t>(times_.size())) {
            facts_.frames = index_ + 1;
            facts_.frames_exact = true;
            learn();
        }
        return false;
    }
    const double last_s = time_s_;
    const bool follows = index_ >= 0 && !jumped_;
    time_s_ = capture_.get(cv::CAP_PROP_POS_MSEC) / 1000.0;
    if (index_ < 0 && !(time_s_ >= 0.0)) time_s_ = 0.0;
    if (follows && !(time_s_ > last_s)) {
        timed_ = false;
        time_s_ = last_s + interval_s_;
    }
    if (jumped_)
        place_at(time_s_);
    else
        ++index_;
    jumped_ = false;
    if (counted_ && index_ == static_cast<std::int64_t>(times_.size())) {
        times_.push_back(time_s_);
        learn();
    }
    return true;
}

cv::Mat VideoFile::retrieve() {
    cv::Mat picture;
    if (!capture_.retrieve(picture) || picture.empty())
        throw InputError(shown(facts_.file) + " breaks off at " + short_text(time_s_) +
                         " s: record or convert it again");
    return picture;
}

void VideoFile::learn() {
    const auto known = static_cast<std::int64_t>(times_.size());
    const double span = times_.back() - times_.front();
    if (known >= 2 && span > 0.0) facts_.frames_per_s = static_cast<double>(known - 1) / span;
    const double last_interval =
        known >= 2 ? times_.back() - times_[times_.size() - 2] : interval_s_;
    const double end_s = times_.back() + last_interval;
    facts_.duration_s = facts_.frames_exact ? end_s : std::max(facts_.duration_s, end_s);
    if (!facts_.frames_exact) facts_.frames = std::max(facts_.frames, known);
}

void VideoFile::place_at(double time_s) {
    const auto at = std::lower_bound(times_.begin(), times_.end(), time_s - kTimeTolerance_s);
    counted_ = at != times_.end();
    if (counted_) {
        index_ = at - times_.begin();
        return;
    }
    // Beyond what was read without a gap: an estimate until the gap is read.
    const double frames_on = std::round((time_s - times_.back()) * facts_.frames_per_s);
    index_ = static_cast<std::int64_t>(times_.size()) - 1 +
             std::max<std::int64_t>(1, static_cast<std::int64_t>(frames_on));
}

std::optional<TimedPicture> VideoFile::next() {
    if (!ahead_.empty()) {
        TimedPicture first = std::move(ahead_.front());
        ahead_.pop_front();
        return first;
    }
    if (!grab()) return std::nullopt;
    return TimedPicture{retrieve(), time_s_, index_};
}

void VideoFile::rewind_before(double time_s) {
    for (double margin_s = 0.25; timed_ && time_s - margin_s > 0.0; margin_s *= 4.0) {
        capture_.set(cv::CAP_PROP_POS_MSEC, (time_s - margin_s) * 1000.0);
        jumped_ = true;
        if (!grab()) continue;
        grabbed_ = time_s_ <= time_s;
        if (grabbed_) return;
    }
    if (timed_) {
        capture_.set(cv::CAP_PROP_POS_MSEC, 0.0);
        jumped_ = true;
        grabbed_ = grab() && index_ == 0;
        if (grabbed_) return;
    }
    capture_.release();
    open();
}

void VideoFile::seek(double time_s) {
    const double latest_s = facts_.frames_exact ? facts_.duration_s : kLongest_s;
    const double wanted_s = (time_s > 0.0 ? std::min(time_s, latest_s) : 0.0) + kTimeTolerance_s;
    const bool near_ahead =
        !ended_ && ahead_.empty() && time_s_ <= wanted_s && wanted_s < time_s_ + kNearAhead_s;
    std::optional<TimedPicture> shown_then;
    ahead_.clear();
    if (near_ahead)
        shown_then = TimedPicture{retrieve(), time_s_, index_};
    else
        rewind_before(wanted_s);
    while (grab()) {
        if (time_s_ > wanted_s && shown_then) {
            ahead_.push_back({retrieve(), time_s_, index_});
            break;
        }
        const auto follower = static_cast<std::size_t>(index_) + 1;
        const bool passed = counted_ && follower < times_.size() && times_[follower] <= wanted_s;
        if (!passed) shown_then = TimedPicture{retrieve(), time_s_, index_};
        if (time_s_ > wanted_s) break;
    }
    if (shown_then) ahead_.push_front(std::move(*shown_then));
}

void VideoFile::count_frames(std::int64_t most) {
    for (std::int64_t read = 0; read < most && grab(); ++read) {
    }
}

}  // namespace dibhr
