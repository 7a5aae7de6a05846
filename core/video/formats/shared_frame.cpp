// Describes libav's planes, and converts them for those who need red, green and blue.
#include "core/video/formats/shared_frame.hpp"

extern "C" {
#include <libavutil/frame.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/av_frame.hpp"

namespace dibhr {

namespace {

constexpr std::array<std::uint8_t, 2> kNoChroma8{128, 128};
constexpr std::array<std::uint16_t, 2> kNoChroma16{0x8000, 0x8000};

/// The weights of red and blue in luma.
struct LumaWeights {
    double red, blue;
};

/// Nothing: a matrix of another form, or none (ITU-T H.273, table 4).
std::optional<LumaWeights> weights_of(AVColorSpace space) {
    switch (space) {
        case AVCOL_SPC_BT709:
            return LumaWeights{0.2126, 0.0722};
        case AVCOL_SPC_UNSPECIFIED:
        case AVCOL_SPC_RESERVED:
        case AVCOL_SPC_BT470BG:
        case AVCOL_SPC_SMPTE170M:
            return LumaWeights{0.299, 0.114};
        case AVCOL_SPC_FCC:
            return LumaWeights{0.30, 0.11};
        case AVCOL_SPC_SMPTE240M:
            return LumaWeights{0.212, 0.087};
        case AVCOL_SPC_BT2020_NCL:
            return LumaWeights{0.2627, 0.0593};
        default:
            return std::nullopt;
    }
}

/// The place of its samples of a kind, where that is one that is shared.
struct SharedForm {
    int count;         ///< of planes
    int sample_bytes;  ///< 1 or 2
};

bool is_plain(const AVComponentDescriptor& component, int plane, int bytes, int step, int offset) {
    return component.plane == plane && component.step == step && component.offset == offset &&
           (bytes == 1 ? component.depth == 8 && component.shift == 0
                       : component.depth > 8 && component.depth + component.shift <= 16);
}

std::optional<SharedForm> form_of(const AVPixFmtDescriptor& kind) {
    constexpr std::uint64_t kOthers = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL |
                                      AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_HWACCEL |
                                      AV_PIX_FMT_FLAG_ALPHA | AV_PIX_FMT_FLAG_FLOAT |
                                      AV_PIX_FMT_FLAG_BAYER;
    const bool is_big = std::endian::native == std::endian::big;
    const int bytes = kind.comp[0].depth == 8 ? 1 : 2;
    if ((kind.flags & kOthers) != 0) return std::nullopt;
    if (bytes == 2 && ((kind.flags & AV_PIX_FMT_FLAG_BE) != 0) != is_big) return std::nullopt;
    if (kind.log2_chroma_w > 1 || kind.log2_chroma_h > 1) return std::nullopt;
    if (!is_plain(kind.comp[0], 0, bytes, bytes, 0)) return std::nullopt;
    if (kind.nb_components == 1) return SharedForm{3, bytes};
    if (kind.nb_components != 3) return std::nullopt;
    const bool has_planes =
        is_plain(kind.comp[1], 1, bytes, bytes, 0) && is_plain(kind.comp[2], 2, bytes, bytes, 0);
    const bool has_pairs = is_plain(kind.comp[1], 1, bytes, 2 * bytes, 0) &&
                           is_plain(kind.comp[2], 1, bytes, 2 * bytes, bytes);
    if (!has_planes && !has_pairs) return std::nullopt;
    return SharedForm{has_planes ? 3 : 2, bytes};
}

bool has_whole_range(const AVFrame& frame, const AVPixFmtDescriptor& kind) {
    return kind.nb_components == 1 || std::string_view(kind.name).starts_with("yuvj") ||
           frame.color_range == AVCOL_RANGE_JPEG;
}

std::array<std::array<float, 4>, 3> matrix_of(const AVFrame& frame, const AVPixFmtDescriptor& kind,
                                              LumaWeights weights) {
    const AVComponentDescriptor& luma = kind.comp[0];
    const bool whole = has_whole_range(frame, kind);
    const double each = std::ldexp(1.0, luma.depth - 8);
    const double highest = std::ldexp(1.0, luma.depth) - 1.0;
    // Codes of samples in [0, 1], which are shifted in their bytes or words.
    const double codes = (luma.depth == 8 ? 255.0 : 65535.0) / std::ldexp(1.0, luma.shift);
    const double black = whole ? 0.0 : 16.0 * each;
    const double luma_scale = codes / (whole ? highest : 219.0 * each);
    const double chroma_scale =
        kind.nb_components == 1 ? 0.0 : codes / (whole ? highest : 224.0 * each);
    const double middle = 128.0 * each / codes;
    const double green = 1.0 - weights.red - weights.blue;
    const double red_by_red = 2.0 * (1.0 - weights.red);
    const double blue_by_blue = 2.0 * (1.0 - weights.blue);
    const double chroma[3][2] = {
        {0.0, red_by_red},
        {-blue_by_blue * weights.blue / green, -red_by_red * weights.red / green},
        {blue_by_blue, 0.0}};
    std::array<std::array<float, 4>, 3> matrix{};
    for (std::size_t k = 0; k < matrix.size(); ++k) {
        const double of_blue = chroma_scale * chroma[k][0];
        const double of_red = chroma_scale * chroma[k][1];
        matrix[k] = {static_cast<float>(luma_scale), static_cast<float>(of_blue),
                     static_cast<float>(of_red),
                     static_cast<float>(-luma_scale * black / codes - middle * (of_blue + of_red))};
    }
    return matrix;
}

/// Whether its rows lie as textures are filled: top row first, in whole samples.
bool lies_plainly(const AVFrame& frame, const SharedForm& form, int planes) {
    for (int k = 0; k < planes; ++k) {
        const int each = form.sample_bytes * (k > 0 && form.count == 2 ? 2 : 1);
        if (frame.linesize[k] <= 0 || frame.linesize[k] % each != 0) return false;
        if (reinterpret_cast<std::uintptr_t>(frame.data[k]) %
                static_cast<unsigned>(form.sample_bytes) !=
            0)
            return false;
    }
    return true;
}

void set_planes(const AVFrame& frame, const AVPixFmtDescriptor& kind, VideoPicture& picture) {
    const auto plane_of = [&frame](std::size_t k, int right, int down) {
        return SamplePlane{frame.data[k], static_cast<std::size_t>(frame.linesize[k]),
                           AV_CEIL_RSHIFT(frame.width, right), AV_CEIL_RSHIFT(frame.height, down)};
    };
    picture.planes[0] = plane_of(0, 0, 0);
    if (kind.nb_components == 1) {
        const auto* const none = picture.sample_bytes == 1
                                     ? kNoChroma8.data()
                                     : reinterpret_cast<const std::uint8_t*>(kNoChroma16.data());
        picture.planes[1] = picture.planes[2] = {none, sizeof kNoChroma16[0], 1, 1};
        return;
    }
    for (int k = 1; k < picture.plane_count; ++k)
        picture.planes[static_cast<std::size_t>(k)] =
            plane_of(static_cast<std::size_t>(k), kind.log2_chroma_w, kind.log2_chroma_h);
}

}  // namespace

/// Used by any thread: those of the frames may live longer than the file.
class FrameSharer::Converter {
  public:
    ColourImage convert(const AVFrame& frame, int quarter_turns, double pixel_aspect) {
        const std::lock_guard lock(mutex_);
        const cv::Mat picture = turned(pictures_.colour(frame), quarter_turns);
        if (picture.empty()) return {};
        return colour_of(with_square_pixels(picture, pixel_aspect, PictureRole::colour));
    }

  private:
    std::mutex mutex_{};
    FramePictures pictures_{};
};

FrameSharer::FrameSharer() : converter_(std::make_shared<Converter>()) {}
FrameSharer::~FrameSharer() = default;
FrameSharer::FrameSharer(FrameSharer&&) noexcept = default;
FrameSharer& FrameSharer::operator=(FrameSharer&&) noexcept = default;

std::shared_ptr<const VideoPicture> FrameSharer::picture(const AVFrame& frame, int quarter_turns,
                                                         double pixel_aspect) {
    const AVPixFmtDescriptor* const kind =
        av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
    const std::optional<SharedForm> form = kind != nullptr ? form_of(*kind) : std::nullopt;
    const std::optional<LumaWeights> weights = weights_of(frame.colorspace);
    if (!form || !weights) return nullptr;
    if (!lies_plainly(frame, *form, kind->nb_components == 1 ? 1 : form->count)) return nullptr;
    auto picture = std::make_shared<VideoPicture>();
    picture->plane_count = form->count;
    picture->sample_bytes = form->sample_bytes;
    picture->rgb_of_samples = matrix_of(frame, *kind, *weights);
    picture->quarter_turns = quarter_turns;
    const bool lies = quarter_turns % 2 != 0;
    const cv::Size size = with_square_pixels(
        lies ? cv::Size(frame.height, frame.width) : cv::Size(frame.width, frame.height),
        pixel_aspect);
    picture->columns = size.width;
    picture->rows = size.height;
    picture->bytes = bytes_of(frame);
    set_planes(frame, *kind, *picture);
    // shared_ptr, as std::function is copied.
    const std::shared_ptr<AVFrame> kept(new_frame());
    if (av_frame_ref(kept.get(), &frame) < 0) throw std::bad_alloc();
    picture->convert = [kept, quarter_turns, pixel_aspect, converter = converter_] {
        return converter->convert(*kept, quarter_turns, pixel_aspect);
    };
    return picture;
}

}  // namespace dibhr
