// libav's decoder, and its pictures as OpenCV's.
#include "core/video/video_decoder.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/frame.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <numeric>
#include <opencv2/core.hpp>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/video/media.hpp"

namespace dibhr {

namespace {

constexpr int kMostFailures = 4096;  ///< packets in a row that cannot be decoded: nothing follows

std::string text_of_tag(std::uint32_t tag) {
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) {
        const char c = static_cast<char>((tag >> shift) & 0xffU);
        if (c > ' ' && c < 127) text += c;
    }
    return text;
}

std::string name_of(AVCodecID codec) {
    static constexpr std::array<std::pair<AVCodecID, std::string_view>, 9> kNames{
        {{AV_CODEC_ID_VP8, "VP8"},
         {AV_CODEC_ID_VP9, "VP9"},
         {AV_CODEC_ID_AV1, "AV1"},
         {AV_CODEC_ID_FFV1, "FFV1"},
         {AV_CODEC_ID_H264, "H.264"},
         {AV_CODEC_ID_HEVC, "HEVC"},
         {AV_CODEC_ID_MJPEG, "MJPEG"},
         {AV_CODEC_ID_THEORA, "Theora"},
         {AV_CODEC_ID_PNG, "PNG"}}};
    for (const auto& [id, name] : kNames)
        if (id == codec) return std::string(name);
    return avcodec_get_name(codec);
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

/// Clockwise, 0 to 3, of a file that was recorded with the camera turned.
int quarter_turns(const AVStream& stream) {
    const std::uint8_t* const matrix = display_matrix(stream);
    if (matrix == nullptr) return 0;
    std::array<std::int32_t, 9> numbers{};
    std::memcpy(numbers.data(), matrix, sizeof numbers);
    const double anticlockwise = av_display_rotation_get(numbers.data());
    if (!std::isfinite(anticlockwise)) return 0;
    return (static_cast<int>(std::lround(-anticlockwise / 90.0)) % 4 + 4) % 4;
}

/// Others have packets that show nothing, pictures of two fields in two packets, or (HEVC) call
/// non-reference what a higher temporal layer refers to.
bool marks_non_reference(const AVCodecParameters& coded) {
    const bool is_whole =
        coded.field_order == AV_FIELD_PROGRESSIVE || coded.field_order == AV_FIELD_UNKNOWN;
    return coded.codec_id == AV_CODEC_ID_H264 && is_whole;
}

const AVPixFmtDescriptor* kind_of(const AVFrame& frame) {
    return av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
}

bool has(const AVPixFmtDescriptor& kind, std::uint64_t flag) {
    return (kind.flags & flag) != 0;
}

/// Levels are in the first component, as numbers.
bool has_luma(const AVPixFmtDescriptor& kind) {
    return !has(kind, AV_PIX_FMT_FLAG_RGB) && !has(kind, AV_PIX_FMT_FLAG_PAL) &&
           !has(kind, AV_PIX_FMT_FLAG_BITSTREAM) && !has(kind, AV_PIX_FMT_FLAG_HWACCEL);
}

/// One component, or with transparency.
bool is_grey_kind(const AVPixFmtDescriptor& kind) {
    return has_luma(kind) && kind.nb_components <= 2;
}

/// The first component as it was coded.
cv::Mat luma_of(const AVFrame& frame, const AVPixFmtDescriptor& kind) {
    const AVComponentDescriptor& luma = kind.comp[0];
    if (luma.depth == 8 && luma.step == 1) {
        const cv::Mat plane(frame.height, frame.width, CV_8UC1, frame.data[0] + luma.offset,
                            static_cast<std::size_t>(frame.linesize[0]));
        return plane.clone();
    }
    cv::Mat levels(frame.height, frame.width, CV_16UC1);
    std::array<const std::uint8_t*, 4> planes{frame.data[0], frame.data[1], frame.data[2],
                                              frame.data[3]};
    for (int j = 0; j < frame.height; ++j) {
        av_read_image_line2(levels.ptr(j), planes.data(), frame.linesize, &kind, 0, j, 0,
                            frame.width, 0, sizeof(std::uint16_t));
    }
    return levels;
}

/// Whether black is not 0 and white not the highest level. Grey is always whole, whatever its tag
/// says: so every encoder and decoder of libav has it. Where no tag says it, levels beyond black
/// and white do: grey that a codec without grey holds as a picture in colours of grey (H.264).
bool is_limited(const AVFrame& frame, const AVPixFmtDescriptor& kind, const cv::Mat& luma) {
    // Of all pixels: what compression adds beyond black and white, and far beyond them.
    constexpr double kMostBeyond = 0.05;
    constexpr double kMostFarBeyond = 0.001;
    constexpr double kFar = 8.0;  // of 8 bits
    const bool is_whole_kind = std::string_view(kind.name).starts_with("yuvj");
    if (is_grey_kind(kind) || is_whole_kind || frame.color_range == AVCOL_RANGE_JPEG) return false;
    if (frame.color_range == AVCOL_RANGE_MPEG) return true;
    const double step = std::ldexp(1.0, kind.comp[0].depth - 8);
    const auto share_beyond = [&](double by) {
        const int beyond = cv::countNonZero(luma < (16.0 - by) * step) +
                           cv::countNonZero(luma > (235.0 + by) * step);
        return beyond / static_cast<double>(luma.total());
    };
    return share_beyond(0.0) <= kMostBeyond && share_beyond(kFar) <= kMostFarBeyond;
}

/// Black at 0, white at the highest level.
cv::Mat stretched(const cv::Mat& levels, int bits) {
    const double step = std::ldexp(1.0, bits - 8);
    const double highest = std::ldexp(1.0, bits) - 1.0;
    const double scale = highest / (219.0 * step);
    cv::Mat whole;
    levels.convertTo(whole, CV_32F, scale, -16.0 * step * scale);
    return cv::min(cv::max(whole, 0.0), highest);
}

/// The same by table, in one pass.
cv::Mat stretched_bytes(const cv::Mat& levels) {
    cv::Mat every(1, 256, CV_8UC1);
    std::iota(every.begin<std::uint8_t>(), every.end<std::uint8_t>(), std::uint8_t{0});
    cv::Mat whole;
    cv::LUT(levels, stretched(every, 8), whole);
    return whole;
}

}  // namespace

void VideoDecoder::Closer::operator()(AVCodecContext* context) const noexcept {
    avcodec_free_context(&context);
}

void VideoDecoder::Closer::operator()(AVFrame* frame) const noexcept {
    av_frame_free(&frame);
}

void VideoDecoder::Closer::operator()(SwsContext* scaler) const noexcept {
    sws_freeContext(scaler);
}

VideoDecoder::VideoDecoder(const std::filesystem::path& file, int track)
    : packets_(file, track), frame_(av_frame_alloc()), kept_(av_frame_alloc()) {
    const AVCodec* const codec =
        packets_.is_open() ? avcodec_find_decoder(packets_.stream()->codecpar->codec_id) : nullptr;
    if (codec != nullptr) decoder_.reset(avcodec_alloc_context3(codec));
    bool opened = decoder_ != nullptr && frame_ != nullptr && kept_ != nullptr;
    if (opened) {
        opened = avcodec_parameters_to_context(decoder_.get(), packets_.stream()->codecpar) >= 0;
        decoder_->thread_count = 0;  // as many as there are cores
        opened = opened && avcodec_open2(decoder_.get(), codec, nullptr) >= 0;
    }
    if (!opened)
        throw InputError(
            shown(file) +
            " cannot be opened as a video: it is cut off, has no video stream or is of "
            "an unknown kind; record or convert it again");
    quarter_turns_ = quarter_turns(*packets_.stream());
    marks_non_reference_ = marks_non_reference(*packets_.stream()->codecpar);
}

std::string VideoDecoder::codec() const {
    const AVCodecParameters& coded = *packets_.stream()->codecpar;
    const std::string tag = text_of_tag(coded.codec_tag);
    return tag.empty() ? name_of(coded.codec_id) : tag;
}

bool VideoDecoder::decode() {
    for (int failures = 0; failures < kMostFailures;) {
        const int given = avcodec_receive_frame(decoder_.get(), frame_.get());
        if (given == 0) {
            tell_skipped(time_s());
            return true;
        }
        if (given == AVERROR_EOF || (given == AVERROR(EAGAIN) && drained_)) break;
        if (given != AVERROR(EAGAIN)) {
            ++failures;
            continue;
        }
        if (!send(packets_.next())) ++failures;
    }
    tell_skipped(std::numeric_limits<double>::infinity());
    return false;
}

/// Which picture was skipped is told by its time, so that it needs one, and to be shown.
bool VideoDecoder::may_skip(const AVPacket& packet) const noexcept {
    return packets_.seconds(packet.pts) < skip_before_s_ &&
           (packet.flags & (AV_PKT_FLAG_CORRUPT | AV_PKT_FLAG_DISCARD)) == 0;
}

/// Null: nothing follows. False: it cannot be decoded.
bool VideoDecoder::send(const AVPacket* packet) {
    drained_ = packet == nullptr;
    const bool skip = packet != nullptr && may_skip(*packet);
    decoder_->skip_frame = skip ? AVDISCARD_NONREF : AVDISCARD_DEFAULT;
    if (avcodec_send_packet(decoder_.get(), packet) < 0) return false;
    if (skip) may_be_skipped_s_.insert(packets_.seconds(packet->pts));
    return true;
}

/// Pictures come in their order: those before the decoded one that did not come were skipped.
void VideoDecoder::tell_skipped(double until_s) {
    const auto begin = may_be_skipped_s_.begin();
    skipped_s_.assign(begin, may_be_skipped_s_.lower_bound(until_s));
    may_be_skipped_s_.erase(begin, may_be_skipped_s_.upper_bound(until_s));
}

bool VideoDecoder::jump(double time_s) {
    if (!packets_.jump(time_s)) return false;
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

double VideoDecoder::time_s() const noexcept {
    return packets_.seconds(frame_->best_effort_timestamp);
}

bool VideoDecoder::has_floats() const noexcept {
    const AVPixFmtDescriptor* const kind = kind_of(*frame_);
    return kind != nullptr && has(*kind, AV_PIX_FMT_FLAG_FLOAT);
}

int VideoDecoder::bits() const noexcept {
    const AVPixFmtDescriptor* const kind = kind_of(*frame_);
    if (kind == nullptr) return 8;
    if (has_luma(*kind)) return kind->comp[0].depth;
    return kind->comp[0].depth > 8 ? 16 : 8;
}

bool VideoDecoder::is_grey() const noexcept {
    const AVPixFmtDescriptor* const kind = kind_of(*frame_);
    return kind != nullptr && is_grey_kind(*kind);
}

double VideoDecoder::pixel_aspect() const noexcept {
    constexpr double kMost = 4.0;
    const AVRational of_frame = frame_->sample_aspect_ratio;
    const AVRational ratio = of_frame.num > 0 ? of_frame : packets_.stream()->sample_aspect_ratio;
    if (ratio.num <= 0 || ratio.den <= 0) return 1.0;
    const double aspect = av_q2d(ratio);
    if (aspect > kMost || aspect < 1.0 / kMost) return 1.0;
    return quarter_turns_ % 2 == 0 ? aspect : 1.0 / aspect;
}

cv::Mat VideoDecoder::colour() {
    return turned(converted(AV_PIX_FMT_BGR24, CV_8UC3));
}

cv::Mat VideoDecoder::levels() {
    const AVPixFmtDescriptor* const kind = kind_of(*frame_);
    if (kind == nullptr) return {};
    if (!has_luma(*kind)) {
        return turned(bits() > 8 ? converted(AV_PIX_FMT_BGR48, CV_16UC3)
                                 : converted(AV_PIX_FMT_BGR24, CV_8UC3));
    }
    cv::Mat levels = luma_of(*frame_, *kind);
    if (!limited_) limited_ = is_limited(*frame_, *kind, levels);
    if (*limited_)
        levels = levels.depth() == CV_8U ? stretched_bytes(levels)
                                         : stretched(levels, kind->comp[0].depth);
    return turned(std::move(levels));
}

cv::Mat VideoDecoder::converted(int pixel_format, int type) {
    const AVFrame& frame = *frame_;
    scaler_.reset(sws_getCachedContext(scaler_.release(), frame.width, frame.height,
                                       static_cast<AVPixelFormat>(frame.format), frame.width,
                                       frame.height, static_cast<AVPixelFormat>(pixel_format),
                                       SWS_BICUBIC, nullptr, nullptr, nullptr));
    if (!scaler_) return {};
    // The scaler writes whole vectors: beyond a row's end, and beyond the last one's.
    constexpr int kVector = 64;
    const int columns = (frame.width + kVector - 1) / kVector * kVector;
    const cv::Mat room(frame.height + 1, columns, type);
    std::array<std::uint8_t*, 4> planes{room.data};
    std::array<int, 4> steps{static_cast<int>(room.step)};
    const int rows = sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height,
                               planes.data(), steps.data());
    if (rows != frame.height) return {};
    return room(cv::Rect(0, 0, frame.width, frame.height));
}

cv::Mat VideoDecoder::turned(cv::Mat picture) const {
    static constexpr std::array kTurns{cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180,
                                       cv::ROTATE_90_COUNTERCLOCKWISE};
    if (quarter_turns_ == 0 || picture.empty()) return picture;
    cv::Mat turned;
    cv::rotate(picture, turned, kTurns[static_cast<std::size_t>(quarter_turns_ - 1)]);
    return turned;
}

}  // namespace dibhr
