// Colour and depth of one moment together, whoever says when a frame is: numbers shown in both,
// read at random times and by a reader that skips frames.
#include "core/video/sources/pair_times.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/video_file.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/sources/layouts/picture_times.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/sidecar.hpp"
#include "tests/core/video/bag_writers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/core/video/numbered_film.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
namespace fs = std::filesystem;

namespace {

constexpr int kTimes = 30;  ///< random times
/// Every third interval is twice as long.
const std::string kUneven = "setpts='N+floor(N/3)'";

DepthRequest as_a_person_opens() {
    return {.find_out = true, .command_line = numbered_depth_meaning()};
}

/// The same for a grey video.
DepthRequest as_grey_video() {
    return {.find_out = true,
            .command_line = {.near = NearLevels::bright,
                             .unit = DepthUnit::levels,
                             .scale = 1.0,
                             .range = DepthRange{255.0, 0.0},
                             .no_data = std::vector<double>{}}};
}

/// "00005" for five digits.
std::string digits(int number, int count) {
    const std::string text = std::to_string(number);
    return std::string(static_cast<std::size_t>(count) - text.size(), '0') + text;
}

/// When each frame of a clip is shown, by decoding all of it.
std::vector<double> decoded_times_s(const fs::path& clip) {
    VideoFile video(clip, PictureRole::colour);
    std::vector<double> times_s;
    while (const auto picture = video.next()) times_s.push_back(picture->time_s);
    return times_s;
}

/// When the pictures of each number are, of depth and of colour, by one clock that begins with the
/// depth's first picture.
struct Moments {
    std::vector<double> depth_s{};
    std::vector<double> colour_s{};
};

/// Each number is the same moment in colour and depth, which begins at `begin_s` of these times.
Moments same_moments(std::vector<double> times_s, double begin_s = 0.0) {
    for (double& time_s : times_s) time_s -= begin_s;
    return {times_s, times_s};
}

/// So many moments, the first one at `begin_s`.
std::vector<double> even_s(int count, double frames_per_s, double begin_s = 0.0) {
    std::vector<double> moments_s;
    for (int k = 0; k < count; ++k) moments_s.push_back(begin_s + k / frames_per_s);
    return moments_s;
}

/// The depth is of its time, and no colour picture is nearer to it than the one it is shown with:
/// they are at most half a frame of the colour apart, while it lasts.
void check_together(const RawFrame& frame, const Moments& moments) {
    constexpr double kRounding_s = 0.0006;  // of a time of a container in ms
    const auto depth = static_cast<std::size_t>(number_in(frame.depth));
    const auto colour = static_cast<std::size_t>(number_in(frame.colour));
    CAPTURE(depth, colour, frame.media_s);
    REQUIRE(depth < moments.depth_s.size());
    REQUIRE(colour < moments.colour_s.size());
    const double depth_s = moments.depth_s[depth];
    CHECK_THAT(frame.media_s, WithinAbs(depth_s, kRounding_s));
    double nearest_s = std::fabs(moments.colour_s[colour] - depth_s);
    const double apart_s = nearest_s;
    for (const double colour_s : moments.colour_s)
        nearest_s = std::min(nearest_s, std::fabs(colour_s - depth_s));
    CHECK(apart_s <= nearest_s + 4.0 * kRounding_s);
}

/// At random times, and where only some frames are read: the depth shown at that time, and the
/// colour of its moment.
void check_pair(Media& media, const Moments& moments) {
    const double length_s = media.description().duration_s;
    std::mt19937 random(41);
    for (int trial = 0; trial < kTimes; ++trial) {
        const double wanted_s = std::uniform_real_distribution(0.0, length_s)(random);
        CAPTURE(trial, wanted_s);
        media.seek(wanted_s);
        const auto frame = media.next();
        REQUIRE(frame);
        CHECK(frame->media_s <= wanted_s + kTimeTolerance_s);
        check_together(*frame, moments);
        if (const auto follower = media.next()) {
            CHECK(follower->media_s > wanted_s);
            check_together(*follower, moments);
        }
        media.seek_near(wanted_s);
        const auto near = media.next();
        REQUIRE(near);
        check_together(*near, moments);
    }
    // A machine that is too slow shows only some frames.
    media.seek(0.0);
    for (double wanted_s = 0.0; wanted_s < length_s;) {
        const auto frame = media.next_from(wanted_s);
        if (!frame) break;
        check_together(*frame, moments);
        wanted_s = frame->media_s + std::uniform_real_distribution(0.02, 0.2)(random);
    }
}

void check_pair(Media& media, const std::vector<double>& times_s, double begin_s = 0.0) {
    check_pair(media, same_moments(times_s, begin_s));
}

/// A colour clip, and a folder of depth pictures beside it.
struct Pair {
    TemporaryFolder folder{};
    fs::path clip{};
    std::vector<double> times_s{};

    Pair(const std::string& name, int frames, const std::string& rate, const std::string& encoding,
         const std::string& filter = "")
        : clip(folder / name) {
        make_numbered_clip(clip, frames, rate, encoding, filter);
        times_s = decoded_times_s(clip);
        REQUIRE(times_s.size() == static_cast<std::size_t>(frames));
    }
    /// Depth that shows `number`, called `name`.
    void depth(const std::string& name, int number) const {
        write_numbered_depth(folder / "depth" / (name + ".png"), number);
    }
    [[nodiscard]] std::unique_ptr<Media> open(
        const DepthRequest& request = as_a_person_opens()) const {
        return open_media(clip, folder / "depth", request);
    }
};

PictureRow row_of_names(const std::vector<std::string>& names) {
    PictureRow row;
    for (const std::string& name : names) row.push_back(numbered(fs::path("depth") / name));
    return row;
}

}  // namespace

TEST_CASE("the times of a video's pictures are known by its packets", "[pair_times]") {
    const TemporaryFolder folder;
    const auto [name, encoding] = GENERATE(table<std::string, std::string>(
        {{"a.mkv", kLossless},
         {"a.mp4", kH264},
         {"a.mp4", kH264 + " -use_editlist 0"},
         {"a.mp4", kH264 + " -movflags frag_keyframe+empty_moov"},
         {"a.nut", kH264},
         {"a.flv", kH264},
         {"a.ts", kH264},
         {"a.avi", "-c:v mjpeg -pix_fmt yuvj420p"},
         {"a.webm", kVp9},
         {"a.webm", "-c:v libvpx -auto-alt-ref 1 -lag-in-frames 16 -b:v 200k -pix_fmt yuv420p"}}));
    CAPTURE(name, encoding);
    make_numbered_clip(folder / name, 40, "25", encoding);
    VideoFile video(folder / name, PictureRole::colour);
    CHECK(video.picture_times_s() == decoded_times_s(folder / name));
}

TEST_CASE("as many pictures as a video has frames are shown with them, at any rate, even or not",
          "[pair_times]") {
    const auto [name, rate, encoding, filter] =
        GENERATE(table<std::string, std::string, std::string, std::string>(
            {{"rgb.mp4", "60", kH264, ""},
             {"rgb.mp4", "30000/1001", kH264, ""},
             {"rgb.mp4", "25", kH264, kUneven},
             {"rgb.mkv", "25", kH264, kUneven},
             {"rgb.mp4", "25", kRareKeys, kUneven},
             {"rgb.webm", "25", kVp9, kUneven}}));
    const int first = GENERATE(0, 1);
    CAPTURE(name, rate, filter, first);
    const Pair pair(name, 60, rate, encoding, filter);
    for (int k = 0; k < 60; ++k) pair.depth("depth_" + digits(k + first, 5), k);
    const auto media = pair.open();
    const MediaDescription& told = media->description();
    CHECK(told.times_from == "other");
    CHECK(contains(told.timing, shown(name) + ", frame by frame"));
    CHECK(told.notice.empty());
    REQUIRE(told.meaning);
    CHECK(told.meaning->times == Known<DepthTimes>{DepthTimes::paired, Origin::found});
    CHECK(told.frames == 60);
    check_pair(*media, pair.times_s);
}

TEST_CASE("a video and the folder of its depth are found by either, whatever they are called",
          "[pair_times]") {
    const TemporaryFolder folder;
    const auto [colour, depth] =
        GENERATE(table<std::string, std::string>({{"rgb.mp4", "depth/"},
                                                  {"Color.mp4", "Depth/"},
                                                  {"video.mp4", "depths/"},
                                                  {"movie.mp4", "depth_png/"},
                                                  {"take1_rgb.mp4", "take1_depth/"},
                                                  {"IMG_1234.mp4", "depth maps/"},
                                                  {"rgb.mp4", "depth_"},  // in the same folder
                                                  {"rgb/", "depth.mkv"},
                                                  {"frames/", "take_depth.mkv"},
                                                  {"colour/", "clip_depth.mkv"}}));
    CAPTURE(colour, depth);
    const fs::path take = folder / "take";
    fs::create_directory(take);
    const bool is_depth_video = depth.ends_with(".mkv");
    const std::string& film = is_depth_video ? depth : colour;
    make_numbered_clip(take / film, 40, "25", is_depth_video ? kLossless : kH264, kUneven);
    for (int k = 0; k < 40; ++k) {
        const std::string name = (is_depth_video ? colour : depth) + digits(k, 4) + ".png";
        if (is_depth_video)
            write_numbered_colour(take / name, k);
        else
            write_numbered_depth(take / name, k);
    }
    write_text(take / "odometry.txt", "nothing\n");
    fs::create_directory(take / "confidence");
    write_numbered_depth(take / "confidence" / "0001.png", 3);
    const bool by_folder = GENERATE(true, false);
    // Without a word for it nobody knows which video is colour of pictures in the same folder.
    if (!by_folder && depth == "depth_") {
        CHECK_THROWS_AS(open_media(take / film), InputError);
        return;
    }
    const auto media = open_media(
        by_folder ? take : take / fs::path(colour).parent_path() / fs::path(colour).filename(), {},
        is_depth_video ? as_grey_video() : as_a_person_opens());
    CHECK_FALSE(media->description().colour_path.empty());
    check_pair(*media, decoded_times_s(take / film));
}

TEST_CASE("where pictures are colour and depth already, a video beside them is neither",
          "[pair_times]") {
    const TemporaryFolder folder;
    make_numbered_clip(folder / "rgb.mp4", 40, "25", kH264);
    for (int k = 0; k < 8; ++k) {
        write_numbered_depth(folder / "depth" / (digits(k, 4) + ".png"), k);
        write_numbered_colour(folder / "rgb" / (digits(k, 4) + ".png"), k);
    }
    const auto media = open_media(folder.path(), {}, as_a_person_opens());
    CHECK(media->description().colour_path == folder.path());
    check_pair(*media, even_s(8, 30.0));
}

TEST_CASE("a folder of depth belongs to no video where it may belong to several", "[pair_times]") {
    const TemporaryFolder folder;
    for (const char* const name : {"a.mp4", "b.mp4"})
        make_numbered_clip(folder / name, 8, "25", kH264);
    for (const char* const name : {"x_depth", "b_depth"})
        for (int k = 0; k < 8; ++k)
            write_numbered_depth(folder / name / (digits(k, 4) + ".png"), k);
    CHECK(contains(refusal([&] { static_cast<void>(open_media(folder / "a.mp4")); }),
                   "needs a depth file beside it"));
    CHECK(open_media(folder / "b.mp4")->description().depth_path == folder / "b_depth");
    CHECK(open_media(folder.path())->description().colour_path == folder / "b.mp4");
}

TEST_CASE("fewer pictures than frames go by their numbers, from 0 or from 1, else by the ratio",
          "[pair_times]") {
    const Pair pair("rgb.mp4", 100, "50", kH264);
    const int kind = GENERATE(0, 1, 2, 3);
    CAPTURE(kind);
    for (int k = 0; k < 20; ++k) {
        const int number = kind == 0   ? k          // only the ratio is left
                           : kind == 1 ? 5 * k      // 0 to 95
                           : kind == 2 ? 5 * k + 1  // 1 to 96
                                       : k + 1;
        pair.depth("depth_" + digits(number, 5), 5 * k);
    }
    const auto media = pair.open();
    CHECK(contains(media->description().timing,
                   kind == 0 || kind == 3 ? "one picture for every 5 frames" : "by the numbers"));
    CHECK_FALSE(contains(media->description().notice, "cannot both be right"));
    check_pair(*media, pair.times_s);
}

TEST_CASE("numbers with gaps, and a depth that begins later, keep their frames", "[pair_times]") {
    const Pair pair("rgb.mp4", 60, "60", kH264);
    for (int k = 7; k < 60; ++k)
        if (k % 11 != 3) pair.depth(std::to_string(k), k);
    check_pair(*pair.open(), pair.times_s, pair.times_s[7]);
}

TEST_CASE("stamps in names are times, whatever their unit", "[pair_times]") {
    const Pair pair("rgb.mp4", 50, "25", kH264);
    const auto [unit_per_s, begin] =
        GENERATE(table<double, double>({{1.0, 1683000000.0},  // with a point
                                        {1e9, 1683000000.0},  // since 1970
                                        {1e6, 1683000000.0},
                                        {1e3, 1683000000.0},
                                        {1e6, 5000.0},  // since the start of the camera
                                        {1e9, 5000.0}}));
    CAPTURE(unit_per_s, begin);
    for (int k = 0; k < 17; ++k) {
        const double stamp = (begin + 0.12 * k) * unit_per_s;
        pair.depth(unit_per_s == 1.0 ? number_text(stamp, 6) : std::to_string(std::llround(stamp)),
                   3 * k);
    }
    const auto media = pair.open();
    CHECK(media->description().times_from == "names");
    check_pair(*media, pair.times_s);
}

TEST_CASE("a file beside pictures states their times", "[pair_times]") {
    const Pair pair("rgb.mp4", 50, "25", kH264);
    const auto [name, kind] = GENERATE(table<std::string, int>({{"depth/timestamps.txt", 0},
                                                                {"depth_timestamps.csv", 1},
                                                                {"odometry.csv", 2},
                                                                {"frames.json", 3},
                                                                {"depth/timestamps.txt", 4}}));
    CAPTURE(name, kind);
    std::string text = kind == 1   ? "#timestamp [ns],filename\n"
                       : kind == 2 ? "timestamp, frame, x, y, z\n"
                       : kind == 3 ? "{\"fps\": 30, \"frames\": ["
                                   : "";
    for (int k = 0; k < 17; ++k) {
        const std::string file = digits(k, 6);
        pair.depth(file, 3 * k);
        const double time_s = 0.12 * k;
        if (kind == 0) text += number_text(time_s) + "\n";
        if (kind == 1)
            text +=
                std::to_string(std::llround((1683000000.0 + time_s) * 1e9)) + "," + file + ".png\n";
        if (kind == 2) text += number_text(70.5 + time_s) + ", " + file + ", 1, 2, 3\n";
        if (kind == 3)
            text += std::string(k == 0 ? "" : ",") + "{\"timestamp\": " + number_text(time_s) +
                    ", \"depth_path\": \"depth/" + file + ".png\"}";
        if (kind == 4) text += "2011-09-26 13:02:2" + number_text(5.0 + time_s) + "\n";
    }
    write_text(pair.folder / name, text + (kind == 3 ? "]}" : ""));
    const auto media = pair.open();
    CHECK(media->description().times_from == "list");
    CHECK(contains(media->description().timing, shown(fs::path(name).filename())));
    check_pair(*media, pair.times_s);
}

TEST_CASE("a JSON file of each frame states its time, named as the colour or as the depth",
          "[pair_times]") {
    const TemporaryFolder folder;
    const std::string named = GENERATE("frame_", "depth_");
    const bool states_time = GENERATE(true, false);
    CAPTURE(named, states_time);
    for (int k = 0; k < 8; ++k) {
        const std::string number = digits(6 * k, 5);
        write_numbered_depth(folder / ("depth_" + number + ".png"), k);
        write_numbered_colour(folder / ("frame_" + number + ".png"), k);
        write_text(folder / (named + number + ".json"),
                   std::string(R"({"frame_index": )") + std::to_string(6 * k) +
                       (states_time ? R"(, "time": )" : R"(, "t_00": )") +
                       number_text(500.0 + 0.1 * k, 3) + "}");
    }
    const auto media = open_media(folder.path(), {}, as_a_person_opens());
    CHECK(media->description().times_from == (states_time ? "list" : "assumed"));
    CHECK(contains(media->description().timing, "00000.json' and the like") == states_time);
    check_pair(*media, even_s(8, states_time ? 10.0 : 30.0));
}

TEST_CASE("colour pictures without times take those of a depth video", "[pair_times]") {
    const TemporaryFolder folder;
    make_numbered_clip(folder / "depth.mkv", 40, "25", kLossless, kUneven);
    for (int k = 0; k < 40; ++k) write_numbered_colour(folder / "rgb" / (digits(k, 4) + ".png"), k);
    const auto times_s = decoded_times_s(folder / "depth.mkv");
    const auto media = open_media(folder / "rgb", folder / "depth.mkv", as_grey_video());
    CHECK(contains(media->description().timing, "of the colour: those of 'depth.mkv'"));
    check_pair(*media, times_s);
}

TEST_CASE("a depth that a person shifts or plays faster goes with the colour then",
          "[pair_times]") {
    const Pair pair("rgb.mp4", 60, "25", kH264);
    DepthRequest request = as_a_person_opens();
    const bool on_panel = GENERATE(false, true);
    CAPTURE(on_panel);
    DepthStatement& stated = on_panel ? request.panel : request.command_line;
    stated.time_offset_s = 0.2;
    for (int k = 0; k < 55; ++k) pair.depth(digits(k, 3), k + 5);
    SECTION("later by five frames") {
        stated.times = DepthTimes::own;
        stated.frames_per_s = 25.0;
        const auto media = pair.open(request);
        CHECK(media->description().times_from == "stated");
        CHECK(contains(media->description().timing, "0.2 s later"));
        check_pair(*media, pair.times_s, pair.times_s[5]);
    }
    SECTION("by the rate alone it is not") {
        stated.time_offset_s = 0.0;
        stated.frames_per_s = 25.0;
        const auto frame = pair.open(request)->next();
        REQUIRE(frame);
        CHECK(number_in(frame->depth) == 5);
        CHECK(number_in(frame->colour) == 0);
    }
}

TEST_CASE("a shift by parts of a frame takes the nearest colour", "[pair_times]") {
    const Pair pair("rgb.mp4", 50, "25", kH264);
    for (int k = 0; k < 50; ++k) pair.depth(digits(k, 3), k);
    DepthRequest request = as_a_person_opens();
    const double offset_s = GENERATE(-0.03, 0.013, 0.022, 0.1);
    request.command_line.time_offset_s = offset_s;
    const auto media = pair.open(request);
    while (const auto frame = media->next()) {
        const auto colour = static_cast<std::size_t>(number_in(frame->colour));
        const double depth_s = frame->media_s + offset_s;
        const double nearest_s = std::clamp(depth_s, 0.0, pair.times_s.back());
        CHECK(std::fabs(pair.times_s[colour] - nearest_s) <= 0.5 * 0.04 + 1e-6);
    }
}

TEST_CASE("a depth video at another rate is told, and stated to be paired", "[pair_times]") {
    const TemporaryFolder folder;
    make_numbered_clip(folder / "color.mp4", 50, "25", kH264);
    make_numbered_clip(folder / "depth.mkv", 50, "30", kLossless);
    const auto times_s = decoded_times_s(folder / "color.mp4");
    DepthRequest request = as_grey_video();
    const auto open = [&] {
        return open_media(folder / "color.mp4", folder / "depth.mkv", request);
    };
    CHECK(contains(open()->description().notice, "cannot both be right"));
    request.command_line.times = DepthTimes::paired;
    CHECK_FALSE(contains(open()->description().notice, "cannot both be right"));
    check_pair(*open(), times_s);
    request.command_line.times.reset();
    request.command_line.frames_per_s = 25.0;
    check_pair(*open(), times_s);
}

TEST_CASE("two videos of any rates are shown by their times, the nearest colour with each depth",
          "[pair_times]") {
    const TemporaryFolder folder;
    const auto [colour_per_s, depth_per_s] =
        GENERATE(table<int, int>({{60, 30}, {15, 30}, {10, 30}, {24, 30}, {30, 24}, {50, 48}}));
    const std::string encoding = GENERATE(kH264, kRareKeys);
    CAPTURE(colour_per_s, depth_per_s, encoding);
    make_numbered_clip(folder / "color.mp4", 2 * colour_per_s, std::to_string(colour_per_s),
                       encoding);
    make_numbered_clip(folder / "depth.mkv", 2 * depth_per_s, std::to_string(depth_per_s),
                       kLossless);
    const auto media = open_media(folder / "color.mp4", folder / "depth.mkv", as_grey_video());
    CHECK(media->description().times_from == "file");
    CHECK_FALSE(contains(media->description().notice, "cannot both be right"));
    check_pair(*media,
               {even_s(2 * depth_per_s, depth_per_s), even_s(2 * colour_per_s, colour_per_s)});
}

TEST_CASE("videos that begin at different times of their clock are together by that clock",
          "[pair_times]") {
    const TemporaryFolder folder;
    const std::string name = GENERATE("color.mkv", "color.mp4");
    const auto [colour_begins_s, depth_begins_s] =
        GENERATE(table<double, double>({{0.4, 0.0}, {0.0, 0.4}, {0.52, 0.2}}));
    CAPTURE(name, colour_begins_s, depth_begins_s);
    const auto begins = [](double begin_s) { return " -output_ts_offset " + number_text(begin_s); };
    make_numbered_clip(folder / name, 50, "25", kH264 + begins(colour_begins_s));
    make_numbered_clip(folder / "depth.mkv", 50, "25", kLossless + begins(depth_begins_s));
    const auto media = open_media(folder / name, folder / "depth.mkv", as_grey_video());
    CHECK(contains(media->description().timing, "in the file; the colour begins 0."));
    CHECK(contains(media->description().timing,
                   colour_begins_s > depth_begins_s ? "after the depth" : "before the depth"));
    check_pair(*media, {even_s(50, 25.0), even_s(50, 25.0, colour_begins_s - depth_begins_s)});
}

TEST_CASE("folders of stamped pictures are together by their clock, by two clocks from the begin",
          "[pair_times]") {
    const TemporaryFolder folder;
    const bool is_one_clock = GENERATE(true, false);
    const double stamps_per_s = GENERATE(1.0, 1e6);  // in seconds with a point, in microseconds
    CAPTURE(is_one_clock, stamps_per_s);
    const double begin_s = 1683000000.0;
    const double other_s = is_one_clock ? begin_s + 0.013 : 5000.0;
    const auto name = [=](double time_s) {
        return (stamps_per_s == 1.0 ? number_text(time_s, 6)
                                    : std::to_string(std::llround(time_s * stamps_per_s))) +
               ".png";
    };
    for (int k = 0; k < 30; ++k)
        write_numbered_depth(folder / "depth" / name(begin_s + k / 15.0), k);
    for (int k = 0; k < 60; ++k)
        write_numbered_colour(folder / "rgb" / name(other_s + k / 30.0), k);
    const auto media = open_media(folder.path(), {}, as_a_person_opens());
    CHECK(media->description().times_from == "names");
    CHECK(contains(media->description().notice, "two clocks") == !is_one_clock);
    check_pair(*media, {even_s(30, 15.0), even_s(60, 30.0, is_one_clock ? 0.013 : 0.0)});
}

TEST_CASE("the topics of a bag are together by their stamps", "[pair_times]") {
    const TemporaryFolder folder;
    const std::string ending = GENERATE(".db3", ".mcap");
    const fs::path place = folder / ("take" + ending);
    {
        Bag bag(place, {.ending = ending});
        const int depth = bag.topic("/camera/depth/image_raw", "Image");
        const int colour = bag.topic("/camera/color/image_raw", "Image");
        for (int k = 0; k < 40; ++k)
            bag.add(colour, image(100.0 + k / 20.0 + 0.011, kNumberedColumns, kNumberedRows, "rgb8",
                                  3 * kNumberedColumns, numbered_colour_data(k)));
        for (int k = 0; k < 30; ++k)
            bag.add(depth, image(100.0 + k / 15.0, kNumberedColumns, kNumberedRows, "16UC1",
                                 2 * kNumberedColumns, numbered_depth_data(k)));
    }
    const auto media = open_media(place, {}, as_a_person_opens());
    check_pair(*media, {even_s(30, 15.0), even_s(40, 20.0, 0.011)});
}

TEST_CASE("halves of one picture are of one moment", "[pair_times]") {
    const TemporaryFolder folder;
    make_numbered_clip(folder / "film_RGBD.mp4", 60, "30", kH264, "split[a][b];[a][b]hstack");
    DepthRequest request = as_grey_video();
    request.command_line.packing = DepthPacking::left_right;
    check_pair(*open_media(folder / "film_RGBD.mp4", {}, request), same_moments(even_s(60, 30.0)));
}

TEST_CASE("pictures whose times nothing tells are told where they cannot be right",
          "[pair_times]") {
    const Pair pair("rgb.mp4", 50, "25", kH264);
    for (int k = 0; k < 13; ++k) pair.depth("x" + digits(k + 400, 3), k);
    const MediaDescription told = pair.open()->description();
    CHECK(told.times_from == "other");  // every fourth: 50 of 13
    for (int k = 13; k < 20; ++k) pair.depth("x" + digits(k + 400, 3), k);
    const MediaDescription unknown = pair.open()->description();  // 20 of 50
    CHECK(unknown.times_from == "assumed");
    CHECK(contains(unknown.timing, "assumed: 30 frames a second"));
    CHECK(contains(unknown.notice, "cannot both be right"));
    REQUIRE(unknown.meaning);
    CHECK(unknown.meaning->times.value == DepthTimes::own);
}

TEST_CASE("what was touched has the same times again, by its record, as before there were any",
          "[pair_times]") {
    const Pair pair("rgb.mp4", 40, "60", kH264);
    const bool by_ratio = GENERATE(false, true);
    for (int k = 0; k < (by_ratio ? 20 : 40); ++k) pair.depth(digits(k, 3), by_ratio ? 2 * k : k);
    const auto times_of = [](Media& media) {
        std::vector<double> times_s;
        while (const auto frame = media.next()) times_s.push_back(frame->media_s);
        return times_s;
    };
    const auto media = pair.open();
    const DepthStatement felt =
        statement_in(toml_of(media->description().meaning->statement()), "a session");
    CHECK(felt.times == DepthTimes::paired);
    CHECK(times_of(*pair.open({.recorded = felt})) == times_of(*media));
    DepthStatement of_old = felt;  // no fact of time
    of_old.times.reset();
    of_old.time_offset_s.reset();
    of_old.frames_per_s.reset();
    const auto old_s = times_of(*pair.open({.recorded = of_old}));
    for (std::size_t k = 0; k < old_s.size(); ++k) CHECK(old_s[k] == static_cast<double>(k) / 30.0);
}

TEST_CASE("numbers of frames are no stamps, and stamps of any unit are", "[pair_times]") {
    const auto unit = [](double first, double step, std::size_t count, bool times) {
        return stamp_unit_s(first, first + step * static_cast<double>(count - 1), count, times);
    };
    CHECK_FALSE(unit(0.0, 1.0, 60, false));
    CHECK_FALSE(unit(100.0, 5.0, 60, false));
    CHECK_FALSE(unit(1683000000.0, 1.0, 60, false));
    CHECK_FALSE(unit(20230501120000.0, 1.0, 60, false));
    CHECK(unit(1683000000e9, 33e6, 60, false) == 1e-9);
    CHECK(unit(1683000000e6, 33e3, 60, false) == 1e-6);
    CHECK(unit(1683000000e3, 33.0, 60, false) == 1e-3);
    CHECK(unit(12e6, 33333.0, 60, false) == 1e-6);
    CHECK(unit(12e9, 33.3e6, 60, false) == 1e-9);
    CHECK(unit(0.0, 0.033, 60, true) == 1.0);
    CHECK(unit(0.0, 33.0, 60, true) == 1e-3);
}

TEST_CASE("an estimator's array belongs to the video that it was made of, with its times",
          "[pair_times]") {
    const TemporaryFolder folder;
    make_numbered_clip(folder / "clip_src.mp4", 12, "10", kH264);
    make_numbered_clip(folder / "clip_vis.mp4", 12, "10", kH264);
    std::string values;
    for (int k = 0; k < 12; ++k)
        for (int pixel = 0; pixel < 48 * 64; ++pixel)
            append_bytes(values, 1.0F + 0.1F * static_cast<float>(k + pixel % 64));
    write_zip(folder / "clip_depths.npz", {{"depths.npy", npy("<f4", "(12, 48, 64)", values)}},
              true);
    const fs::path place = GENERATE(0, 1) == 0 ? folder.path() : folder / "clip_src.mp4";
    const auto media = open_media(place, {}, {.find_out = true});
    const MediaDescription& opened = media->description();
    CHECK(opened.colour_path == folder / "clip_src.mp4");
    CHECK(opened.depth_path == folder / "clip_depths.npz");
    CHECK(opened.frames == 12);
    CHECK(opened.times_from == "other");
    // Both given are described as they open.
    const DepthRequest request{.find_out = true};
    const auto described = describe_media(opened.depth_path, request, opened.colour_path);
    CHECK(described.timing == opened.timing);
    CHECK_THAT(described.duration_s, WithinAbs(opened.duration_s, 1e-9));
    CHECK(described.colour_columns == 0);
    CHECK(describe_media(opened.depth_path, request).times_from == "assumed");
    const auto colour = describe_media(opened.colour_path, request, opened.depth_path);
    CHECK(colour.times_from == "file");
    CHECK(colour.depth_columns == 0);
}

TEST_CASE("pictures in a subfolder data, whose times are beside it, are those of the folder",
          "[pair_times]") {
    const TemporaryFolder folder;
    for (const char* const camera : {"cam0", "depth0"}) {
        std::string table = "#timestamp [ns],filename\n";
        for (int k = 0; k < 8; ++k) {
            const std::string stamp =
                std::to_string(1403636579763555584LL + 50000000LL * (k + k / 4));
            const fs::path file = folder / camera / "data" / (stamp + ".png");
            if (std::string(camera) == "cam0")
                write_numbered_colour(file, k);
            else
                write_numbered_depth(file, k);
            table += stamp + "," + stamp + ".png\n";
        }
        write_text(folder / camera / "data.csv", table);
    }
    const auto media = GENERATE(true, false)
                           ? open_media(folder.path(), {}, as_a_person_opens())
                           : open_media(folder / "cam0", folder / "depth0", as_a_person_opens());
    CHECK(media->description().frames == 8);
    CHECK(media->description().times_from == "list");
    std::vector<double> times_s;
    for (int k = 0; k < 8; ++k) times_s.push_back(0.05 * (k + k / 4));
    check_pair(*media, times_s);
}

TEST_CASE("tables and JSON of stamps are read, others are not taken for them", "[pair_times]") {
    const TemporaryFolder folder;
    const PictureRow row = row_of_names({"1.png", "2.png", "3.png"});
    const auto read = [&](const std::string& name, const std::string& text) {
        write_text(folder / name, text);
        return read_stamps(folder / name, row);
    };
    using Stamps = std::vector<double>;
    CHECK(read("a.txt", "0.5\n1.0\n1.5\n") == Stamps{0.5, 1.0, 1.5});
    CHECK(read("a.txt", "# timestamp format v2\n0\n500\n1000\n") == Stamps{0.0, 0.5, 1.0});
    CHECK(read("a.txt", "0 0.5\n1 0.75\n2 1.5\n") == Stamps{0.5, 0.75, 1.5});
    CHECK(read("a.csv", "time_ms;frame\n500;3\n0;1\n250;2\n") == Stamps{0.0, 0.25, 0.5});
    CHECK(read("a.csv", "t,file\n0.5,b/3.png\n0.25,b/2.png\n0.0,b/1.png\n") ==
          Stamps{0.0, 0.25, 0.5});
    std::string wide = "0.0,1.png";
    for (int k = 0; k < 500000; ++k) wide += ",7";  // cells that nobody needs
    CHECK(read("a.csv", wide + "\n0.25,2.png\n0.5,3.png\n") == Stamps{0.0, 0.25, 0.5});
    CHECK(read("a.json", "[0.0, 0.25, 0.5]") == Stamps{0.0, 0.25, 0.5});
    CHECK(read("a.json", R"({"1": {"timestamp": 2.5}, "2": {"timestamp": 3.0},
                             "3": {"timestamp": 3.25}})") == Stamps{2.5, 3.0, 3.25});
    for (const std::string text :
         {"", "1\n2\n3\n", "0.5\n1.0\n", "0.5\n0.25\n1.0\n", "0.5\n0.5\n0.5\n", "x,y\n1,2\n",
          "frame,name\n1,1.png\n2,2.png\n3,3.png\n", "a b c\n", "0.5\nnan\n1\n",
          "1e300\n2e300\n3e300\n", "0\n1e12\n2e12\n"}) {
        CAPTURE(text);
        CHECK_FALSE(read("b.txt", text));
    }
    for (const std::string text : {"", "{", "[]", "[0, 1, 2]", "{\"frames\": 3}", "[null, {}, 1]",
                                   R"([{"timestamp": "a"}, {"timestamp": 1}])"}) {
        CAPTURE(text);
        CHECK_FALSE(read("b.json", text));
    }
}

TEST_CASE("stamps in ticks since the year 1601 or 1 are of a tenth of a microsecond",
          "[pair_times]") {
    const double first = GENERATE(132697151403874938.0, 638400000000000000.0);
    CAPTURE(first);
    const auto unit_s = stamp_unit_s(first, first + 8e6, 5, false);
    REQUIRE(unit_s);
    CHECK(*unit_s == 1e-7);
}
