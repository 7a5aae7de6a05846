// The levels of decoded pictures, in any pixel format.
extern "C" {
#include <libavutil/frame.h>
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "core/video/formats/av_frame.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

/// A frame of random bytes.
AvOwned<AVFrame> random_frame(AVPixelFormat format, int columns, int rows, std::uint32_t seed) {
    AvOwned<AVFrame> frame = new_frame();
    allocate_buffer(*frame, format, columns, rows);
    std::minstd_rand random(seed);
    for (int k = 0; k < AV_NUM_DATA_POINTERS && frame->buf[k] != nullptr; ++k)
        std::generate_n(frame->buf[k]->data, frame->buf[k]->size,
                        [&random] { return static_cast<std::uint8_t>(random() >> 8U); });
    return frame;
}

/// Whether a format has levels in its first component, at whole bytes.
bool holds_levels(const AVPixFmtDescriptor& kind) {
    constexpr std::uint64_t kOthers = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL |
                                      AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_HWACCEL |
                                      AV_PIX_FMT_FLAG_FLOAT | AV_PIX_FMT_FLAG_BAYER;
    return (kind.flags & kOthers) == 0 && kind.nb_components > 0 && kind.comp[0].depth <= 16;
}

/// libav's own reading of the first component.
std::vector<std::uint16_t> levels_by_libav(const AVFrame& frame, const AVPixFmtDescriptor& kind) {
    std::vector<std::uint16_t> levels(static_cast<std::size_t>(frame.width * frame.height));
    std::array<const std::uint8_t*, 4> planes{frame.data[0], frame.data[1], frame.data[2],
                                              frame.data[3]};
    for (int j = 0; j < frame.height; ++j)
        av_read_image_line2(levels.data() + static_cast<std::ptrdiff_t>(frame.width) * j,
                            planes.data(), frame.linesize, &kind, 0, j, 0, frame.width, 0,
                            sizeof(std::uint16_t));
    return levels;
}

}  // namespace

TEST_CASE("levels are those that libav reads, in every pixel format with luma") {
    const AVPixFmtDescriptor* kind = nullptr;
    int formats = 0;
    while ((kind = av_pix_fmt_desc_next(kind)) != nullptr) {
        if (!holds_levels(*kind)) continue;
        const AVPixelFormat format = av_pix_fmt_desc_get_id(kind);
        const AvOwned<AVFrame> frame = random_frame(format, 38, 22, 7);
        frame->color_range = AVCOL_RANGE_JPEG;
        const cv::Mat levels = FramePictures().levels(*frame);
        INFO(kind->name);
        REQUIRE(levels.size() == cv::Size(38, 22));
        cv::Mat words;
        levels.convertTo(words, CV_16U);
        const std::vector<std::uint16_t> expected = levels_by_libav(*frame, *kind);
        CHECK(std::equal(expected.begin(), expected.end(), words.begin<std::uint16_t>()));
        ++formats;
    }
    CHECK(formats > 60);
}
