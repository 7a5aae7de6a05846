// Opens and reads a stream through libav, set up to wait for nothing but the next picture.
#include "core/video/live/live_input.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libavutil/frame.h>
}

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <new>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <thread>

#include "core/error.hpp"
#include "core/files/module.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/libraries.hpp"

namespace dibhr {

namespace {

constexpr std::chrono::milliseconds kOpenTimeout{4000};  ///< for the first packets
constexpr std::chrono::milliseconds kTimeout{1500};      ///< for each later packet;
/// of a connection that its sender keeps, where silence may be a pause:
constexpr std::chrono::minutes kConnectedTimeout{1};
constexpr std::chrono::milliseconds kRetryInterval{2};
constexpr int kPipePoll_ms = 50;               ///< how soon a pipe notices that it must stop
constexpr std::chrono::seconds kMostEarly{1};  ///< a camera's picture never comes so early
constexpr std::chrono::seconds kClockSet{5};   ///< a clock so far ahead was set
constexpr int kPipeBytes = 1 << 16;
constexpr std::int64_t kProbe_us = 500'000;  ///< of the stream, read to find out what it holds
constexpr std::int64_t kProbe_bytes = 5'000'000;
constexpr int kReordered_us = 50'000;  ///< wait for a missing packet (RTP)
constexpr int kMostThreads = 4;

void set_up_devices() {
    static std::once_flag once;
    std::call_once(once, [] {
        reinterpret_cast<void (*)()>(symbol_in_module("dibhr_devices", "dibhr_register_devices"))();
    });
}

/// Refuses data that is no video. A pipe or a server would give the same again; a broadcast may be
/// readable at the next try.
[[noreturn]] void refuse_content(const LiveName& name, const std::string& what) {
    if (name.kind == LiveKind::pipe || name.url.starts_with("http")) throw LivePermanentError(what);
    throw InputError(what);
}

/// Makes one channel of whole numbers.
cv::Mat whole_levels(cv::Mat levels) {
    if (levels.channels() > 1) levels = grey_of(levels);
    if (levels.depth() != CV_32F) return levels;
    cv::Mat rounded;
    levels.convertTo(rounded, CV_16U);
    return rounded;
}

}  // namespace

/// Reads bytes of a pipe, which may have no writer yet.
struct LiveInput::Pipe {
    explicit Pipe(const std::string& file, const std::string& shown)
        : descriptor(file.empty() ? ::dup(STDIN_FILENO)
                                  : ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)),
          has_writer(file.empty()) {
        if (descriptor < 0)
            throw InputError(shown +
                             " cannot be opened: make it with mkfifo, and let something "
                             "write a video into it");
        if (::isatty(descriptor) != 0)
            throw LivePermanentError(
                "nothing is piped into standard input: let another program write a "
                "video into it, as in: ffmpeg ... -f nut - | dibhr -");
    }
    ~Pipe() {
        if (descriptor >= 0) ::close(descriptor);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int descriptor;
    bool has_writer;  ///< from the start
    bool began{false};
};

int LiveInput::must_stop(void* input) noexcept {
    const auto& self = *static_cast<const LiveInput*>(input);
    return self.control_.stopping.load(std::memory_order_relaxed) || Clock::now() > self.deadline_
               ? 1
               : 0;
}

/// A pipe without a writer is not at its end before the first bytes.
int LiveInput::read_pipe(void* input, std::uint8_t* bytes, int size) noexcept {
    auto& self = *static_cast<LiveInput*>(input);
    Pipe& pipe = *self.pipe_;
    while (must_stop(input) == 0) {
        pollfd wanted{.fd = pipe.descriptor, .events = POLLIN, .revents = 0};
        if (::poll(&wanted, 1, kPipePoll_ms) <= 0) continue;
        const auto got = ::read(pipe.descriptor, bytes, static_cast<std::size_t>(size));
        if (got > 0) {
            pipe.began = true;
            self.set_deadline(kTimeout);
            return static_cast<int>(got);
        }
        if (got < 0 && errno != EAGAIN && errno != EINTR) return AVERROR(errno);
        if (got == 0 && (pipe.began || pipe.has_writer || (wanted.revents & POLLIN) != 0))
            return AVERROR_EOF;
        std::this_thread::sleep_for(std::chrono::milliseconds(kPipePoll_ms));
    }
    return AVERROR_EXIT;
}

/// A pipe that has given bytes never times out: none may be lost, and the system reports its end.
void LiveInput::set_deadline(std::chrono::milliseconds timeout) {
    const bool began = pipe_ && pipe_->began;
    deadline_ = began ? Clock::time_point::max() : Clock::now() + timeout;
}

LiveInput::LiveInput(const LiveName& name, const std::string& shown, const LiveControl& control,
                     std::atomic<Clock::time_point>& last_packet)
    : control_(control),
      last_packet_(last_packet),
      kind_(name.kind),
      timeout_(keeps_connection(name) ? kConnectedTimeout : kTimeout) {
    set_up_libraries();
    if (!name.format.empty()) set_up_devices();
    if (kind_ == LiveKind::pipe) pipe_ = std::make_unique<Pipe>(name.url, shown);
    set_deadline(kOpenTimeout);
    const bool may_be_depth = kind_ == LiveKind::camera && control.levels;
    if (may_be_depth) camera_ = DepthCamera::opened(name, calls_);
    if (camera_) return;
    int result = may_be_depth ? open(name, true) : -1;
    if (result < 0) result = open(name, false);
    if (result < 0) refuse(name, shown, result);
    open_decoder(name, shown);
}

void LiveInput::refuse(const LiveName& name, const std::string& shown, int result) const {
    if (kind_ == LiveKind::generated)
        throw LivePermanentError(shown + " is nothing that libav can make (" + reason_of(result) +
                                 "): see ffmpeg -filters");
    const bool silent = result == AVERROR_EXIT || result == AVERROR(EAGAIN);
    if (silent)
        throw InputError(shown +
                         " sends nothing that can be read: start the sender, and check the name");
    if (pipe_ && !pipe_->began)
        throw LivePermanentError(
            shown + " ended without a picture: let the program that writes into it send a video");
    if (result == AVERROR_INVALIDDATA || result == AVERROR_EOF)
        refuse_content(name, shown + (pipe_ ? " holds" : " sends") +
                                 " no video that can be read: let it be one in NUT, Matroska or "
                                 "MPEG-TS");
    if (result == AVERROR(EIO) && !has_known_host(name))
        throw LivePermanentError(shown +
                                 " cannot be opened, as its host is not found: check the name");
    throw InputError(shown + " cannot be opened (" + reason_of(result) +
                     "): start the sender, and check the name");
}

LiveInput::~LiveInput() = default;

/// `as_depth`: requests 16-bit grey of a camera.
int LiveInput::open(const LiveName& name, bool as_depth) {
    const AVInputFormat* const format =
        name.format.empty() ? nullptr : av_find_input_format(name.format.c_str());
    if (!name.format.empty() && format == nullptr) return AVERROR_DEMUXER_NOT_FOUND;
    if (pipe_) {
        auto* const buffer = static_cast<unsigned char*>(av_malloc(kPipeBytes));
        bytes_.reset(avio_alloc_context(buffer, kPipeBytes, 0, this, read_pipe, nullptr, nullptr));
        if (!bytes_) {
            av_free(buffer);
            throw std::bad_alloc();
        }
    }
    AVFormatContext* context = avformat_alloc_context();
    if (context == nullptr) throw std::bad_alloc();
    context->interrupt_callback = {must_stop, this};
    context->flags |= AVFMT_FLAG_NOBUFFER | AVFMT_FLAG_DISCARD_CORRUPT;
    if (kind_ == LiveKind::camera) context->flags |= AVFMT_FLAG_NONBLOCK;
    context->probesize = kProbe_bytes;
    context->max_analyze_duration = kProbe_us;
    context->max_delay = kReordered_us;
    if (pipe_) context->pb = bytes_.get();
    AvOptions options;
    for (const auto& [key, value] : name.options) options.set(key, value);
    if (!name.allowed.empty()) options.set("protocol_whitelist", name.allowed);
    if (kind_ == LiveKind::network) options.set("overrun_nonfatal", "1");
    if (as_depth) options.set("pixel_format", "gray16le");
    int result =
        avformat_open_input(&context, pipe_ ? nullptr : name.url.c_str(), format, options.data());
    if (result < 0) return must_stop(this) != 0 ? AVERROR_EXIT : result;  // the context is freed
    context_.reset(context);
    // The packets read to probe the stream are pictures, too; all others may refer to the first.
    if (kind_ == LiveKind::network || pipe_) context->flags &= ~AVFMT_FLAG_NOBUFFER;
    // A packet of a transport stream is a picture: do not wait for the begin of the next one.
    if (std::string_view(context->iformat->name) == "mpegts") context->flags |= AVFMT_FLAG_NOPARSE;
    do {
        result = avformat_find_stream_info(context, nullptr);
    } while (result == AVERROR(EAGAIN) && must_stop(this) == 0);
    return must_stop(this) != 0 ? AVERROR_EXIT : result;
}

/// Decodes with threads that share a picture; with a picture each they would add delay.
void LiveInput::open_decoder(const LiveName& name, const std::string& shown) {
    const AVCodec* codec = nullptr;
    const int track = av_find_best_stream(context_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (track >= 0 && codec != nullptr) {
        stream_ = context_->streams[track];
        decoder_.reset(avcodec_alloc_context3(codec));
    }
    bool opened = decoder_ != nullptr &&
                  avcodec_parameters_to_context(decoder_.get(), stream_->codecpar) >= 0;
    if (opened) {
        decoder_->pkt_timebase = stream_->time_base;
        decoder_->max_pixels = kMostPixels;
        decoder_->flags |= AV_CODEC_FLAG_LOW_DELAY;
        decoder_->thread_type = FF_THREAD_SLICE;
        decoder_->thread_count =
            std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
        opened = avcodec_open2(decoder_.get(), codec, nullptr) >= 0;
    }
    if (!opened)
        refuse_content(name,
                       shown + " sends no video that can be decoded: let it send another form");
    for (unsigned k = 0; k < context_->nb_streams; ++k)
        if (context_->streams[k] != stream_) context_->streams[k]->discard = AVDISCARD_ALL;
}

/// False: the stream has ended, or timed out.
bool LiveInput::send_next() {
    set_deadline(timeout_);
    for (;;) {
        av_packet_unref(packet_.get());
        const int got = av_read_frame(context_.get(), packet_.get());
        if (got == AVERROR(EAGAIN) && must_stop(this) == 0) {
            std::this_thread::sleep_for(kRetryInterval);
            continue;
        }
        if (got < 0) return false;
        if (packet_->stream_index != stream_->index) continue;
        arrived_ = Clock::now();
        last_packet_ = arrived_;
        if ((packet_->flags & AV_PKT_FLAG_CORRUPT) != 0) damaged_ = true;
        if (avcodec_send_packet(decoder_.get(), packet_.get()) < 0) damaged_ = true;
        return true;
    }
}

/// Pictures after damage refer to it, up to one that refers to no other.
bool LiveInput::is_whole() {
    const AVFrame& frame = *frame_;
    const bool hurt = (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame.decode_error_flags != 0;
    damaged_ = hurt || (damaged_ && frame.pict_type != AV_PICTURE_TYPE_I);
    return !damaged_;
}

/// Generated pictures, and a file in a pipe or on a server, arrive as fast as they are read: these
/// wait for the time of their stamp. Pictures of a camera never wait.
void LiveInput::wait_until_due(double stamp_s) {
    if (!std::isfinite(stamp_s)) return;
    const auto early = kind_ == LiveKind::generated ? Clock::duration(0) : kMostEarly;
    const auto due_of = [this, stamp_s] {
        return begin_ + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(stamp_s - first_s_));
    };
    const bool begins = begin_ == Clock::time_point{};
    if (begins || due_of() > Clock::now() + kClockSet) {
        begin_ = Clock::now();
        first_s_ = stamp_s;
    }
    const Clock::time_point due = due_of() - early;
    if (due <= Clock::now()) return;
    while (Clock::now() < due && !control_.stopping.load(std::memory_order_relaxed))
        std::this_thread::sleep_for(
            std::min<Clock::duration>(due - Clock::now(), std::chrono::milliseconds(kPipePoll_ms)));
    arrived_ = Clock::now();
}

/// False: the picture cannot be converted.
bool LiveInput::take(LivePicture& picture) {
    const AVFrame& frame = *frame_;
    const std::int64_t stamp = frame.best_effort_timestamp;
    picture.stamp_s = stamp == AV_NOPTS_VALUE
                          ? std::numeric_limits<double>::quiet_NaN()
                          : static_cast<double>(stamp) * av_q2d(stream_->time_base);
    wait_until_due(picture.stamp_s);
    const double aspect = pixel_aspect(frame, *stream_);
    picture.colour = cv::Mat();
    picture.levels = cv::Mat();
    if (control_.colour)
        picture.colour = with_square_pixels(pictures_.colour(frame), aspect, PictureRole::colour);
    if (control_.levels && !holds_floats(frame))
        picture.levels =
            with_square_pixels(whole_levels(pictures_.levels(frame)), aspect, PictureRole::depth);
    picture.bits = bits_of(frame);
    picture.grey = is_grey(frame);
    picture.codec = name_of_codec(stream_->codecpar->codec_id);
    const double rate = av_q2d(av_guess_frame_rate(context_.get(), stream_, nullptr));
    picture.frames_per_s = rate > 0.0 && rate <= 1000.0 ? rate : 0.0;
    picture.arrived = arrived_;
    return !picture.colour.empty() || !picture.levels.empty();
}

/// As a colour picture it shows the higher byte of each level.
bool LiveInput::read_camera(LivePicture& picture) {
    set_deadline(kTimeout);
    DepthCamera::Picture taken;
    if (!camera_->read(taken, [this] { return must_stop(this) != 0; })) return false;
    picture = {.levels = taken.levels,
               .bits = 16,
               .grey = true,
               .stamp_s = taken.stamp_s,
               .frames_per_s = camera_->frames_per_s(),
               .codec = "Z16",
               .arrived = Clock::now()};
    if (!control_.colour) return true;
    taken.levels.convertTo(picture.colour, CV_8U, 1.0 / 256.0);
    cv::cvtColor(picture.colour, picture.colour, cv::COLOR_GRAY2BGR);
    return true;
}

bool LiveInput::read(LivePicture& picture) {
    if (camera_) return read_camera(picture);
    while (!control_.stopping) {
        const int given = avcodec_receive_frame(decoder_.get(), frame_.get());
        if (given == 0) {
            if (is_whole() && take(picture)) return true;
        } else if (given != AVERROR(EAGAIN) || !send_next()) {
            return false;
        }
    }
    return false;
}

}  // namespace dibhr
