// Encodes by libav's lossless FFVHUFF, and writes Matroska.
#include "core/clip/live_track.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/frame.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
}

#include <array>
#include <cstddef>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

TrackEncoder exact_encoder(int pixel_format, int columns, int rows, const char* prediction) {
    const AVCodec* const encoder = avcodec_find_encoder(AV_CODEC_ID_FFVHUFF);
    AvOwned<AVCodecContext> codec = new_encoder(encoder, columns, rows, pixel_format);
    av_opt_set(codec->priv_data, "pred", prediction, 0);
    if (avcodec_open2(codec.get(), encoder, nullptr) < 0)
        throw InputError(
            "the live video has a size that no video file can have, and cannot be recorded");
    return TrackEncoder(std::move(codec));
}

TrackEncoder encoder_of(const LiveLevels& levels) {
    if (levels.bytes == 0)
        throw InputError("this live depth is of real numbers, and cannot be recorded");
    return exact_encoder(levels.bytes == 2 ? AV_PIX_FMT_GRAY16 : AV_PIX_FMT_GRAY8, levels.columns,
                         levels.rows, "plane");
}

TrackEncoder encoder_of(const ColourImage& colour) {
    return exact_encoder(AV_PIX_FMT_GBRP, colour.columns, colour.rows, "median");
}

}  // namespace

LiveTrack::LiveTrack(const std::filesystem::path& file, const LiveLevels& first,
                     const std::map<std::string, std::string>& tags)
    : LiveTrack(file, encoder_of(first), tags) {}

LiveTrack::LiveTrack(const std::filesystem::path& file, const ColourImage& first)
    : LiveTrack(file, encoder_of(first), {}) {}

LiveTrack::LiveTrack(const std::filesystem::path& file, TrackEncoder encoder,
                     const std::map<std::string, std::string>& tags)
    : encoder_(std::move(encoder)),
      bytes_(file),
      file_(file, *encoder_.coded(), {.tags = tags, .bytes = bytes_.bytes()}) {
    bytes_.end_head();
}

std::optional<FileContent> LiveTrack::finish() {
    file_.finish();
    bytes_.finish();
    return bytes_.content();
}

AVFrame& LiveTrack::frame_of(int columns, int rows) {
    AVFrame& frame = encoder_.frame();
    if (columns != frame.width || rows != frame.height)
        throw InputError("the live video changed its size: record it again");
    return frame;
}

void LiveTrack::add(const LiveLevels& picture, std::int64_t shown_ms) {
    const AVFrame& frame = frame_of(picture.columns, picture.rows);
    const int row = picture.columns * picture.bytes;
    av_image_copy_plane(frame.data[0], frame.linesize[0], picture.levels.data(), row, row,
                        picture.rows);
    write(shown_ms);
}

void LiveTrack::add(const ColourImage& picture, std::int64_t shown_ms) {
    const AVFrame& frame = frame_of(picture.columns, picture.rows);
    constexpr std::array<std::size_t, 3> kOfPlane{1, 2, 0};  // green, blue, red
    const auto columns = static_cast<std::size_t>(picture.columns);
    for (std::size_t plane = 0; plane < kOfPlane.size(); ++plane)
        for (int j = 0; j < picture.rows; ++j) {
            const std::uint8_t* const from =
                picture.rgb.data() + 3 * columns * static_cast<std::size_t>(j) + kOfPlane[plane];
            std::uint8_t* const to = frame.data[plane] + std::ptrdiff_t{frame.linesize[plane]} * j;
            for (std::size_t i = 0; i < columns; ++i) to[i] = from[3 * i];
        }
    write(shown_ms);
}

void LiveTrack::write(std::int64_t shown_ms) {
    if (encoder_.encode(shown_ms, [this](AVPacket& packet) { file_.write(packet); }) < 0)
        throw InputError("libav cannot encode another picture");
}

}  // namespace dibhr
