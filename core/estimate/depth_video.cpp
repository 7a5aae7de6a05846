// Encodes by libav's FFV1, and writes Matroska.
#include "core/estimate/depth_video.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/frame.h>
#include <libavutil/imgutils.h>
#include <libavutil/rational.h>
}

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr const char* kSubject = "the depth video ";

TrackEncoder encoder_for(const DepthVideoShape& shape) {
    const AVCodec* const encoder = avcodec_find_encoder(AV_CODEC_ID_FFV1);
    if (encoder == nullptr)
        throw InputError(
            "no depth video can be made: this libavcodec has no FFV1 encoder; install the "
            "distribution's full libavcodec");
    constexpr int kFinest = 1 << 16;
    AvOwned<AVCodecContext> codec =
        new_encoder(encoder, shape.columns, shape.rows,
                    shape.bits == 8 ? AV_PIX_FMT_GRAY8 : AV_PIX_FMT_GRAY16LE);
    codec->sample_aspect_ratio = av_d2q(shape.pixel_aspect, kFinest);
    codec->color_range = AVCOL_RANGE_JPEG;
    codec->gop_size = 1;  // every frame is a seek target
    codec->level = 3;     // with slices, which are decoded in parallel, and check sums
    require_written(avcodec_open2(codec.get(), encoder, nullptr), kSubject);
    return TrackEncoder(std::move(codec));
}

}  // namespace

DepthVideo::DepthVideo(const std::filesystem::path& file, const DepthVideoShape& shape)
    : encoder_(encoder_for(shape)), file_(file, *encoder_.coded(), {.subject = kSubject}) {}

void DepthVideo::add(const cv::Mat& levels, double shown_s, double interval_s) {
    const AVFrame& frame = encoder_.frame();
    av_image_copy_plane(frame.data[0], frame.linesize[0], levels.data,
                        static_cast<int>(levels.step),
                        static_cast<int>(levels.elemSize()) * levels.cols, levels.rows);
    interval_ms_ = std::max<std::int64_t>(std::llround(interval_s * kTrackUnitsPerSecond), 1);
    require_written(encoder_.encode(std::llround(shown_s * kTrackUnitsPerSecond),
                                    [this](AVPacket& packet) { write(packet); }),
                    kSubject);
}

void DepthVideo::write(AVPacket& packet) {
    packet.duration = interval_ms_;
    file_.write(packet);
}

void DepthVideo::finish() {
    require_written(encoder_.flush([this](AVPacket& packet) { write(packet); }), kSubject);
    file_.finish();
}

}  // namespace dibhr
