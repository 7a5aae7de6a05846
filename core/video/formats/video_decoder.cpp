// Decodes by libav, and rotates the pictures.
#include "core/video/formats/video_decoder.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/frame.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <opencv2/core.hpp>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

constexpr double kReordered_s = 1.0;  ///< no picture is decoded so much earlier than it is shown
constexpr int kCompared = 8;          ///< pictures: those of each type are among them
constexpr int kMostFailures = 4096;   ///< failed packets in a row that count as the end

std::string text_of_tag(std::uint32_t tag) {
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) {
        const char c = static_cast<char>((tag >> shift) & 0xffU);
        if (c > ' ' && c < 127) text += c;
    }
    return text;
}

const std::uint8_t* display_matrix(const AVStream& stream) {
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
    const AVPacketSideData* const data =
        av_packet_side_data_get(stream.codecpar->coded_side_data,
                                stream.codecpar->nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
    return data == nullptr ? nullptr : data->data;
#else
    return av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
#endif
}

/// Clockwise, 0 to 3, for a file recorded with a rotated camera.
int quarter_turns(const AVStream& stream) {
    const std::uint8_t* const matrix = display_matrix(stream);
    if (matrix == nullptr) return 0;
    std::array<std::int32_t, 9> numbers{};
    std::memcpy(numbers.data(), matrix, sizeof numbers);
    const double anticlockwise = av_display_rotation_get(numbers.data());
    if (!std::isfinite(anticlockwise)) return 0;
    return (static_cast<int>(std::lround(-anticlockwise / 90.0)) % 4 + 4) % 4;
}

/// Other codecs have packets without a picture, pictures of two fields in two packets, or (HEVC)
/// mark as non-reference what a higher temporal layer refers to.
bool codec_marks_non_reference(const AVCodecParameters& coded) {
    const bool is_whole =
        coded.field_order == AV_FIELD_PROGRESSIVE || coded.field_order == AV_FIELD_UNKNOWN;
    return coded.codec_id == AV_CODEC_ID_H264 && is_whole;
}

/// Checks the size that the container claims; libav bounds the size in the packets.
void require_plausible_frames(const std::filesystem::path& file, const AVCodecParameters& coded) {
    const AVPixFmtDescriptor* const kind =
        av_pix_fmt_desc_get(static_cast<AVPixelFormat>(coded.format));
    const int bits = kind == nullptr ? 8 : av_get_padded_bits_per_pixel(kind);
    if (coded.width > 0 && coded.height > 0)
        require_plausible_size(file, coded.width, coded.height, (bits + 7) / 8);
}

/// Whether it has the first bytes of MP4 and QuickTime, Matroska, or AVI.
bool begins_as_video(std::string_view head) {
    return head.substr(std::min<std::size_t>(4, head.size())).starts_with("ftyp") ||
           head.starts_with("\x1a\x45\xdf\xa3") || head.starts_with("RIFF");
}

bool are_same(const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

}  // namespace

VideoDecoder::VideoDecoder(const std::filesystem::path& file, int track,
                           std::shared_ptr<DecodingDevice> device)
    : file_(file), track_(track), packets_(file, track), device_(std::move(device)) {
    if (packets_.is_open()) require_plausible_frames(file, *packets_.stream()->codecpar);
    bool opened = open();
    if (!opened && device_) {
        device_.reset();
        opened = open();
    }
    if (!opened)
        throw InputError(shown(file) + " cannot be opened as a video: " +
                         (begins_as_video(head_of(file))
                              ? "it is cut off, or has no video stream; copy or record it again"
                              : "it is of a kind that is not known here; convert it to pictures "
                                "(PNG of 16 bits) or to an array (.npy)"));
    quarter_turns_ = quarter_turns(*packets_.stream());
    marks_non_reference_ = codec_marks_non_reference(*packets_.stream()->codecpar);
}

/// A new decoder, in the device if there is one. False: there is none for the track.
bool VideoDecoder::open() {
    if (!packets_.is_open()) return false;
    const AVCodecParameters& coded = *packets_.stream()->codecpar;
    const AVCodec* const codec = avcodec_find_decoder(coded.codec_id);
    decoder_.reset(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
    if (!decoder_ || avcodec_parameters_to_context(decoder_.get(), &coded) < 0) return false;
    decoder_->thread_count = device_ ? 1 : 0;  // 0: one more than there are processors
    decoder_->max_pixels = kMostPixels;
    if (device_) device_->take(*decoder_);
    return avcodec_open2(decoder_.get(), codec, nullptr) >= 0;
}

int VideoDecoder::codec_id() const noexcept {
    return packets_.stream()->codecpar->codec_id;
}

std::string VideoDecoder::codec() const {
    const AVCodecParameters& coded = *packets_.stream()->codecpar;
    const std::string tag = text_of_tag(coded.codec_tag);
    return tag.empty() ? name_of_codec(coded.codec_id) : tag;
}

bool VideoDecoder::decode() {
    for (int failures = 0; failures < kMostFailures;) {
        const int given = receive();
        if (given == 0 && time_s() <= again_to_s_) {
            update_skipped(time_s());
            continue;
        }
        if (given == 0) {
            ++decoded_;
            last_s_ = time_s();
            update_skipped(last_s_);
            return true;
        }
        if (given == AVERROR_EOF || (given == AVERROR(EAGAIN) && drained_)) break;
        const bool failed = given != AVERROR(EAGAIN) || !send(next_packet());
        if (failed && device_)
            leave_device();
        else if (failed)
            ++failures;
    }
    update_skipped(std::numeric_limits<double>::infinity());
    return false;
}

/// As avcodec_receive_frame(). In a device a picture with errors is a failure, too.
int VideoDecoder::receive() {
    const int given = avcodec_receive_frame(decoder_.get(), frame_.get());
    if (given != 0 || !device_) return given;
    AvOwned<AVFrame> fetched =
        frame_->decode_error_flags == 0 ? device_->fetched(*frame_) : AvOwned<AVFrame>();
    if (!fetched) return AVERROR_EXTERNAL;
    frame_ = std::move(fetched);
    return 0;
}

/// Goes back to a key frame before the next picture. Throws InputError: the file is gone.
void VideoDecoder::leave_device() {
    const double from_s = last_s_ > kNever_s ? last_s_ - kReordered_s : jumped_to_s_;
    if (!(from_s > kNever_s) || !packets_.jump(from_s)) packets_ = VideoPackets(file_, track_);
    decoder_.reset();
    device_.reset();
    again_to_s_ = last_s_;
    packets_left_ = most_packets_;
    may_be_skipped_s_.clear();
    drained_ = false;
    if (!open())
        throw InputError(shown(file_) + " cannot be read any more: copy or record it again");
}

const AVPacket* VideoDecoder::next_packet() {
    if (packets_left_ == 0) return nullptr;
    if (packets_left_ > 0) --packets_left_;
    return packets_.next();
}

/// Skipped pictures are identified by their time: only shown pictures with a time may be skipped.
bool VideoDecoder::may_skip(const AVPacket& packet) const noexcept {
    const double time_s = packets_.seconds(packet.pts);
    return time_s < skip_before_s_ && time_s > again_to_s_ &&
           (packet.flags & (AV_PKT_FLAG_CORRUPT | AV_PKT_FLAG_DISCARD)) == 0;
}

/// Sends a packet to the decoder; null: the end. False: it cannot be decoded.
bool VideoDecoder::send(const AVPacket* packet) {
    drained_ = packet == nullptr;
    const bool skip = packet != nullptr && may_skip(*packet);
    decoder_->skip_frame = skip ? AVDISCARD_NONREF : AVDISCARD_DEFAULT;
    if (avcodec_send_packet(decoder_.get(), packet) < 0) return false;
    if (skip) may_be_skipped_s_.insert(packets_.seconds(packet->pts));
    return true;
}

/// Pictures come in order: those before the decoded one that did not come were skipped.
void VideoDecoder::update_skipped(double until_s) {
    const auto begin = may_be_skipped_s_.begin();
    skipped_s_.assign(begin, may_be_skipped_s_.lower_bound(until_s));
    may_be_skipped_s_.erase(begin, may_be_skipped_s_.upper_bound(until_s));
}

bool VideoDecoder::jump(double time_s, int most_packets) {
    if (!packets_.jump(time_s)) return false;
    most_packets_ = packets_left_ = most_packets;
    jumped_to_s_ = time_s;
    last_s_ = again_to_s_ = kNever_s;
    avcodec_flush_buffers(decoder_.get());
    drained_ = false;
    skip_before_s_ = kNever_s;
    may_be_skipped_s_.clear();
    return true;
}

void VideoDecoder::skip_non_reference_before(double time_s) noexcept {
    if (marks_non_reference_) skip_before_s_ = time_s;
}

void VideoDecoder::keep() {
    av_frame_unref(kept_.get());
    if (av_frame_ref(kept_.get(), frame_.get()) < 0) throw std::bad_alloc();
}

void VideoDecoder::show_again(const AVFrame& picture) {
    av_frame_unref(frame_.get());
    if (av_frame_ref(frame_.get(), &picture) < 0) throw std::bad_alloc();
}

double VideoDecoder::time_s() const noexcept {
    return packets_.seconds(frame_->best_effort_timestamp);
}

double VideoDecoder::pixel_aspect() const noexcept {
    const double aspect = dibhr::pixel_aspect(*frame_, *packets_.stream());
    return quarter_turns_ % 2 == 0 ? aspect : 1.0 / aspect;
}

cv::Mat VideoDecoder::colour() {
    return turned(pictures_.colour(*frame_), quarter_turns_);
}

cv::Mat VideoDecoder::levels() {
    return turned(pictures_.levels(*frame_), quarter_turns_);
}

CodedLevels VideoDecoder::coded_levels() {
    CodedLevels coded = pictures_.coded_levels(*frame_);
    coded.picture = turned(coded.picture, quarter_turns_);
    return coded;
}

std::shared_ptr<const VideoPicture> VideoDecoder::shared(double aspect) {
    return sharer_.picture(*frame_, quarter_turns_, aspect);
}

bool decodes_alike(const std::filesystem::path& file, int track,
                   const std::shared_ptr<DecodingDevice>& device) {
    VideoDecoder own(file, track);
    VideoDecoder in_device(file, track, device);
    for (int k = 0; k < kCompared; ++k) {
        const bool given = own.decode();
        if (in_device.decode() != given || in_device.device() == nullptr) return false;
        if (!given) break;
        if (!(own.time_s() == in_device.time_s()) || !are_same(own.levels(), in_device.levels()))
            return false;
        if (k == 0 && !are_same(own.colour(), in_device.colour())) return false;
    }
    return true;
}

}  // namespace dibhr
