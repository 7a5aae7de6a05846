// Reading videos: pairing by time, exact seeking, levels that survive.
#include "core/video/sources/media.hpp"
#include "core/error.hpp"
#include "core/video/sources/media_names.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// Which frame a flat depth picture is.
int frame_of(const DepthImage& depth) {
    return static_cast<int>(std::lround(depth.at(depth.columns / 2, depth.rows / 2) / 5.0F));
}

int frame_of(const ColourImage& colour) {
    return static_cast<int>(std::lround(colour.rgb[colour.rgb.size() / 2] / 5.0));
}

std::vector<RawFrame> all_frames(Media& media) {
    std::vector<RawFrame> frames;
    while (auto frame = media.next()) frames.push_back(std::move(*frame));
    return frames;
}

}  // namespace

TEST_CASE("every one of the 256 levels of a lossless grey video arrives exactly", "[media]") {
    const TemporaryFolder folder;
    ffmpeg(
        "-f lavfi -i \"color=black:s=256x16:r=10,format=gray,geq=lum='mod(X+N\\,256)'\" -frames:v "
        "3 " +
        kLossless + " '" + (folder / "levels.mkv").string() + "'");
    const auto media = open_depth(folder / "levels.mkv");
    const auto frames = all_frames(*media);
    REQUIRE(frames.size() == 3);
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const DepthImage& depth = frames[n].depth;
        REQUIRE(depth.columns == 256);
        REQUIRE_THAT(depth.highest_level, WithinAbs(255.0, 0.0));
        int wrong = 0;
        for (int j = 0; j < depth.rows; ++j)
            for (int i = 0; i < 256; ++i)
                if (depth.at(i, j) != static_cast<float>((i + static_cast<int>(n)) % 256)) ++wrong;
        CHECK(wrong == 0);
        CHECK(frames[n].colour.rgb.empty());
    }
}

TEST_CASE("frames come in order with their presentation times, in every kind of file", "[media]") {
    const TemporaryFolder folder;
    const auto [name, encoding] = GENERATE(table<std::string, std::string>(
        {{"a.mkv", kLossless}, {"a.mp4", kH264}, {"a.webm", kVp9}, {"b.mkv", kH264}}));
    CAPTURE(name);
    make_flat_clip(folder / name, 40, 25, encoding);
    const auto media = open_depth(folder / name);
    const auto frames = all_frames(*media);
    REQUIRE(frames.size() == 40);
    for (std::size_t n = 0; n < frames.size(); ++n) {
        CHECK(frames[n].index == static_cast<std::int64_t>(n));
        CHECK(frame_of(frames[n].depth) == static_cast<int>(n));
        CHECK_THAT(frames[n].media_s, WithinAbs(static_cast<double>(n) / 25.0, 0.0006));
    }
    CHECK(media->description().frames_exact);
    CHECK(media->description().frames == 40);
    CHECK_THAT(media->description().duration_s, WithinAbs(1.6, 0.002));
    CHECK_THAT(media->description().frames_per_s, WithinAbs(25.0, 0.1));
}

TEST_CASE("a seek gives the frame shown at that time, forwards, backwards and beyond the ends",
          "[media]") {
    const TemporaryFolder folder;
    // Uneven: intervals that grow from 27 to 713 ms, so that index / rate finds nothing.
    const auto [name, encoding, filter] = GENERATE(table<std::string, std::string, std::string>(
        {{"even.mkv", kLossless, ""},
         {"even.mp4", kH264, ""},
         {"even.webm", kVp9, ""},
         {"rare.mp4", kRareKeys, ""},
         {"rare_uneven.mkv", kRareKeys, "settb=1/1000,setpts='20*N+7*N*N'"},
         {"uneven.mkv", kH264, "settb=1/1000,setpts='20*N+7*N*N'"},
         {"uneven.webm", kVp9, "settb=1/1000,setpts='20*N+7*N*N'"}}));
    CAPTURE(name);
    make_flat_clip(folder / name, 50, 25, encoding, filter);
    std::vector<double> times;
    {
        const auto media = open_depth(folder / name);
        for (const auto& frame : all_frames(*media)) times.push_back(frame.media_s);
    }
    REQUIRE(times.size() == 50);
    const bool read_before = GENERATE(false, true);
    CAPTURE(read_before);
    const bool counts = read_before || name.starts_with("rare");  // from its only key frame on
    const auto media = open_depth(folder / name);
    if (read_before) (void)all_frames(*media);
    std::mt19937 random(7);
    for (int trial = 0; trial < 40; ++trial) {
        const double wanted_s = std::uniform_real_distribution(-0.1, times.back() + 1.0)(random);
        CAPTURE(trial, wanted_s);
        const auto after =
            std::upper_bound(times.begin(), times.end(), wanted_s + kTimeTolerance_s);
        const auto expected = std::max<std::ptrdiff_t>(0, after - times.begin() - 1);
        media->seek(wanted_s);
        const auto frame = media->next();
        REQUIRE(frame);
        CHECK(frame_of(frame->depth) == expected);
        CHECK_THAT(frame->media_s, WithinAbs(times[static_cast<std::size_t>(expected)], 1e-9));
        if (counts) CHECK(frame->index == expected);
        const auto follower = media->next();
        REQUIRE(follower.has_value() == (expected + 1 < 50));
        if (follower) CHECK(frame_of(follower->depth) == expected + 1);
    }
}

TEST_CASE("each depth frame comes with the colour shown at its time, whatever the rates",
          "[media]") {
    const TemporaryFolder folder;
    const auto [colour_rate, depth_rate] =
        GENERATE(table<int, int>({{30, 30}, {30, 15}, {15, 30}, {25, 10}}));
    CAPTURE(colour_rate, depth_rate);
    make_flat_clip(folder / "color.mkv", colour_rate, colour_rate, kLossless, "", 96, 40);
    make_flat_clip(folder / "depth.mkv", depth_rate, depth_rate, kLossless, "", 64, 48);
    const auto media = open_media(folder / "color.mkv");
    CHECK(media->description().depth_path == folder / "depth.mkv");
    CHECK(media->description().colour_columns == 96);
    CHECK(media->description().depth_columns == 64);
    const auto paired = [colour_rate = colour_rate,
                         depth_rate = depth_rate](const RawFrame& frame) {
        const double exact = static_cast<double>(frame_of(frame.depth)) * colour_rate / depth_rate;
        const int newest = static_cast<int>(std::floor(exact + 0.01));
        CHECK(frame_of(frame.colour) == std::min(newest, colour_rate - 1));
        CHECK(frame.colour.columns == 96);
        CHECK(frame.colour.rows == 40);
    };
    for (const auto& frame : all_frames(*media)) paired(frame);
    for (const double wanted_s : {0.71, 0.2, 0.95, 0.0, 0.5}) {
        media->seek(wanted_s);
        const auto frame = media->next();
        REQUIRE(frame);
        paired(*frame);
    }
}

TEST_CASE("a colour video that ends early stays on its last picture", "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "rgb.mkv", 5, 25, kLossless);
    make_flat_clip(folder / "depth.mkv", 12, 25, kLossless);
    const auto media = open_media(folder / "rgb.mkv", folder / "depth.mkv");
    const auto frames = all_frames(*media);
    REQUIRE(frames.size() == 12);
    CHECK(frame_of(frames[4].colour) == 4);
    CHECK(frame_of(frames[11].colour) == 4);
    CHECK(frame_of(frames[11].depth) == 11);
}

TEST_CASE("a video cut off in the middle is refused, and one that lacks only its last frames plays",
          "[media]") {
    const TemporaryFolder folder;
    const auto [name, encoding] =
        GENERATE(table<std::string, std::string>({{"whole.webm", kVp9},
                                                  {"whole.mkv", kLossless},
                                                  {"whole.avi", "-c:v mjpeg"},
                                                  {"whole.mp4", kH264 + " -movflags faststart"}}));
    CAPTURE(name);
    make_flat_clip(folder / name, 60, 25, encoding, "noise=alls=20:allf=t");
    const auto extension = std::filesystem::path(name).extension().string();
    const auto size = std::filesystem::file_size(folder / name);
    const auto middle = folder.path() / ("middle" + extension);
    cut(folder / name, middle, size * 6 / 10);
    CHECK_THROWS_AS(open_depth(middle), InputError);
    CHECK_THROWS_AS(describe_media(middle), InputError);

    const auto end = folder.path() / ("end" + extension);
    cut(folder / name, end, size * 97 / 100);
    const auto media = open_depth(end);
    const auto frames = all_frames(*media);
    CHECK(frames.size() > 50);
    CHECK(media->description().frames == static_cast<std::int64_t>(frames.size()));
    media->seek(100.0);
    CHECK(media->next().has_value());
}

TEST_CASE("a whole video of few frames, each shown for seconds, plays", "[media]") {
    const TemporaryFolder folder;
    const auto [frames, name, encoding] =
        GENERATE(table<int, std::string, std::string>({{1, "a.mkv", kLossless},
                                                       {3, "b.mkv", kLossless},
                                                       {1, "a.mp4", kH264},
                                                       {4, "b.mp4", kH264}}));
    CAPTURE(frames, name);
    ffmpeg("-f lavfi -i testsrc2=size=64x48:rate=0.5:duration=" + std::to_string(2 * frames) + " " +
           encoding + " '" + (folder / name).string() + "'");
    CHECK(all_frames(*open_depth(folder / name)).size() == static_cast<std::size_t>(frames));
}

TEST_CASE("a colour and a depth file are found by each other's name, written as large as they are",
          "[media]") {
    const TemporaryFolder folder;
    const auto [colour, depth] =
        GENERATE(table<std::string, std::string>({{"clip_color.mp4", "clip_depth.webm"},
                                                  {"RGB.png", "DEPTH.png"},
                                                  {"X_Color.mp4", "X_Depth.mov"}}));
    CAPTURE(colour, depth);
    std::ofstream(folder / colour) << "c";
    std::ofstream(folder / depth) << "d";
    std::string looked_for;
    CHECK(find_depth_beside(folder / colour, looked_for) == folder / depth);
    CHECK(find_colour_beside(folder / depth) == folder / colour);
    CHECK_FALSE(find_colour_beside(folder / "other.mp4"));
}

TEST_CASE("a pair of still images is a video of one frame, and 16 bits stay 16 bits", "[media]") {
    const TemporaryFolder folder;
    write_picture(folder / "rgb.png", 20, 10, 8, 3,
                  [](int i, int, int c) { return c == 2 ? 10 * i : c; });
    write_picture(folder / "depth.png", 256, 256, 16, 1,
                  [](int i, int j, int) { return 256 * j + i; });
    const auto media = open_media(folder / "rgb.png");
    CHECK(media->description().still);
    CHECK(media->description().depth_bits == 16);
    const auto frame = media->next();
    REQUIRE(frame);
    CHECK_FALSE(media->next());
    CHECK_THAT(frame->depth.highest_level, WithinAbs(65535.0, 0.0));
    int wrong = 0;
    for (std::size_t k = 0; k < frame->depth.levels.size(); ++k)
        if (frame->depth.levels[k] != static_cast<float>(k)) ++wrong;
    CHECK(wrong == 0);
    CHECK(frame->colour.rgb[3] == 10);  // red first
    CHECK(frame->colour.rgb[5] == 0);
    media->seek(3.0);
    CHECK(media->next().has_value());
}

TEST_CASE("depth in three equal channels keeps every level, in 8 and 16 bits", "[media]") {
    const TemporaryFolder folder;
    const auto [bits, channels] = GENERATE(table<int, int>({{8, 3}, {8, 4}, {16, 3}, {8, 1}}));
    CAPTURE(bits, channels);
    const int factor = bits == 16 ? 257 : 1;
    write_picture(folder / "depth.png", 256, 2, bits, channels,
                  [&, factor = factor](int i, int, int) { return factor * i; });
    const auto frame = open_depth(folder / "depth.png")->next();
    REQUIRE(frame);
    int wrong = 0;
    for (int i = 0; i < 256; ++i)
        if (frame->depth.at(i, 1) != static_cast<float>(factor * i)) ++wrong;
    CHECK(wrong == 0);
}

TEST_CASE("the depth file beside a colour file is found by its name", "[media]") {
    const TemporaryFolder folder;
    const auto [colour, depth] =
        GENERATE(table<std::string, std::string>({{"color.mp4", "depth.mp4"},
                                                  {"color_output.webm", "depth_output.webm"},
                                                  {"take2-colour.mkv", "take2-depth.webm"},
                                                  {"My_RGB_01.png", "My_DEPTH_01.png"},
                                                  {"Color.mov", "Depth.mov"}}));
    CAPTURE(colour);
    std::string looked_for;
    CHECK_FALSE(find_depth_beside(folder / colour, looked_for));
    CHECK(looked_for.find(std::filesystem::path(depth).stem().string()) != std::string::npos);
    write_text(folder / depth, "x");
    const auto found = find_depth_beside(folder / colour, looked_for);
    REQUIRE(found);
    CHECK(*found == folder / depth);
}

TEST_CASE("a media file describes itself without its partner", "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "depth.webm", 20, 10, kVp9);
    make_flat_clip(folder / "clip.mp4", 20, 10, kH264);
    const auto depth = describe_media(folder / "depth.webm");
    CHECK(depth.depth_columns == 64);
    CHECK(depth.depth_codec.starts_with("VP9"));  // OpenCV 4.10 says VP90
    CHECK(depth.frames == 20);
    CHECK_THAT(depth.duration_s, WithinAbs(2.0, 0.002));
    CHECK(depth.colour_path.empty());
    const auto clip = describe_media(folder / "clip.mp4");
    CHECK(clip.colour_rows == 48);
    CHECK(clip.frames_exact);
    CHECK(clip.depth_path.empty());
}

TEST_CASE("a still that is steep all over fits less relief than a scene or than a steep video",
          "[media]") {
    constexpr int kColumns = 320, kRows = 240;
    constexpr double kPaper_px = 255.0 / 720.0 * kColumns;
    const TemporaryFolder folder;
    cv::Mat1w bumps(kRows, kColumns), scene(kRows, kColumns);
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i) {
            const double far = std::hypot(i - 150.0, j - 120.0);
            bumps(j, i) = cv::saturate_cast<std::uint16_t>(32000.0 + 25000.0 * std::sin(0.3 * i) *
                                                                         std::cos(0.27 * j));
            scene(j, i) =
                cv::saturate_cast<std::uint16_t>(far < 80.0 ? 50000.0 - 100.0 * far : 10000.0);
        }
    const auto media_of = [&folder](const std::string& name, const cv::Mat& picture) {
        REQUIRE(cv::imwrite((folder / name).string(), picture));
        return open_depth(folder / name, {.find_out = true})->description();
    };
    const MediaDescription steep = media_of("bumps_height.png", bumps);
    REQUIRE(steep.texture_slope);
    CHECK(fit_of(steep).relief_px < 0.3 * kPaper_px);
    CHECK_THAT(fit_of(steep).relief_px * *steep.texture_slope, WithinAbs(1.0, 1e-9));
    CHECK_THAT(fit_of(media_of("scene_height.png", scene)).relief_px, WithinAbs(kPaper_px, 1e-9));
    ffmpeg("-loop 1 -i '" + (folder / "bumps_height.png").string() +
           "' -pix_fmt gray -frames:v 5 -c:v ffv1 '" + (folder / "bumps_height.mkv").string() +
           "'");
    const auto video = open_depth(folder / "bumps_height.mkv", {.find_out = true});
    CHECK_THAT(fit_of(video->description()).relief_px, WithinAbs(kPaper_px, 1e-9));
}

TEST_CASE("what lets motion be seen badly is told in a sentence, and nothing where all is well",
          "[video]") {
    MediaDescription media;
    media.colour_path = "c.mp4";
    media.depth_path = "d.mp4";
    media.frames_per_s = media.colour_frames_per_s = 30.0;
    media.duration_s = media.colour_duration_s = 2.0;
    CHECK(motion_trouble(media).empty());
    SECTION("colour of twice the rate, or longer, is fine") {
        media.colour_frames_per_s = 60.0;
        media.colour_duration_s = 9.0;
        CHECK(motion_trouble(media).empty());
    }
    SECTION("of a lower rate") {
        media.colour_frames_per_s = 25.0;
        CHECK(motion_trouble(media).find("25 pictures a second") != std::string::npos);
    }
    SECTION("shorter") {
        media.colour_duration_s = 1.5;
        CHECK(motion_trouble(media).find("ends after 1.5 s") != std::string::npos);
    }
    SECTION("a still, or none") {
        media.colour_still = true;
        CHECK(motion_trouble(media).find("is a still picture") != std::string::npos);
        media.colour_path.clear();
        CHECK(motion_trouble(media).find("without colour") != std::string::npos);
        media.still = true;
        CHECK(motion_trouble(media).empty());
    }
}
