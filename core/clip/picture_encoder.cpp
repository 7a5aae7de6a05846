// Sets up libav's encoders, and converts the window's pictures for them.
#include "core/clip/picture_encoder.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/frame.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

namespace {

constexpr int kPicturesPerSecond = 30;  // about: the encoder's nominal rate
constexpr int kPicturesToKey = 30;      // from key frame to key frame: seek, and loss in a crash
constexpr int kH264Quality = 20;        // its crf: hardly visible losses
constexpr int kMpeg4Quality = 3;        // 1: the best, 31

/// Software encoders by name: a hardware encoder that the machine lacks would fail too late.
constexpr std::array<const char*, 3> kEncoders{"libx264", "libopenh264", "mpeg4"};

int even(int pixels) {
    return std::max(pixels, 2) & ~1;
}

/// Marks colours as HDTV's, which players assume by default.
void set_colour_space(AVCodecContext& codec) {
    codec.color_range = AVCOL_RANGE_MPEG;
    codec.colorspace = AVCOL_SPC_BT709;
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_BT709;
}

/// Encodes on the calling thread only, because haptics run on the same machine; one packet for each
/// picture. Null: libav has no such encoder, or it does not support that size.
AvOwned<AVCodecContext> opened(const char* name, int columns, int rows) {
    const AVCodec* const encoder = avcodec_find_encoder_by_name(name);
    if (encoder == nullptr) return nullptr;
    AvOwned<AVCodecContext> codec = new_encoder(encoder, columns, rows, AV_PIX_FMT_YUV420P);
    codec->framerate = {kPicturesPerSecond, 1};
    codec->gop_size = kPicturesToKey;
    codec->max_b_frames = 0;
    set_colour_space(*codec);
    if (encoder->id == AV_CODEC_ID_MPEG4) {
        codec->flags |= AV_CODEC_FLAG_QSCALE;
        codec->global_quality = FF_QP2LAMBDA * kMpeg4Quality;
    }
    // Options of libx264; the other encoders ignore them.
    av_opt_set(codec->priv_data, "preset", "veryfast", 0);
    av_opt_set(codec->priv_data, "tune", "zerolatency", 0);
    av_opt_set_int(codec->priv_data, "crf", kH264Quality, 0);
    if (avcodec_open2(codec.get(), encoder, nullptr) < 0) return nullptr;
    return codec;
}

TrackEncoder encoder_for(int columns, int rows) {
    for (const char* const name : kEncoders)
        if (AvOwned<AVCodecContext> codec = opened(name, even(columns), even(rows)))
            return TrackEncoder(std::move(codec));
    throw InputError("no clip can be made of " + std::to_string(columns) + " x " +
                     std::to_string(rows) +
                     " pixels: this libavcodec has neither an H.264 nor an MPEG-4 encoder for it; "
                     "install the distribution's full libavcodec");
}

/// Where a picture lies in one of another size: same shape, centred.
struct Place {
    int left, top, columns, rows;
};

Place place_in(const AVFrame& frame, const AVFrame& picture) {
    const double scale =
        std::min(1.0 * frame.width / picture.width, 1.0 * frame.height / picture.height);
    const auto side = [scale](int pixels, int most) {
        return std::min(even(static_cast<int>(std::lround(scale * pixels))), most);
    };
    const int columns = side(picture.width, frame.width);
    const int rows = side(picture.height, frame.height);
    return {(frame.width - columns) / 2 & ~1, (frame.height - rows) / 2 & ~1, columns, rows};
}

void paint_black(AVFrame& frame) {
    std::array<std::ptrdiff_t, 4> strides{};
    std::copy_n(std::begin(frame.linesize), strides.size(), strides.begin());
    av_image_fill_black(frame.data, strides.data(), AV_PIX_FMT_YUV420P, AVCOL_RANGE_MPEG,
                        frame.width, frame.height);
}

InputError cannot_encode() {
    return InputError("the clip ends: libav cannot encode another picture; begin a new one");
}

}  // namespace

PictureEncoder::PictureEncoder(int columns, int rows) : encoder_(encoder_for(columns, rows)) {}

/// The unscaled picture, without the last row or column where their number is odd.
const AVFrame& PictureEncoder::copied(const ColourImage& picture) {
    AVFrame& frame = *picture_;
    allocate_buffer(frame, AV_PIX_FMT_RGB24, even(picture.columns), even(picture.rows));
    av_image_copy_plane(frame.data[0], frame.linesize[0], picture.rgb.data(), 3 * picture.columns,
                        3 * frame.width, frame.height);
    return frame;
}

const AVFrame& PictureEncoder::scaled(const AVFrame& from, int columns, int rows) {
    AVFrame& frame = *scaled_;
    allocate_buffer(frame, AV_PIX_FMT_YUV420P, columns, rows);
    scaler_.reset(sws_getCachedContext(scaler_.release(), from.width, from.height, AV_PIX_FMT_RGB24,
                                       columns, rows, AV_PIX_FMT_YUV420P, SWS_BILINEAR, nullptr,
                                       nullptr, nullptr));
    if (scaler_ == nullptr) throw cannot_encode();
    const int* const colours = sws_getCoefficients(SWS_CS_ITU709);
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(scaler_.get(), colours, 1, colours, 0, 0, kOne, kOne);
    sws_scale(scaler_.get(), from.data, from.linesize, 0, from.height, frame.data, frame.linesize);
    return frame;
}

/// Draws the picture into the encoder's frame.
void PictureEncoder::place(const ColourImage& picture) {
    AVFrame& frame = encoder_.frame();
    const AVFrame& from = copied(picture);
    const Place place = place_in(frame, from);
    const AVFrame& placed = scaled(from, place.columns, place.rows);
    if (place.columns != frame.width || place.rows != frame.height) paint_black(frame);
    for (std::size_t plane = 0; plane < 3; ++plane) {
        const int subsampling = plane == 0 ? 1 : 2;
        av_image_copy_plane(frame.data[plane] +
                                std::ptrdiff_t{frame.linesize[plane]} * (place.top / subsampling) +
                                place.left / subsampling,
                            frame.linesize[plane], placed.data[plane], placed.linesize[plane],
                            place.columns / subsampling, place.rows / subsampling);
    }
}

void PictureEncoder::encode(const ColourImage& picture, std::int64_t shown_ms,
                            const TrackEncoder::Sink& sink) {
    if (std::min(picture.columns, picture.rows) < 2) return;
    place(picture);
    if (encoder_.encode(shown_ms, sink) < 0) throw cannot_encode();
}

void PictureEncoder::drain(const TrackEncoder::Sink& sink) {
    if (encoder_.flush(sink) < 0) throw cannot_encode();
}

}  // namespace dibhr
