// A video that a device decodes has the pictures that the processors decode, whatever the device
// does. No machine of the tests has a device: the one here decodes by the processors, and gives its
// pictures as a device does, with chroma in pairs.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/frame.h>
#include <libavutil/pixfmt.h>
}

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/av/decoding_device.hpp"
#include "core/video/formats/video_file.hpp"
#include "core/video/frames/video_picture.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::Contains;

namespace {

constexpr int kNever = std::numeric_limits<int>::max();
constexpr int kCompared = 8;  // pictures, at the opening

enum class Offers { all, nothing };

class StandIn : public DecodingDevice {
  public:
    /// Fails at that fetched picture, from 1; adds `off` to each level.
    explicit StandIn(int fails_at = kNever, int off = 0, Offers offers = Offers::all)
        : fails_at_(fails_at), off_(off), offers_(offers) {}

    [[nodiscard]] std::string name() const override { return "a stand-in"; }
    void take(AVCodecContext& context) override {
        if (offers_ == Offers::nothing)
            context.get_format = [](AVCodecContext*, const AVPixelFormat*) {
                return AV_PIX_FMT_NONE;
            };
    }
    [[nodiscard]] AvOwned<AVFrame> fetched(const AVFrame& picture) override {
        if (++fetched_ >= fails_at_) return nullptr;
        AvOwned<AVFrame> copy = new_frame();
        allocate_buffer(*copy, AV_PIX_FMT_NV12, picture.width, picture.height);
        for (int j = 0; j < picture.height; ++j)
            for (int i = 0; i < picture.width; ++i)
                at(*copy, 0, i, j) = static_cast<std::uint8_t>(at(picture, 0, i, j) + off_);
        for (int j = 0; j < picture.height / 2; ++j) {
            for (int i = 0; i < picture.width / 2; ++i) {
                at(*copy, 1, 2 * i, j) = at(picture, 1, i, j);
                at(*copy, 1, 2 * i + 1, j) = at(picture, 2, i, j);
            }
        }
        REQUIRE(av_frame_copy_props(copy.get(), &picture) == 0);
        return copy;
    }
    [[nodiscard]] int fetched_pictures() const { return fetched_; }

  private:
    static std::uint8_t& at(const AVFrame& frame, std::size_t plane, int column, int row) {
        return frame.data[plane][std::ptrdiff_t{frame.linesize[plane]} * row + column];
    }

    int fails_at_, off_;
    Offers offers_;
    int fetched_{0};
};

/// Pictures that move, with P and B pictures and a key picture each half second.
std::filesystem::path clip_in(const TemporaryFolder& folder) {
    const auto file = folder / "clip.mp4";
    ffmpeg("-f lavfi -i testsrc2=s=128x96:r=30:d=2 -c:v libx264 -pix_fmt yuv420p -g 15 -bf 3 '" +
           file.string() + "'");
    return file;
}

struct Seen {
    double time_s;
    std::int64_t index;
    cv::Mat picture;
};

std::vector<Seen> all_of(VideoFile& video) {
    std::vector<Seen> all;
    while (auto next = video.next()) all.push_back({next->time_s, next->index, next->picture});
    return all;
}

void check_same(const std::vector<Seen>& a, const std::vector<Seen>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        CAPTURE(k);
        CHECK(a[k].time_s == b[k].time_s);
        CHECK(a[k].index == b[k].index);
        CHECK(cv::norm(a[k].picture, b[k].picture, cv::NORM_INF) == 0.0);
    }
}

}  // namespace

TEST_CASE("a video that a device decodes has the same pictures and says what decodes it",
          "[media]") {
    const TemporaryFolder folder;
    const auto file = clip_in(folder);
    const PictureRole role = GENERATE(PictureRole::depth, PictureRole::colour);
    VideoFile plain(file, role);
    VideoFile video(file, role);
    const auto device = std::make_shared<StandIn>();
    video.decode_in(device);
    CHECK(video.facts().decoder == "a stand-in");
    check_same(all_of(video), all_of(plain));
    CHECK(device->fetched_pictures() == 60 + kCompared);
    for (const double time_s : {0.7, 0.1, 1.9, 0.0}) {
        video.seek(time_s);
        plain.seek(time_s);
        check_same({{0.0, 0, video.next()->picture}}, {{0.0, 0, plain.next()->picture}});
    }
    CHECK(video.facts().decoder == "a stand-in");
}

TEST_CASE("colours in pairs of chroma are drawn from the device's picture and convert to the same",
          "[media]") {
    const TemporaryFolder folder;
    const auto file = clip_in(folder);
    VideoFile plain(file, PictureRole::colour);
    VideoFile video(file, PictureRole::colour);
    video.decode_in(std::make_shared<StandIn>());
    plain.share_video();
    video.share_video();
    const auto own = plain.next();
    const auto of_device = video.next();
    REQUIRE(of_device->video);
    CHECK(of_device->video->plane_count == 2);
    CHECK(of_device->video->convert().rgb == own->video->convert().rgb);
}

TEST_CASE("a device that fails in the middle loses no picture and is reported", "[media]") {
    const TemporaryFolder folder;
    const auto file = clip_in(folder);
    const int fails_at = GENERATE(1, 2, 14, 15, 16, 31, 60) + kCompared;
    CAPTURE(fails_at);
    VideoFile plain(file, PictureRole::depth);
    VideoFile video(file, PictureRole::depth);
    video.decode_in(std::make_shared<StandIn>(fails_at));
    check_same(all_of(video), all_of(plain));
    CHECK_THAT(video.facts().decoder, Contains("a stand-in failed"));
    CHECK(video.facts().frames_exact);
    CHECK(video.facts().frames == 60);
}

TEST_CASE("a device that fails after a jump or while pictures are left out loses none either",
          "[media]") {
    const TemporaryFolder folder;
    const auto file = clip_in(folder);
    const int fails_at = GENERATE(1, 3, 9, 20) + kCompared;
    CAPTURE(fails_at);
    VideoFile plain(file, PictureRole::depth);
    VideoFile video(file, PictureRole::depth);
    video.decode_in(std::make_shared<StandIn>(fails_at));
    for (VideoFile* const one : {&plain, &video}) one->seek(1.2);
    const auto step = [](VideoFile& one) {
        std::vector<Seen> seen;
        for (double from_s = 1.2; from_s < 1.9; from_s += 0.2)
            if (auto next = one.next_from(from_s))
                seen.push_back({next->time_s, next->index, next->picture});
        return seen;
    };
    check_same(step(video), step(plain));
    CHECK_THAT(video.facts().decoder, Contains("failed"));
}

TEST_CASE("a device that decodes other levels or none is left and the pictures are as without",
          "[media]") {
    const TemporaryFolder folder;
    const auto file = clip_in(folder);
    const auto device = GENERATE(
        as<std::shared_ptr<StandIn>>(), std::make_shared<StandIn>(kNever, 1),
        std::make_shared<StandIn>(kNever, 0, Offers::nothing), std::make_shared<StandIn>(3));
    VideoFile plain(file, PictureRole::depth);
    VideoFile video(file, PictureRole::depth);
    video.decode_in(device);
    CHECK_THAT(video.facts().decoder, Contains("the processors, as a stand-in"));
    const int fetched = device->fetched_pictures();
    check_same(all_of(video), all_of(plain));
    CHECK(device->fetched_pictures() == fetched);
}

TEST_CASE("a machine without a device or with one that cannot be opened decodes without",
          "[media]") {
    const TemporaryFolder folder;
    CHECK(open_decoding_device(AV_CODEC_ID_H264, folder / "none") == nullptr);
    std::filesystem::create_directory(folder / "dri");
    CHECK(open_decoding_device(AV_CODEC_ID_H264, folder.path()) == nullptr);
    std::ofstream(folder / "dri" / "renderD128") << "no device";
    CHECK(open_decoding_device(AV_CODEC_ID_H264, folder.path()) == nullptr);
    std::ofstream(folder / "nvidia0") << "no device";
    CHECK(open_decoding_device(AV_CODEC_ID_FFV1, folder.path()) == nullptr);
}
