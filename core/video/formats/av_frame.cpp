// Reads levels and colours of libav's frames, in any pixel format.
#include "core/video/formats/av_frame.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/frame.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <opencv2/core.hpp>
#include <string_view>

#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

const AVPixFmtDescriptor* kind_of(const AVFrame& frame) {
    return av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
}

bool has(const AVPixFmtDescriptor& kind, std::uint64_t flag) {
    return (kind.flags & flag) != 0;
}

/// Whether the first component holds levels, as numbers.
bool has_luma(const AVPixFmtDescriptor& kind) {
    return !has(kind, AV_PIX_FMT_FLAG_RGB) && !has(kind, AV_PIX_FMT_FLAG_PAL) &&
           !has(kind, AV_PIX_FMT_FLAG_BITSTREAM) && !has(kind, AV_PIX_FMT_FLAG_HWACCEL);
}

/// Whether it has one component, or one and transparency.
bool is_grey_kind(const AVPixFmtDescriptor& kind) {
    return has_luma(kind) && kind.nb_components <= 2;
}

/// Whether a component lies in whole 16-bit words of this machine, beside no other component.
bool is_in_own_words(const AVPixFmtDescriptor& kind, const AVComponentDescriptor& component) {
    const bool is_big = std::endian::native == std::endian::big;
    return component.step == 2 && component.offset == 0 &&
           component.depth + component.shift <= 16 && component.depth + component.shift > 8 &&
           has(kind, AV_PIX_FMT_FLAG_BE) == is_big;
}

void copy_words(const AVFrame& frame, const AVComponentDescriptor& component, cv::Mat& levels) {
    const unsigned highest = (1U << static_cast<unsigned>(component.depth)) - 1U;
    for (int j = 0; j < frame.height; ++j) {
        const auto* const from = reinterpret_cast<const std::uint16_t*>(
            frame.data[component.plane] + std::ptrdiff_t{frame.linesize[component.plane]} * j);
        auto* const to = levels.ptr<std::uint16_t>(j);
        for (int i = 0; i < frame.width; ++i)
            to[i] = static_cast<std::uint16_t>((from[i] >> component.shift) & highest);
    }
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
    if (is_in_own_words(kind, luma)) {
        copy_words(frame, luma, levels);
        return levels;
    }
    std::array<const std::uint8_t*, 4> planes{frame.data[0], frame.data[1], frame.data[2],
                                              frame.data[3]};
    for (int j = 0; j < frame.height; ++j) {
        av_read_image_line2(levels.ptr(j), planes.data(), frame.linesize, &kind, 0, j, 0,
                            frame.width, 0, sizeof(std::uint16_t));
    }
    return levels;
}

/// Whether the range is limited: black is not 0, white not the highest level. Grey formats always
/// have the full range, whatever their tag: libav's codecs treat them so. Without a tag, levels
/// beyond black and white mean full range: as in grey stored in a codec without grey (H.264).
bool is_limited(const AVFrame& frame, const AVPixFmtDescriptor& kind, const cv::Mat& luma) {
    // Most of the pixels that compression moves beyond black and white, and far beyond.
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

/// The same for every code of 8 bits.
std::shared_ptr<const std::vector<float>> stretched_codes() {
    cv::Mat every(1, 256, CV_8UC1);
    std::iota(every.begin<std::uint8_t>(), every.end<std::uint8_t>(), std::uint8_t{0});
    const cv::Mat whole = stretched(every, 8);
    return std::make_shared<const std::vector<float>>(whole.begin<float>(), whole.end<float>());
}

template <typename Sample>
void copy_planes(const AVFrame& pairs, AVFrame& planes, int shift) {
    const auto row_of = [](const AVFrame& frame, std::size_t plane, int row) {
        return reinterpret_cast<Sample*>(frame.data[plane] +
                                         std::ptrdiff_t{frame.linesize[plane]} * row);
    };
    const auto level = [shift](Sample sample) { return static_cast<Sample>(sample >> shift); };
    for (int j = 0; j < pairs.height; ++j)
        std::transform(row_of(pairs, 0, j), row_of(pairs, 0, j) + pairs.width, row_of(planes, 0, j),
                       level);
    for (int j = 0; j < (pairs.height + 1) / 2; ++j) {
        const Sample* const from = row_of(pairs, 1, j);
        Sample* const blue = row_of(planes, 1, j);
        Sample* const red = row_of(planes, 2, j);
        for (int i = 0; i < (pairs.width + 1) / 2; ++i) {
            const Sample* const pair = from + std::ptrdiff_t{2} * i;
            blue[i] = level(pair[0]);
            red[i] = level(pair[1]);
        }
    }
}

/// A device's picture, whose chroma lies in pairs, in the form in which the processors decode it:
/// swscale converts other forms to slightly other colours. Null: it is no such picture.
AvOwned<AVFrame> with_planes(const AVFrame& frame) {
    const bool is_deep = frame.format == AV_PIX_FMT_P010;
    if (frame.format != AV_PIX_FMT_NV12 && !is_deep) return nullptr;
    const bool is_whole = frame.color_range == AVCOL_RANGE_JPEG;
    AvOwned<AVFrame> planes = new_frame();
    allocate_buffer(*planes,
                    is_deep    ? AV_PIX_FMT_YUV420P10
                    : is_whole ? AV_PIX_FMT_YUVJ420P
                               : AV_PIX_FMT_YUV420P,
                    frame.width, frame.height);
    if (is_deep)
        copy_planes<std::uint16_t>(frame, *planes, 6);
    else
        copy_planes<std::uint8_t>(frame, *planes, 0);
    return planes;
}

}  // namespace

std::string name_of_codec(int id) {
    const auto codec = static_cast<AVCodecID>(id);
    static const std::map<AVCodecID, std::string> names{
        {AV_CODEC_ID_VP8, "VP8"},     {AV_CODEC_ID_VP9, "VP9"},       {AV_CODEC_ID_AV1, "AV1"},
        {AV_CODEC_ID_FFV1, "FFV1"},   {AV_CODEC_ID_H264, "H.264"},    {AV_CODEC_ID_HEVC, "HEVC"},
        {AV_CODEC_ID_MJPEG, "MJPEG"}, {AV_CODEC_ID_THEORA, "Theora"}, {AV_CODEC_ID_PNG, "PNG"}};
    const auto found = names.find(codec);
    return found == names.end() ? avcodec_get_name(codec) : found->second;
}

std::size_t bytes_of(const AVFrame& frame) noexcept {
    std::size_t bytes = 0;
    for (const AVBufferRef* const buffer : frame.buf)
        if (buffer != nullptr) bytes += static_cast<std::size_t>(buffer->size);
    return bytes;
}

bool holds_floats(const AVFrame& frame) noexcept {
    const AVPixFmtDescriptor* const kind = kind_of(frame);
    return kind != nullptr && has(*kind, AV_PIX_FMT_FLAG_FLOAT);
}

int bits_of(const AVFrame& frame) noexcept {
    const AVPixFmtDescriptor* const kind = kind_of(frame);
    if (kind == nullptr) return 8;
    if (has_luma(*kind)) return kind->comp[0].depth;
    return kind->comp[0].depth > 8 ? 16 : 8;
}

bool is_grey(const AVFrame& frame) noexcept {
    const AVPixFmtDescriptor* const kind = kind_of(frame);
    return kind != nullptr && is_grey_kind(*kind);
}

double pixel_aspect(const AVFrame& frame, const AVStream& stream) noexcept {
    constexpr double kMost = 4.0;
    const AVRational of_frame = frame.sample_aspect_ratio;
    const AVRational ratio = of_frame.num > 0 ? of_frame : stream.sample_aspect_ratio;
    if (ratio.num <= 0 || ratio.den <= 0) return 1.0;
    const double aspect = av_q2d(ratio);
    const double larger = std::max(aspect, 1.0 / aspect);
    const double squares = larger * frame.width * frame.height;
    return larger > kMost || squares > static_cast<double>(kMostPixels) ? 1.0 : aspect;
}

cv::Mat turned(const cv::Mat& picture, int quarter_turns) {
    static constexpr std::array kTurns{cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180,
                                       cv::ROTATE_90_COUNTERCLOCKWISE};
    if (quarter_turns == 0 || picture.empty()) return picture;
    cv::Mat turned;
    cv::rotate(picture, turned, kTurns[static_cast<std::size_t>(quarter_turns - 1)]);
    return turned;
}

cv::Mat FramePictures::colour(const AVFrame& frame) {
    return converted(frame, AV_PIX_FMT_BGR24, CV_8UC3);
}

cv::Mat FramePictures::levels(const AVFrame& frame) {
    const CodedLevels coded = coded_levels(frame);
    if (!coded.level_of_code) return coded.picture;
    cv::Mat whole;
    cv::LUT(coded.picture, cv::Mat(*coded.level_of_code).reshape(1, 1), whole);
    return whole;
}

CodedLevels FramePictures::coded_levels(const AVFrame& frame) {
    const AVPixFmtDescriptor* const kind = kind_of(frame);
    if (kind == nullptr) return {};
    if (!has_luma(*kind)) {
        if (bits_of(frame) > 8) return {converted(frame, AV_PIX_FMT_BGR48, CV_16UC3)};
        const bool has_alpha = has(*kind, AV_PIX_FMT_FLAG_RGB) && has(*kind, AV_PIX_FMT_FLAG_ALPHA);
        return {has_alpha ? converted(frame, AV_PIX_FMT_BGRA, CV_8UC4)
                          : converted(frame, AV_PIX_FMT_BGR24, CV_8UC3)};
    }
    const cv::Mat luma = luma_of(frame, *kind);
    if (!limited_) limited_ = is_limited(frame, *kind, luma);
    if (!*limited_) return {luma};
    if (luma.depth() != CV_8U) return {stretched(luma, kind->comp[0].depth)};
    if (!level_of_code_) level_of_code_ = stretched_codes();
    return {luma, level_of_code_};
}

cv::Mat FramePictures::converted(const AVFrame& of, int pixel_format, int type) {
    const AvOwned<AVFrame> unpaired = with_planes(of);
    const AVFrame& frame = unpaired ? *unpaired : of;
    scaler_.reset(sws_getCachedContext(scaler_.release(), frame.width, frame.height,
                                       static_cast<AVPixelFormat>(frame.format), frame.width,
                                       frame.height, static_cast<AVPixelFormat>(pixel_format),
                                       SWS_BICUBIC, nullptr, nullptr, nullptr));
    if (!scaler_) return {};
    // The scaler writes whole vectors: beyond the end of each row, also of the last one.
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

}  // namespace dibhr
