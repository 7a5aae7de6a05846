// Bags of ROS 2 in SQLite and MCAP, as their own programs write them.
#include "core/video/formats/bags/ros_bag.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/video/sources/media.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/bag_writers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/stated.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

template <typename Level>
std::string repeated(Level level, int count) {
    std::string bytes;
    for (int k = 0; k < count; ++k) {
        char raw[sizeof level];
        std::memcpy(raw, &level, sizeof level);
        bytes.append(raw, sizeof level);
    }
    return bytes;
}

std::string colour_image(double stamp_s, const std::string& encoding, const std::string& pixel) {
    std::string data;
    for (int k = 0; k < 10 * 6; ++k) data += pixel;
    return image(stamp_s, 10, 6, encoding, 10 * static_cast<int>(pixel.size()), data);
}

std::string compressed(double stamp_s, const std::string& format, const std::string& data) {
    return CdrWriter().header(stamp_s).text(format).sequence(data).bytes();
}

std::string encoded(const std::string& ending, const cv::Mat& picture) {
    std::vector<std::uint8_t> bytes;
    if (!cv::imencode(ending, picture, bytes)) throw std::runtime_error("not encoded");
    return {bytes.begin(), bytes.end()};
}

/// A camera whose axis goes through the middle of pictures of that size; zeros: not calibrated.
std::string camera_info(int columns, int rows, const std::string& frame = "camera_optical_frame",
                        double focal = 600.0) {
    const double cx = focal > 0.0 ? 0.5 * (columns - 1) : 0.0;
    const double cy = focal > 0.0 ? 0.5 * (rows - 1) : 0.0;
    CdrWriter info;
    info.header(1.0, frame)
        .number(static_cast<std::uint32_t>(rows))
        .number(static_cast<std::uint32_t>(columns))
        .text("plumb_bob")
        .number(std::uint32_t{5});
    for (int k = 0; k < 5; ++k) info.number(0.1 * k);
    for (const double value : {focal, 0.0, cx, 0.0, 1.5 * focal, cy, 0.0, 0.0, 1.0})
        info.number(value);
    for (int k = 0; k < 21; ++k) info.number(1.0);
    return info.bytes();
}

/// Column by column, and in metres.
std::string extrinsics(const std::vector<double>& rotation, const std::vector<double>& shift_m) {
    CdrWriter message;
    for (const double value : rotation) message.number(value);
    for (const double value : shift_m) message.number(value);
    return message.bytes();
}

std::vector<float> depths_of(Media& media) {
    std::vector<float> depths;
    while (const auto frame = media.next()) depths.push_back(frame->depth.at(3, 3));
    return depths;
}

}  // namespace

TEST_CASE("a bag plays its depth and colour topics by the stamps of their messages", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("walk" + form.ending);
    CAPTURE(form.name());
    {
        Bag bag(file, form);
        const int infrared = bag.topic("/camera/infra1/image_rect_raw", "Image");
        const int depth = bag.topic("/camera/depth/image_rect_raw", "Image");
        const int colour = bag.topic("/camera/color/image_raw", "Image");
        const int info = bag.topic("/camera/depth/camera_info", "CameraInfo");
        bag.add(infrared, image(100.0, 8, 6, "mono8", 8, std::string(48, 'i')));
        bag.add(info, camera_info(8, 6));
        for (const int n : {1, 0, 2}) {  // not in order
            bag.add(depth, depth_image(100.0 + 0.1 * n, 1000 + n));
            bag.add(colour, colour_image(100.01 + 0.1 * n, "rgb8", {static_cast<char>(n), 2, 3}));
        }
    }
    const auto media = open_media(file);
    CHECK(media->description().colour_columns == 10);
    CHECK(media->description().depth_columns == 8);
    CHECK(media->description().frames == 3);
    for (int n = 0; n < 3; ++n) {
        const auto frame = media->next();
        REQUIRE(frame);
        CHECK(frame->depth.at(2, 2) == static_cast<float>(1000 + n));
        CHECK(frame->colour.rgb[0] == n);
        CHECK(frame->colour.rgb[2] == 3);
        CHECK(std::abs(frame->media_s - 0.1 * n) < 1e-6);
    }
    CHECK_FALSE(media->next());
    media->seek(0.15);
    CHECK(media->next()->depth.at(2, 2) == 1001.0F);
    const auto source = open_picture_source(file, PictureRole::depth);
    CHECK(stated_by(source->facts()).unit == DepthUnit::mm);
    CHECK(stated_by(source->facts()).no_data == std::vector<double>{0.0});
    CHECK(stated_by(source->facts()).intrinsics == Intrinsics{600.0, 900.0, 3.5, 2.5});
    CHECK(origins_of(source->facts().findings) == "ROS topic /camera/depth/image_rect_raw");
    CHECK(describe_media(file).depth_bits == 16);
}

TEST_CASE("a bag's floats are metres, in either order of bytes, and its rows may be padded",
          "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("f" + form.ending);
    CAPTURE(form.name());
    const bool big_endian = GENERATE(false, true);
    std::string data;
    for (int row = 0; row < 6; ++row) {
        std::string level = repeated(1.25F, 1);
        if (big_endian) level = {level[3], level[2], level[1], level[0]};
        for (int column = 0; column < 8; ++column) data += level;
        if (row < 5) data += "pad!";
    }
    {
        Bag bag(file, form);
        const int depth = bag.topic("/depth", "Image");
        bag.add(depth, image(5.0, 8, 6, "32FC1", 36, data, big_endian));
    }
    const auto source = open_picture_source(file, PictureRole::depth);
    CHECK(stated_by(source->facts()).unit == DepthUnit::m);
    CHECK(source->facts().bits == kRealBits);
    CHECK(source->facts().still);
    const auto picture = source->next();
    REQUIRE(picture);
    CHECK(picture->picture.at<float>(5, 7) == 1.25F);
}

TEST_CASE("depth that is registered to the colour camera comes before other depth", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("a" + form.ending);
    CAPTURE(form.name());
    {
        Bag bag(file, form);
        bag.add(bag.topic("/depth/image_raw", "Image"), depth_image(1.0, 1));
        bag.add(bag.topic("/aligned_depth_to_color/image_raw", "Image"), depth_image(1.0, 2));
    }
    CHECK(depths_of(*open_depth(file)) == std::vector<float>{2.0F});
}

TEST_CASE("a bag of two cameras tells how they stand, or it is said that it does not", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("two" + form.ending);
    CAPTURE(form.name());
    const std::string told = GENERATE(as<std::string>{}, "well", "broken", "not", "one camera");
    CAPTURE(told);
    const double tilt = told == "broken" ? 0.9 : 1.0;
    {
        Bag bag(file, form);
        bag.add(bag.topic("/cam/depth/image_rect_raw", "Image"), depth_image(1.0, 1000));
        bag.add(bag.topic("/cam/depth/camera_info", "CameraInfo"), camera_info(8, 6, "depth"));
        bag.add(bag.topic("/cam/color/image_raw", "Image"), colour_image(1.0, "rgb8", "abc"));
        bag.add(bag.topic("/cam/color/camera_info", "CameraInfo"),
                camera_info(10, 6, told == "one camera" ? "depth" : "colour"));
        if (told == "well" || told == "broken")
            bag.add(
                bag.topic("/cam/extrinsics/depth_to_color", "Extrinsics", "realsense2_camera_msgs"),
                extrinsics({0, tilt, 0, -1, 0, 0, 0, 0, 1}, {0.015, 0.0, -0.001}));
    }
    const auto source = open_picture_source(file, PictureRole::depth);
    const SourceFacts& facts = source->facts();
    CHECK(stated_by(facts).intrinsics);
    REQUIRE((facts.cameras != nullptr) == (told == "well"));
    const auto notice = [&](const DepthRequest& request) {
        return open_media(file, {}, request)->description().notice;
    };
    const bool is_told = told == "well" || told == "one camera";
    CHECK(contains(notice({.find_out = true}), "shift the colour (--registration)") != is_told);
    CHECK(notice({.find_out = true, .command_line = {.registration = Registration{1, 0, 1}}})
              .empty());
    if (told != "well") return;
    CHECK(facts.cameras->to_colour.rotation * cv::Vec3d(1, 2, 3) == cv::Vec3d(-2, 1, 3));
    CHECK(facts.cameras->to_colour.shift_mm == cv::Vec3d(15, 0, -1));
    CHECK(facts.cameras->colour_size == cv::Size(10, 6));
    const Lens& lens = facts.cameras->colour.lens();  // plumb_bob 0, 0.1 .. 0.4
    CHECK(lens.k == std::array<double, 6>{0.0, 0.1, 0.4, 0.0, 0.0, 0.0});
    CHECK(lens.p1 == 0.1 * 2);
    CHECK(open_media(file, {}, {.find_out = true})->description().registered_by ==
          "ROS topic /cam/extrinsics/depth_to_color");
}

TEST_CASE(
    "a bag's camera of other pictures is scaled where they were made smaller, else it is said",
    "[bag]") {
    const TemporaryFolder folder;
    const auto [info, camera, said] =
        GENERATE(table<std::string, std::optional<Intrinsics>, std::string>(
            {{camera_info(16, 12), Intrinsics{300.0, 450.0, 3.5, 2.5}, "of a picture of 16 x 12"},
             {camera_info(10, 10), std::nullopt, "of a picture of 10 x 10, not of 8 x 6"},
             {camera_info(8, 6, "depth", 0.0), std::nullopt, "focal lengths of 0"}}));
    CAPTURE(said);
    {
        Bag bag(folder / "a.db3");
        bag.add(bag.topic("/depth/image", "Image"), depth_image(1.0, 1000));
        bag.add(bag.topic("/depth/camera_info", "CameraInfo"), info);
    }
    const auto media = open_depth(folder / "a.db3", {.find_out = true});
    CHECK(media->description().meaning->intrinsics.value == camera);
    CHECK(contains(media->description().notice, said));
    if (camera) return;
    const DepthRequest true_shape{.find_out = true,
                                  .command_line = {.geometry = Geometry::true_shape}};
    CHECK(contains(refusal([&, file = folder / "a.db3"] { (void)open_depth(file, true_shape); }),
                   "--intrinsics"));
}

TEST_CASE("compressed topics of a bag are read: JPEG colour, PNG depth of both kinds", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("c" + form.ending);
    CAPTURE(form.name());
    const cv::Mat colour(6, 10, CV_8UC3, cv::Scalar(200, 200, 200));
    const cv::Mat depth(6, 8, CV_16UC1, cv::Scalar(1234));
    // v = a / depth + b: here 1234 = 2000 / 2 m + 234.
    const std::string header =
        repeated(std::uint32_t{0}, 1) + repeated(2000.0F, 1) + repeated(234.0F, 1);
    const bool floats = GENERATE(false, true);
    {
        Bag bag(file, form);
        bag.add(bag.topic("/color/compressed", "CompressedImage"),
                compressed(1.0, "rgb8; jpeg compressed bgr8", encoded(".jpg", colour)));
        bag.add(
            bag.topic("/depth/image/compressedDepth", "CompressedImage"),
            compressed(1.0, floats ? "32FC1; compressedDepth png" : "16UC1; compressedDepth png",
                       header + encoded(".png", depth)));
        bag.add(bag.topic("/depth/camera_info", "CameraInfo"), camera_info(8, 6));
    }
    const auto source = open_picture_source(file, PictureRole::depth);
    const auto picture = source->next();
    REQUIRE(picture);
    if (floats)
        CHECK(std::abs(picture->picture.at<float>(2, 2) - 2.0F) < 1e-6F);
    else
        CHECK(picture->picture.at<std::uint16_t>(2, 2) == 1234);
    CHECK((stated_by(source->facts()).unit == DepthUnit::m) == floats);
    CHECK(stated_by(source->facts()).intrinsics);
    if (!floats) {
        const auto frame = open_media(file)->next();
        REQUIRE(frame);
        CHECK(frame->colour.rgb[0] == 200);
    }
}

TEST_CASE("a bag that goes over several files of a folder plays as one", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    CAPTURE(form.name());
    write_text(folder / "metadata.yaml", "rosbag2_bagfile_information:\n");
    for (const int part : {0, 1}) {
        Bag bag(folder / ("walk_" + std::to_string(part) + form.ending), form);
        const int depth = bag.topic("/depth", "Image");
        for (int n = 0; n < 2; ++n)
            bag.add(depth, depth_image(1.0 + 0.1 * (2 * part + n), 2 * part + n));
    }
    CHECK(depths_of(*open_depth(folder.path())) == std::vector<float>{0.0F, 1.0F, 2.0F, 3.0F});
}

TEST_CASE("messages without stamps play by when they were recorded", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("r" + form.ending);
    CAPTURE(form.name());
    {
        Bag bag(file, form);
        const int depth = bag.topic("/depth", "Image");
        bag.add(depth, depth_image(0.0, 8), 2'500'000'000);
        bag.add(depth, depth_image(0.0, 7), 2'000'000'000);
        bag.add(depth, depth_image(0.0, 9), 2'500'000'000);  // the same time: passed over
    }
    const auto media = open_depth(file);
    CHECK(media->next()->depth.at(1, 1) == 7.0F);
    const auto second = media->next();
    CHECK(second->depth.at(1, 1) == 8.0F);
    CHECK(std::abs(second->media_s - 0.5) < 1e-9);
    CHECK_FALSE(media->next());
}

TEST_CASE("a large picture is read, and one that says more than it holds is told", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("l" + form.ending);
    CAPTURE(form.name());
    {  // larger than any block in which bags are read and unpacked
        Bag bag(file, form);
        const int depth = bag.topic("/depth", "Image");
        bag.add(depth, depth_image(1.0, 11, 800, 600));
        bag.add(depth, image(1.1, 800, 600, "16UC1", 1600, "short"));
        bag.add(depth, image(1.2, 2'000'000'000, 2'000'000'000, "16UC1", 0, "short"));
        bag.add(depth, depth_image(1.3, 12, 800, 600).substr(0, 70));
        bag.add(depth, depth_image(1.4, 13, 800, 600));
    }
    const auto media = open_depth(file);
    CHECK(depths_of(*media) == std::vector<float>{11.0F, 11.0F, 11.0F, 11.0F, 13.0F});
    CHECK(contains(media->description().trouble, "cannot be decoded"));
}

TEST_CASE("a bag without a topic that can be read says what it holds", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("none" + form.ending);
    CAPTURE(form.name());
    {
        Bag bag(file, form);
        bag.add(bag.topic("/camera/ir", "Image"),
                image(1.0, 8, 6, "mono16", 16, repeated('x', 96)));
        bag.add(bag.topic("/camera/bayer", "Image"),
                image(1.0, 8, 6, "bayer_rggb8", 8, std::string(48, 'x')));
    }
    const std::string said = refusal([&] { (void)open_depth(file); });
    CHECK(contains(said, "no topic of depth pictures"));
    CHECK(contains(said, "/camera/bayer: bayer_rggb8"));
    const fs::path nothing = folder / ("empty" + form.ending);
    { const Bag empty(nothing, form); }
    CHECK(contains(refusal([&] { (void)open_depth(nothing); }), "none of pictures"));
}

TEST_CASE("databases that are no bags, or hostile ones, are refused in a line", "[bag]") {
    const TemporaryFolder folder;
    const std::string change = GENERATE(
        "DROP TABLE messages",
        "DROP TABLE messages; CREATE VIEW messages AS WITH RECURSIVE r(x) AS (SELECT 1 UNION ALL "
        "SELECT x + 1 FROM r) SELECT x AS id, 1 AS topic_id, x AS timestamp, x AS data FROM r",
        "DROP TABLE messages; CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER AS (1)"
        ", timestamp INTEGER, data BLOB)",
        "DROP TABLE messages; CREATE TABLE messages(id TEXT PRIMARY KEY, topic_id, timestamp, data)"
        " WITHOUT ROWID",
        "DROP TABLE topics; CREATE TABLE topics(id, label)");
    CAPTURE(change);
    {
        Bag bag(folder / "hostile.db3");
        bag.add(bag.topic("/depth", "Image"), depth_image(1.0, 1));
        bag.run(change);
    }
    const std::string said = refusal([&] { (void)open_depth(folder / "hostile.db3"); });
    CHECK(contains(said, "hostile.db3"));
    CHECK(said.find('\n') == std::string::npos);
}

TEST_CASE("a compressed picture of a bag beyond the bound is refused", "[bag][memory]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("large" + form.ending);
    CAPTURE(form.name());
    static const std::string png = encoded(".png", cv::Mat::zeros(5800, 5800, CV_16UC1));
    CHECK(png.size() < 200'000);
    {
        Bag bag(file, form);
        bag.add(bag.topic("/depth/image/compressedDepth", "CompressedImage"),
                compressed(1.0, "16UC1; compressedDepth png", std::string(12, '\0') + png));
    }
    CHECK(contains(refusal([&] { (void)open_depth(file); }), "larger than"));
}

TEST_CASE("a bag that was cut off or overwritten ends in a line or in what is left", "[bag]") {
    const TemporaryFolder folder;
    const BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("whole" + form.ending);
    CAPTURE(form.name());
    {
        Bag bag(file, form);
        const int depth = bag.topic("/depth", "Image");
        for (int n = 0; n < 40; ++n) bag.add(depth, depth_image(1.0 + 0.1 * n, n, 64, 48));
    }
    const std::string whole = read_text(file);
    for (std::size_t trial = 0; trial < 60; ++trial) {
        std::string broken = whole.substr(0, whole.size() - trial * whole.size() / 70);
        for (std::size_t k = 0; k < 8; ++k)
            broken[(trial * 7919 + k * k * 104729) % broken.size()] = static_cast<char>(trial * k);
        write_text(folder / ("broken" + form.ending), broken);
        CAPTURE(trial);
        (void)refusal([&] { (void)depths_of(*open_depth(folder / ("broken" + form.ending))); });
    }
    SUCCEED();
}

TEST_CASE("a long bag is opened in time", "[bag]") {
    const TemporaryFolder folder;
    BagForm form = GENERATE(from_range(bag_forms()));
    const fs::path file = folder / ("long" + form.ending);
    CAPTURE(form.name());
    form.chunk_bytes = 1 << 16;
    {
        Bag bag(file, form);
        const int depth = bag.topic("/depth", "Image");
        for (int n = 0; n < 20'000; ++n)
            bag.add(depth, depth_image(1.0 + 0.01 * n, n % 100, 16, 12));
    }
    CHECK(open_depth(file)->description().frames == 20'000);
}
