// The track encoder and the muxer, as far as clips and depth videos do not test them.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/error.h>
#include <libavutil/frame.h>
}

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "core/av/track_encoder.hpp"
#include "core/av/track_file.hpp"
#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// An encoder that delays pictures, because others refer to them in both directions.
TrackEncoder delaying_encoder() {
    const AVCodec* const encoder = avcodec_find_encoder(AV_CODEC_ID_MPEG4);
    AvOwned<AVCodecContext> codec = new_encoder(encoder, 64, 48, AV_PIX_FMT_YUV420P);
    codec->max_b_frames = 2;
    codec->flags |= AV_CODEC_FLAG_QSCALE;
    codec->global_quality = 3 * FF_QP2LAMBDA;
    REQUIRE(avcodec_open2(codec.get(), encoder, nullptr) == 0);
    return TrackEncoder(std::move(codec));
}

}  // namespace

TEST_CASE("packets that a codec keeps back come with the flush, each at its picture's time",
          "[av]") {
    TrackEncoder encoder = delaying_encoder();
    std::vector<std::int64_t> came_ms;
    const TrackEncoder::Sink sink = [&](const AVPacket& packet) { came_ms.push_back(packet.pts); };
    const std::vector<std::int64_t> shown_ms{0, 33, 50, 400, 433, 1900, 1950};
    for (const std::int64_t at_ms : shown_ms) {
        const AVFrame& frame = encoder.frame();
        for (const int plane : {0, 1, 2})
            std::memset(frame.data[plane], static_cast<int>(at_ms % 256),
                        static_cast<std::size_t>(frame.linesize[plane]) * (plane == 0 ? 48U : 24U));
        REQUIRE(encoder.encode(at_ms, sink) == 0);
    }
    CHECK(came_ms.size() < shown_ms.size());
    CHECK(encoder.flush(sink) == 0);
    std::sort(came_ms.begin(), came_ms.end());
    CHECK(came_ms == shown_ms);
}

TEST_CASE("an encoder that has ended says so, and gives nothing more", "[av]") {
    TrackEncoder encoder = delaying_encoder();
    const TrackEncoder::Sink none = [](AVPacket&) { FAIL("a packet"); };
    CHECK(encoder.flush(none) == 0);
    CHECK(encoder.encode(0, none) == AVERROR_EOF);
}

TEST_CASE("a track that cannot be written says which, why, and what to do", "[av]") {
    const TemporaryFolder folder;
    const TrackEncoder encoder = delaying_encoder();
    CHECK_THROWS_WITH(
        TrackFile(folder / "nowhere/a.mkv", *encoder.coded(), {.subject = "the video "}),
        "the video cannot be written (No such file or directory); make the folder, or choose "
        "another");
    CHECK_THROWS_AS(TrackFile(folder / "nowhere/a.mkv", *encoder.coded(), {}), InputError);
}
