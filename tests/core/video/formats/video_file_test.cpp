// What a video file says of its pictures arrives: every level, which way up, the shape of a pixel,
// when it begins.
extern "C" {
#include <libavutil/frame.h>
#include <libavutil/pixfmt.h>
}

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/av/objects.hpp"
#include "core/video/formats/decoded_ring.hpp"
#include "core/video/formats/video_decoder.hpp"
#include "core/video/formats/video_file.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr int kPixels = 64 * 64;  // of a picture, each another level where there are as many

/// The level of pixel k of 4096, over the whole range of so many bits.
int level_of(int k, int bits) {
    return static_cast<int>(std::lround(k * (std::ldexp(1.0, bits) - 1.0) / (kPixels - 1)));
}

struct Form {
    const char* name;
    int bits;
    bool limited;  ///< black is 16, white 235 (times 4 in 10 bits), with colours of grey
    const char* encoding;
};

std::string raw_format(const Form& form) {
    const std::string colours = form.limited ? "yuv420p" : "gray";
    return form.bits == 8 ? colours : colours + std::to_string(form.bits) + "le";
}

/// One picture of all levels as raw numbers.
void write_levels(const std::filesystem::path& file, const Form& form) {
    std::ofstream out(file, std::ios::binary);
    const auto put = [&](double level) {
        const auto number = static_cast<unsigned>(std::lround(level));
        out.put(static_cast<char>(number & 0xffU));
        if (form.bits > 8) out.put(static_cast<char>(number >> 8U));
    };
    const double step = std::ldexp(1.0, form.bits - 8);
    for (int k = 0; k < kPixels; ++k) {
        const double level = level_of(k, form.bits);
        put(form.limited ? 16.0 * step + level * 219.0 * step / (256.0 * step - 1.0) : level);
    }
    for (int k = 0; form.limited && k < kPixels / 2; ++k) put(128.0 * step);
}

/// How far a level is at most from the one that was written.
double worst_of(const DepthImage& depth, const Form& form) {
    REQUIRE(depth.levels.size() == std::size_t{kPixels});
    double worst = 0.0;
    for (int k = 0; k < kPixels; ++k) {
        const auto level = static_cast<double>(depth.levels[static_cast<std::size_t>(k)]);
        worst = std::max(worst, std::abs(level - level_of(k, form.bits)));
    }
    return worst;
}

}  // namespace

TEST_CASE("every level of a video arrives, in 8 to 16 bits, whatever the range and the byte order",
          "[media]") {
    const TemporaryFolder folder;
    const Form form = GENERATE(
        Form{"ffv1.mkv", 8, false, "-c:v ffv1 -pix_fmt gray"},
        Form{"ffv1.mkv", 10, false, "-c:v ffv1 -pix_fmt gray10le"},
        Form{"ffv1.mkv", 12, false, "-c:v ffv1 -pix_fmt gray12le"},
        Form{"ffv1.mkv", 16, false, "-c:v ffv1 -pix_fmt gray16le"},
        Form{"png.mov", 8, false, "-c:v png -pix_fmt gray"},
        Form{"png.mov", 16, false, "-c:v png -pix_fmt gray16be"},
        Form{"png.mkv", 8, false, "-c:v png -pix_fmt rgb24"},
        Form{"png.mkv", 16, false, "-c:v png -pix_fmt rgb48be"},
        Form{"raw.mov", 16, false, "-c:v rawvideo -tag:v b16g -pix_fmt gray16be"},
        Form{"raw.nut", 16, false, "-c:v rawvideo -pix_fmt gray16le"},
        Form{"x264.mp4", 8, false, "-c:v libx264 -qp 0 -pix_fmt gray"},
        Form{"x265.mp4", 10, false,
             "-c:v libx265 -x265-params lossless=1:log-level=none -pix_fmt gray10le"},
        Form{"x265.mkv", 12, false,
             "-c:v libx265 -x265-params lossless=1:log-level=none -pix_fmt gray12le"},
        Form{"full.mkv", 8, false,
             "-c:v libx264 -qp 0 -vf scale=out_range=full -color_range pc -pix_fmt yuv420p"},
        Form{"limited.mkv", 8, true, "-c:v libx264 -qp 0"},
        Form{"limited.webm", 10, true, "-c:v libvpx-vp9 -lossless 1"},
        Form{"limited.mkv", 10, true, "-c:v ffv1"});
    CAPTURE(form.name, form.bits, form.encoding);
    const auto raw = folder / "raw";
    const auto file = folder / form.name;
    write_levels(raw, form);
    ffmpeg("-f rawvideo -pix_fmt " + raw_format(form) + " -s 64x64 -i '" + raw.string() + "' " +
           form.encoding + " '" + file.string() + "'");
    const auto media = open_depth(file);
    const auto frame = media->next();
    REQUIRE(frame);
    CHECK(media->description().depth_bits == form.bits);
    CHECK(frame->depth.highest_level == std::ldexp(1.0, form.bits) - 1.0);
    CHECK(worst_of(frame->depth, form) <=
          (form.limited ? 0.6 : 0.0));  // of whose levels there are fewer
}

TEST_CASE("a video that was recorded with the camera turned is turned back, depth and colour",
          "[media]") {
    const TemporaryFolder folder;
    const auto [degrees, level] =
        GENERATE(table<int, double>({{0, 10.0}, {90, 160.0}, {180, 210.0}, {270, 60.0}}));
    // Corners of 10, 60, 210 and 160, clockwise from the upper left.
    ffmpeg(
        "-f lavfi -i color=black:s=80x60:r=10:d=0.3,format=gray,"
        "geq=lum='if(lt(X\\,40)\\,if(lt(Y\\,30)\\,10\\,160)\\,if(lt(Y\\,30)\\,60\\,210))' "
        "-c:v ffv1 -pix_fmt gray '" +
        (folder / "plain.mov").string() + "'");
    turn(folder / "plain.mov", folder / "turned.mov", degrees);
    CAPTURE(degrees);
    const auto frame = open_media(folder / "turned.mov", folder / "turned.mov")->next();
    REQUIRE(frame);
    CHECK((frame->depth.columns == 80) == (degrees % 180 == 0));
    CHECK(frame->depth.at(2, 2) == static_cast<float>(level));
    CHECK(frame->colour.columns == frame->depth.columns);
    CHECK(frame->colour.rgb.front() == static_cast<std::uint8_t>(level));
}

TEST_CASE(
    "pixels that are not square are shown square, depth and colour, and no data stays no data",
    "[media]") {
    const TemporaryFolder folder;
    const auto [aspect, columns, rows] = GENERATE(
        table<std::string, int, int>({{"2/1", 128, 60}, {"1/2", 64, 120}, {"1/1", 64, 60}}));
    CAPTURE(aspect);
    // A slope along the long side, and no data beside it.
    const std::string file = (folder / "squeezed.mkv").string();
    ffmpeg(
        "-f lavfi -i color=black:s=64x60:r=10:d=0.3,format=gray,"
        "geq=lum='if(gt(X\\,55)\\,0\\,60+2*X+Y)',setsar=" +
        aspect + " -c:v ffv1 -pix_fmt gray '" + file + "'");
    const auto frame = open_media(file, file)->next();
    REQUIRE(frame);
    REQUIRE(frame->depth.columns == columns);
    REQUIRE(frame->depth.rows == rows);
    CHECK(frame->colour.columns == columns);
    CHECK(frame->colour.rows == rows);
    const double across = 2.0 * 64 / columns;
    const double down = 60.0 / rows;
    const double begin = 60.0 + (across - 2.0) / 2.0 + (down - 1.0) / 2.0;  // pixels have a middle
    double worst = 0.0;
    int between = 0;
    for (int j = 2; j + 2 < rows; ++j) {
        for (int i = 2; i + 2 < columns; ++i) {
            const auto level = static_cast<double>(frame->depth.at(i, j));
            const bool of_slope = i < 54 * columns / 64;
            if (of_slope)
                worst = std::max(worst, std::abs(level - (begin + across * i + down * j)));
            if (level > 0.0 && level < 60.0) ++between;
        }
    }
    CHECK(worst <= 0.5);
    CHECK(between == 0);
}

TEST_CASE("colour that begins later than depth by its file's clock is shown later", "[media]") {
    const TemporaryFolder folder;
    const auto [name, colour_s, depth_s, later] =
        GENERATE(table<std::string, double, double, int>({{"mkv", 0.0, 0.0, 0},
                                                          {"mkv", 0.4, 0.0, 4},
                                                          {"mp4", 0.4, 0.0, 4},
                                                          {"mkv", 0.0, 0.3, -3},
                                                          {"mkv", 50.0, 0.0, 0},
                                                          {"ts", 0.4, 0.0, 0}}));
    CAPTURE(name, colour_s, depth_s);
    const auto begin_at = [&folder, ending = name](const std::string& what, double start_s) {
        const auto plain = folder / (what + "_plain." + ending);
        const auto shifted = folder / (what + "." + ending);
        make_flat_clip(plain, 20, 10, "-c:v libx264 -qp 0 -bf 0 -pix_fmt yuv420p");
        if (start_s == 0.0) return plain;
        ffmpeg("-itsoffset " + std::to_string(start_s) + " -i '" + plain.string() + "' -c copy '" +
               shifted.string() + "'");
        return shifted;
    };
    const auto media = open_media(begin_at("colour", colour_s), begin_at("depth", depth_s));
    int told = 0;
    while (const auto frame = media->next()) {
        const auto depth = std::lround(frame->depth.at(30, 20) / 5.0F);
        const auto colour = std::lround(frame->colour.rgb[frame->colour.rgb.size() / 2] / 5.0);
        CHECK(colour == std::clamp(depth - later, 0L, 19L));
        ++told;
    }
    CHECK(told == 20);
}

TEST_CASE("pictures that wait for others to be decoded are no later for it", "[media]") {
    const TemporaryFolder folder;
    const std::string waiting = "-c:v libx264 -crf 4 -bf 2 -b_strategy 0 -g 12 -pix_fmt yuv420p ";
    const auto [ending, container] =
        GENERATE(table<std::string, std::string>({{"mp4", ""},
                                                  {"mp4", "-use_editlist 0"},
                                                  {"mp4", "-movflags frag_keyframe+empty_moov"},
                                                  {"mov", "-movflags frag_every_frame"},
                                                  {"nut", ""},
                                                  {"flv", ""},
                                                  {"mkv", ""}}));
    CAPTURE(ending, container);
    make_flat_clip(folder / ("clip_color." + ending), 20, 10, waiting + container);
    make_flat_clip(folder / "clip_depth.mkv", 20, 10, kLossless);
    const auto media = open_media(folder / ("clip_color." + ending), folder / "clip_depth.mkv");
    CHECK(media->description().timing == "in the file");
    int told = 0;
    while (const auto frame = media->next()) {
        CHECK(std::lround(frame->colour.rgb[frame->colour.rgb.size() / 2] / 5.0) ==
              std::lround(frame->depth.at(30, 20) / 5.0F));
        ++told;
    }
    CHECK(told == 20);
}

TEST_CASE("frames that are passed over change nothing of those after them", "[media]") {
    const TemporaryFolder folder;
    const int colours_per_s = GENERATE(30, 60);
    make_flat_clip(folder / "colour.mp4", colours_per_s, colours_per_s, kH264);
    make_flat_clip(folder / "depth.mp4", 40, 30, kH264);
    const auto open = [&] { return open_media(folder / "colour.mp4", folder / "depth.mp4"); };
    std::vector<RawFrame> all;
    const auto every = open();
    while (auto frame = every->next()) all.push_back(std::move(*frame));
    REQUIRE(all.size() == 40);
    CHECK(all.back().skipping_s > 0.0);

    const auto few = open();
    std::size_t at = 0;
    for (const int on : {0, 1, 2, 7, 1, 3, 12, 1, 4, 100}) {
        at = std::min(at + static_cast<std::size_t>(on), all.size() - 1);
        CAPTURE(at);
        const auto frame = few->next_from(on == 100 ? 100.0 : all[at].media_s - 0.01);
        REQUIRE(frame);
        CHECK(frame->index == all[at].index);
        CHECK(frame->media_s == all[at].media_s);
        CHECK(frame->depth.levels == all[at].depth.levels);
        CHECK(frame->colour.rgb == all[at].colour.rgb);
    }
    CHECK_FALSE(few->next_from(100.0));
    CHECK_FALSE(few->next());
    for (const std::size_t to : {4U, 5U, 6U, 20U}) {  // a jump leaves some that are there already
        few->seek(all[4].media_s);
        const auto frame = few->next_from(all[to].media_s - 0.01);
        REQUIRE(frame);
        CHECK(frame->index == all[to].index);
        CHECK(frame->depth.levels == all[to].depth.levels);
        CHECK(frame->colour.rgb == all[to].colour.rgb);
    }
}

TEST_CASE("a picture stays as it is while those after it are decoded", "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "clip.mkv", 50, 25, GENERATE(kLossless, kH264));
    VideoDecoder decoder(folder / "clip.mkv", 0);
    REQUIRE(decoder.decode());
    const cv::Mat levels = decoder.levels();
    const cv::Mat colour = decoder.colour();
    const cv::Mat levels_then = levels.clone();
    const cv::Mat colour_then = colour.clone();
    while (decoder.decode()) {
    }
    CHECK(cv::norm(levels, levels_then, cv::NORM_INF) == 0.0);
    CHECK(cv::norm(colour, colour_then, cv::NORM_INF) == 0.0);
}

TEST_CASE("a run-up skips non-reference pictures, and tells their times", "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "clip.mkv", 50, 25, kRareKeys);
    std::vector<double> all_s;
    VideoDecoder every(folder / "clip.mkv", 0);
    while (every.decode()) {
        CHECK(every.skipped_s().empty());
        all_s.push_back(every.time_s());
    }
    REQUIRE(all_s.size() == 50);

    VideoDecoder few(folder / "clip.mkv", 0);
    const double from_s = 1.2;
    few.skip_non_reference_before(from_s);
    std::vector<double> told_s;
    std::size_t decoded = 0;
    const auto tell_skipped = [&] {
        for (const double time_s : few.skipped_s()) {
            CHECK(time_s < from_s);
            told_s.push_back(time_s);
        }
    };
    while (few.decode()) {
        tell_skipped();
        told_s.push_back(few.time_s());
        ++decoded;
    }
    tell_skipped();
    CHECK(told_s == all_s);
    CHECK(decoded <= 40);  // 20 and half of 30
    REQUIRE(few.jump(0.0));
    for (const double time_s : all_s) {
        REQUIRE(few.decode());
        CHECK(few.time_s() == time_s);
    }
}

TEST_CASE("a seek far beyond a key frame decodes few of the pictures that are between", "[media]") {
    const TemporaryFolder folder;
    // Eight of nine pictures are non-reference ones.
    make_flat_clip(folder / "clip.mp4", 120, 25,
                   "-c:v libx264 -crf 18 -bf 8 -b_strategy 0 -x264-params b-pyramid=none "
                   "-sc_threshold 0 -g 250 -pix_fmt yuv420p");
    VideoFile whole(folder / "clip.mp4", PictureRole::depth);
    while (whole.next()) {
    }
    CHECK(whole.decoded() == 120);
    VideoFile file(folder / "clip.mp4", PictureRole::depth);
    const auto before = file.decoded();
    file.seek(4.6);
    REQUIRE(file.next());
    CHECK(file.decoded() - before <= 40);  // of 116
}

namespace {

/// Each of its pictures as it comes when all are read in order.
std::vector<TimedPicture> all_pictures(const std::filesystem::path& file, PictureRole role) {
    std::vector<TimedPicture> all;
    VideoFile whole(file, role);
    while (auto picture = whole.next()) all.push_back(std::move(*picture));
    return all;
}

void check_same(const std::optional<TimedPicture>& taken, const TimedPicture& expected) {
    REQUIRE(taken);
    CHECK(taken->index == expected.index);
    CHECK(taken->time_s == expected.time_s);
    CHECK(cv::norm(taken->picture, expected.picture, cv::NORM_INF) == 0.0);
}

}  // namespace

TEST_CASE("whatever was decoded before, a seek gives the frame shown then, and its followers",
          "[media]") {
    const TemporaryFolder folder;
    const auto role = GENERATE(PictureRole::depth, PictureRole::colour);
    make_flat_clip(folder / "clip.mkv", 50, 25, GENERATE(kLossless, kH264, kRareKeys, kVp9));
    const std::vector<TimedPicture> all = all_pictures(folder / "clip.mkv", role);
    REQUIRE(all.size() == 50);
    VideoFile file(folder / "clip.mkv", role);
    std::size_t at = 0;
    for (const std::size_t to :
         {0U, 40U, 39U, 38U, 45U, 44U, 3U, 2U, 4U, 49U, 48U, 47U, 20U, 19U}) {
        CAPTURE(at, to);
        file.seek(all[to].time_s);
        for (at = to; at < std::min<std::size_t>(to + 4, all.size()); ++at)
            check_same(file.next(), all[at]);
    }
    file.seek(all[46].time_s);
    for (at = 46; at < all.size(); ++at) check_same(file.next(), all[at]);
    CHECK_FALSE(file.next());
    file.seek(all[48].time_s);  // from the end
    check_same(file.next_from(all[49].time_s), all[49]);
}

TEST_CASE("a step back in a group of 250 pictures decodes the group once, for many more steps",
          "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "clip.mp4", 250, 25, kRareKeys);
    const std::vector<TimedPicture> all = all_pictures(folder / "clip.mp4", PictureRole::depth);
    REQUIRE(all.size() == 250);
    VideoFile file(folder / "clip.mp4", PictureRole::depth);
    file.seek(all[240].time_s);
    check_same(file.next(), all[240]);
    std::size_t groups = 0;
    for (std::size_t k = 240; k-- > 0;) {
        CAPTURE(k);
        const std::int64_t before = file.decoded();
        file.seek(all[k].time_s);
        check_same(file.next(), all[k]);
        const std::int64_t decoded = file.decoded() - before;
        CHECK(decoded <= static_cast<std::int64_t>(k) + 2);  // from the key frame on
        groups += decoded > 0 ? 1 : 0;
    }
    CHECK(groups <= 240 / (DecodedRing::kMostPictures - 4));
    const std::int64_t then = file.decoded();
    for (std::size_t k = 1; k < 20; ++k) {
        file.seek(all[k].time_s);
        check_same(file.next(), all[k]);
    }
    CHECK(file.decoded() == then);
}

TEST_CASE("decoded pictures are kept within bounds of number and bytes, the newest ones",
          "[media]") {
    const int side = GENERATE(16, 500, 4000, 11000);
    const AvOwned<AVFrame> frame = new_frame();
    allocate_buffer(*frame, AV_PIX_FMT_GRAY8, side, side);
    DecodedRing ring;
    ring.keep_few(false);
    constexpr int kAdded = 300;
    for (int k = 0; k < kAdded; ++k) {
        ring.add(*frame, k, k);
        CHECK(ring.bytes() <= DecodedRing::kMostBytes);
        CHECK(ring.size() <= DecodedRing::kMostPictures);
    }
    CHECK(ring.size() == ring.room());
    CHECK((ring.size() == 0) == (side == 11000));
    CHECK_FALSE(ring.place_at(kAdded - 1.0));  // how long it is shown is not known
    if (ring.size() < 2) return;
    const auto place = ring.place_at(kAdded - 1.5);
    REQUIRE(place);
    CHECK(ring.picture(*place).index == kAdded - 2);
    CHECK_FALSE(ring.place_at(ring.picture(0).time_s - 0.5));
    ring.clear();
    CHECK(ring.bytes() == 0);
}

TEST_CASE("of large pictures few are held while they play, and more after a step back", "[media]") {
    const AvOwned<AVFrame> frame = new_frame();
    allocate_buffer(*frame, AV_PIX_FMT_YUV420P, 3840, 2160);
    DecodedRing ring;
    const auto add = [&](bool few) {
        ring.keep_few(few);
        for (int k = 0; k < 30; ++k) ring.add(*frame, k, k);
        return ring.bytes();
    };
    const std::size_t one = add(true);
    CHECK(ring.size() == 1);  // a single one is larger than kFewBytes
    CHECK(one > DecodedRing::kFewBytes);
    CHECK(add(false) > 6 * one);
    CHECK(ring.size() == ring.room());
    CHECK(add(true) == one);
}

TEST_CASE("the first of all samples is the first frame, whatever was read before", "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "clip.mp4", 20, 25, kH264);
    const std::vector<TimedPicture> all = all_pictures(folder / "clip.mp4", PictureRole::depth);
    VideoFile file(folder / "clip.mp4", PictureRole::depth);
    for (const int most : {1, 30, 1, 5, 1}) {
        const std::vector<cv::Mat> samples = file.samples(most);
        REQUIRE(!samples.empty());
        CHECK(samples.size() <= static_cast<std::size_t>(most));
        CHECK(cv::norm(samples.front(), all.front().picture, cv::NORM_INF) == 0.0);
        check_same(file.next(), all[0]);
        file.seek(0.0);
    }
}

TEST_CASE("samples of a long film of large pictures are its key frames, decoded alone", "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "clip.mp4", 120, 25, kH264 + " -sc_threshold 0",
                   "scale=1280:800:flags=neighbor");
    VideoFile file(folder / "clip.mp4", PictureRole::depth);
    const std::int64_t before = file.decoded();
    const std::vector<cv::Mat> samples = file.samples(6);
    CHECK(file.decoded() - before <= 8);  // with the first two again
    const std::vector<TimedPicture> all = all_pictures(folder / "clip.mp4", PictureRole::depth);
    REQUIRE(samples.size() == 6);
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const std::size_t key = k * all.size() / samples.size() / 12 * 12;
        CHECK(cv::norm(samples[k], all[key].picture, cv::NORM_INF) == 0.0);
    }
    check_same(file.next(), all[0]);
}

TEST_CASE("frames for a reader of depth alone come without colour, with the same depth",
          "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "colour.mp4", 30, 30, kH264);
    make_flat_clip(folder / "depth.mp4", 30, 30, kH264);
    const auto media = open_media(folder / "colour.mp4", folder / "depth.mp4");
    std::vector<RawFrame> all;
    while (auto frame = media->next()) all.push_back(std::move(*frame));
    media->seek_depth(0.0);
    for (std::size_t k = 0; k < 10; ++k) {
        const auto frame = media->next();
        REQUIRE(frame);
        CHECK(frame->colour.rgb.empty());
        CHECK(frame->depth.levels == all[k].depth.levels);
        CHECK(frame->media_s == all[k].media_s);
    }
    media->seek(all[5].media_s);
    const auto whole = media->next();
    REQUIRE(whole);
    CHECK(whole->colour.rgb == all[5].colour.rgb);
    CHECK(whole->depth.levels == all[5].depth.levels);
}

TEST_CASE("pictures that are left out are not decoded where none refers to them", "[media]") {
    const TemporaryFolder folder;
    // Three of four pictures are non-reference ones; the last one is among them.
    make_flat_clip(folder / "clip.mp4", 99, 25,
                   "-c:v libx264 -crf 18 -bf 3 -b_strategy 0 -x264-params b-pyramid=none "
                   "-sc_threshold 0 -g 250 -pix_fmt yuv420p");
    std::vector<TimedPicture> all;
    VideoFile whole(folder / "clip.mp4", PictureRole::depth);
    while (auto picture = whole.next()) all.push_back(std::move(*picture));
    REQUIRE(all.size() == 99);
    const std::size_t every = GENERATE(2U, 3U, 5U, 12U);
    CAPTURE(every);
    VideoFile file(folder / "clip.mp4", PictureRole::depth);
    const auto before = file.decoded();
    std::int64_t decoded = 0;
    for (std::size_t at = every; at < all.size(); at += every) {
        const auto picture = file.next_from(all[at].time_s - kTimeTolerance_s);
        REQUIRE(picture);
        CHECK(picture->index == static_cast<std::int64_t>(at));
        CHECK(cv::norm(picture->picture, all[at].picture, cv::NORM_INF) == 0.0);
        decoded = file.decoded() - before;
    }
    // The decoder has the next few pictures already.
    CHECK(decoded <= (every < 5 ? 98 : 80));
    file.seek(all[90].time_s);
    const auto last = file.next_from(100.0);
    REQUIRE(last);
    CHECK(last->index == 98);
    CHECK(cv::norm(last->picture, all.back().picture, cv::NORM_INF) == 0.0);
    CHECK_FALSE(file.next());
    CHECK(file.facts().frames == 99);
    file.seek(all[25].time_s);
    const auto picture = file.next();
    REQUIRE(picture);
    CHECK(picture->index == 25);
}

TEST_CASE("a film that was cut without coding it again begins at 0, and counts what is shown",
          "[media]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "whole.mp4", 60, 25, kRareKeys);
    const auto file = folder / "part.mp4";
    ffmpeg("-ss 0.36 -i '" + (folder / "whole.mp4").string() + "' -c copy '" + file.string() + "'");
    const auto media = open_depth(file);
    std::vector<double> times_s;
    while (const auto frame = media->next()) {
        CHECK(frame->index == static_cast<std::int64_t>(times_s.size()));
        times_s.push_back(frame->media_s);
    }
    REQUIRE(times_s.size() >= 45);
    CHECK(times_s.front() >= 0.0);
    const auto again = open_depth(file);
    for (const std::size_t k : {30U, 5U, 38U}) {
        again->seek(times_s[k]);
        const auto frame = again->next();
        REQUIRE(frame);
        CHECK(frame->media_s == times_s[k]);
        CHECK(frame->index == static_cast<std::int64_t>(k));
    }
}

TEST_CASE("frames that are unevenly spaced are counted and numbered before all was decoded",
          "[media]") {
    const TemporaryFolder folder;
    const std::string uneven = "select='lt(mod(n,30),7)+eq(mod(n,30),20)'";
    const auto [name, encoding] = GENERATE(table<std::string, std::string>(
        {{"uneven.webm", kVp9}, {"uneven.mkv", kLossless}, {"uneven.mp4", kH264}}));
    CAPTURE(name);
    make_flat_clip(folder / name, 80, 25, encoding, uneven);
    const auto media = open_depth(folder / name);
    const MediaDescription opened = media->description();
    CHECK(opened.frames == 80);
    CHECK(opened.frames_per_s < 10.0);
    media->seek(opened.duration_s);
    CHECK(media->next()->index == 79);
    std::vector<double> times_s;
    const auto whole = open_depth(folder / name);
    while (const auto frame = whole->next()) times_s.push_back(frame->media_s);
    REQUIRE(times_s.size() == 80);
    for (const std::size_t k : {70U, 9U, 44U}) {
        const auto again = open_depth(folder / name);
        again->seek(times_s[k]);
        CHECK(again->next()->index == static_cast<std::int64_t>(k));
    }
}

TEST_CASE("a file of a colour and a depth track is opened as both, whichever comes first",
          "[media]") {
    const TemporaryFolder folder;
    const auto [first, second, title] = GENERATE(table<std::string, std::string, std::string>(
        {{"rgb", "gray16", ""}, {"gray16", "rgb", ""}, {"rgb", "rgb", "Depth"}}));
    CAPTURE(first, second, title);
    // Colour is 200, depth a quarter of the highest level.
    const auto source = [](const std::string& kind) {
        const std::string grey = kind == "gray16" ? "0x404040" : "0xc8c8c8";
        return "-f lavfi -i color=" + grey + ":s=64x48:r=10:d=0.5 ";
    };
    const auto coding = [](const std::string& kind, int track) {
        const std::string n = std::to_string(track);
        return "-map " + n + " -c:v:" + n + " ffv1 -pix_fmt:v:" + n + " " +
               (kind == "gray16" ? "gray16le " : "bgr0 ");
    };
    const auto file = folder / "both.mkv";
    ffmpeg(source(first) + source(second) + coding(first, 0) + coding(second, 1) +
           "-metadata:s:v:1 title='" + title + "' '" + file.string() + "'");
    for (const auto& depth_file : {std::filesystem::path{}, file}) {
        const auto media = open_media(file, depth_file);
        const auto frame = media->next();
        REQUIRE(frame);
        const bool deep = title.empty();
        CHECK(media->description().depth_bits == (deep ? 16 : 8));
        const double grey = deep ? 64.0 * 257.0 : 200.0;  // as ffmpeg's filter rounds it
        CHECK(std::abs(static_cast<double>(frame->depth.at(9, 9)) - grey) < 0.004 * grey);
        CHECK(frame->colour.rgb.front() == 200);
    }
    CHECK(open_depth(file)->next()->colour.rgb.empty());
    const MediaDescription told = describe_media(file);
    CHECK(told.colour_columns == 64);
    CHECK(told.depth_columns == 64);
    CHECK(told.frames == 5);
}

TEST_CASE("a film of two angles is no colour and depth", "[media]") {
    const TemporaryFolder folder;
    const auto file = folder / "film.mkv";
    ffmpeg(
        "-f lavfi -i testsrc=s=64x48:r=10:d=0.5 -f lavfi -i testsrc2=s=64x48:r=10:d=0.5 -map 0 "
        "-map 1 -c:v ffv1 -pix_fmt yuv420p '" +
        file.string() + "'");
    CHECK(refusal([&] { (void)open_media(file); }).find("needs a depth file") != std::string::npos);
}

TEST_CASE("a recording of an Azure Kinect gives its colour, and its depth in millimetres",
          "[media]") {
    const TemporaryFolder folder;
    const auto made = folder / "made.mkv";
    const std::string raw = folder / "levels";
    const Form form{"", 16, false, ""};
    write_levels(raw, form);
    const std::string levels = "-f rawvideo -pix_fmt gray16le -s 64x64 -r 10 -i '" + raw + "' ";
    ffmpeg(
        "-f lavfi -i color=0xc8c8c8:s=64x48:r=10:d=0.1 " + levels + levels +
        "-map 0 -map 1 -map 2 -c:v:0 mjpeg -c:v:1 rawvideo -c:v:2 rawvideo -pix_fmt:v:1 gray16be "
        "-pix_fmt:v:2 gray16be -allow_raw_vfw 1 -metadata:s:v:0 title=COLOR "
        "-metadata:s:v:1 title=DEPTH -metadata:s:v:2 title=IR '" +
        made.string() + "'");
    // The device's own name for big-endian grey, which ffmpeg reads but does not write.
    std::string bytes = read_text(made);
    const std::string header("\x01\x00\x10\x00\x00\x00\x00\x00", 8);  // planes, bits, no name
    for (auto at = bytes.find(header); at != std::string::npos; at = bytes.find(header, at + 8))
        bytes.replace(at + 4, 4, "b16g");
    const auto file = folder / "kinect.mkv";
    write_text(file, bytes);
    const auto frame = open_media(file)->next();
    REQUIRE(frame);
    CHECK(frame->colour.columns == 64);
    CHECK(frame->colour.rows == 48);
    CHECK(worst_of(frame->depth, form) == 0.0);
}
