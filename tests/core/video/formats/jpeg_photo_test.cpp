// Photos of phones: a colour picture, and a depth map inside the same JPEG file.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/depth_photos.hpp"
#include "tests/core/video/stated.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

namespace fs = std::filesystem;

constexpr double kNear = 0.5;
constexpr double kFar = 20.0;
const std::string kInverse =
    "GDepth:Format=\"RangeInverse\" GDepth:Near=\"0.5\" GDepth:Far=\"20\" GDepth:Units=\"m\" ";
const std::string kLinear =
    "GDepth:Format=\"RangeLinear\" GDepth:Near=\"0.5\" GDepth:Far=\"20\" GDepth:Units=\"m\" ";
const std::string kDisparity =
    "<apdi:AuxiliaryImageType>disparity</apdi:AuxiliaryImageType>"
    "<apdi:FloatMinValue>0.25</apdi:FloatMinValue><apdi:FloatMaxValue>2</apdi:FloatMaxValue>";

/// Red on the left, blue on the right.
std::string photo(int columns = 64, int rows = 48) {
    cv::Mat picture(rows, columns, CV_8UC3, cv::Scalar(0, 0, 250));
    picture.colRange(columns / 2, columns).setTo(cv::Scalar(250, 0, 0));
    return encoded_as(picture, ".jpg");
}

/// Four levels more in each column, one in each row.
cv::Mat ramp(int columns = 32, int rows = 24) {
    cv::Mat levels(rows, columns, CV_8UC1);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            levels.at<std::uint8_t>(j, i) = static_cast<std::uint8_t>(4 * i + j);
    return levels;
}

std::string grey_jpeg(int level) {
    return encoded_as(cv::Mat(24, 32, CV_8UC1, cv::Scalar::all(level)), ".jpg");
}

std::string apple_picture(const std::string& elements, int level = 51) {
    return with_segments(grey_jpeg(level), {xmp_segment(xmp_packet("", elements))});
}

StillPicture depth_in(const fs::path& file, const std::string& bytes) {
    write_text(file, bytes);
    REQUIRE(jpeg_has_depth(file));
    return read_still(file, PictureRole::depth);
}

}  // namespace

TEST_CASE("a photo with GDepth opens as colour and as distances by the formula of its format",
          "[jpeg_photo]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "lens_blur.jpg";
    const bool inverse = GENERATE(true, false);
    const auto distance_at = [inverse](double level) {
        const double n = level / 255.0;
        return inverse ? kFar * kNear / (kFar - n * (kFar - kNear)) : kNear + n * (kFar - kNear);
    };
    const StillPicture depth = depth_in(
        file, gdepth_photo(photo(), inverse ? kInverse : kLinear, encoded_as(ramp(), ".png")));
    CHECK(depth.bits == kRealBits);
    CHECK(stated_by(depth).unit == DepthUnit::m);
    CHECK(contains(origins_of(depth.findings), "GDepth"));
    REQUIRE(depth.picture.size() == cv::Size(32, 24));
    for (int j = 0; j < 24; ++j)
        for (int i = 0; i < 32; ++i)
            REQUIRE_THAT(depth.picture.at<float>(j, i), WithinRel(distance_at(4 * i + j), 1e-5));
    const auto media = open_media(file, {}, {.find_out = true});
    REQUIRE(media->description().meaning);
    CHECK(media->description().meaning->near.value == NearLevels::dark);
    CHECK(contains(media->description().meaning->found_in, "GDepth"));  // as `info` prints it
    const auto frame = media->next();
    REQUIRE(frame);
    CHECK(frame->colour.columns == 64);
    CHECK(frame->colour.rgb[0] > 200);
    CHECK(frame->depth.columns == 32);
}

TEST_CASE("a depth map in 16 bits keeps all of its levels, and millimetres their unit",
          "[jpeg_photo]") {
    const TemporaryFolder folder;
    cv::Mat levels;
    ramp().convertTo(levels, CV_16U, 257.0, 1.0);
    const StillPicture depth =
        depth_in(folder / "a.jpg", gdepth_photo(photo(),
                                                "GDepth:Format=\"RangeLinear\" GDepth:Near=\"0\" "
                                                "GDepth:Far=\"65535\" GDepth:Units=\"mm\" ",
                                                encoded_as(levels, ".png")));
    CHECK(stated_by(depth).unit == DepthUnit::mm);
    CHECK_THAT(depth.picture.at<float>(0, 0), WithinAbs(1.0, 1e-3));
    CHECK_THAT(depth.picture.at<float>(2, 3), WithinAbs(14.0 * 257.0 + 1.0, 0.01));
}

TEST_CASE("extended metadata are joined by their offsets, and the sharp original is the colour",
          "[jpeg_photo]") {
    const TemporaryFolder folder;
    cv::Mat noise(300, 400, CV_8UC3);
    cv::randu(noise, cv::Scalar::all(0), cv::Scalar::all(255));
    noise.rowRange(0, 8).setTo(cv::Scalar(0, 250, 0));
    const std::string original = encoded_as(noise, ".jpg");
    REQUIRE(original.size() > 70000);
    const std::size_t segments = original.size() * 4 / 3 / 60000 + 2;
    const std::string bytes =
        gdepth_photo(photo(), kInverse, encoded_as(ramp(), ".jpg"), original, segments);
    const StillPicture depth = depth_in(folder / "a.jpg", bytes);
    CHECK(depth.picture.size() == cv::Size(32, 24));
    CHECK(stated_by(depth).unit == DepthUnit::m);
    const cv::Mat colour = read_still(folder / "a.jpg", PictureRole::colour).picture;
    REQUIRE(colour.size() == cv::Size(400, 300));
    CHECK(colour.at<cv::Vec3b>(2, 5)[1] > 200);
}

TEST_CASE("a depth map without near and far is disparity, or levels that are near where dark",
          "[jpeg_photo]") {
    const TemporaryFolder folder;
    const std::string map = encoded_as(ramp(), ".png");
    const StillPicture inverse = depth_in(folder / "a.jpg", gdepth_photo(photo(), "", map));
    CHECK(stated_by(inverse).unit == DepthUnit::disparity);
    CHECK(inverse.picture.at<std::uint8_t>(0, 0) == 255);  // the nearest level is the brightest
    const StillPicture linear =
        depth_in(folder / "b.jpg",
                 gdepth_photo(photo(), "GDepth:Format=\"RangeLinear\" GDepth:Far=\"inf\" ", map));
    CHECK(stated_by(linear).unit == DepthUnit::levels);
    CHECK(stated_by(linear).near == NearLevels::dark);
    CHECK(linear.picture.at<std::uint8_t>(0, 0) == 0);
}

TEST_CASE("Apple's second picture is disparity, in metres where it is accurate", "[jpeg_photo]") {
    const TemporaryFolder folder;
    const double per_metre = 0.25 + 51.0 / 255.0 * 1.75;
    const StillPicture relative =
        depth_in(folder / "a.jpg", multi_picture(photo(), {apple_picture(kDisparity)}));
    CHECK(stated_by(relative).unit == DepthUnit::disparity);
    CHECK_THAT(relative.picture.at<float>(5, 5), WithinRel(per_metre, 0.02));
    const StillPicture absolute =
        depth_in(folder / "b.jpg",
                 multi_picture(photo(), {apple_picture(kDisparity + "<depthData:Accuracy>absolute"
                                                                    "</depthData:Accuracy>")}));
    CHECK(stated_by(absolute).unit == DepthUnit::m);
    CHECK_THAT(absolute.picture.at<float>(5, 5), WithinRel(1.0 / per_metre, 0.02));
    const auto frame = open_media(folder / "b.jpg")->next();
    REQUIRE(frame);
    CHECK(frame->colour.columns == 64);
    CHECK(frame->depth.columns == 32);
}

TEST_CASE("a grey second picture without metadata is disparity beside a photo in colour",
          "[jpeg_photo]") {
    const TemporaryFolder folder;
    const StillPicture depth =
        depth_in(folder / "a.jpg", multi_picture(photo(), {encoded_as(ramp(), ".jpg")}));
    CHECK(stated_by(depth).unit == DepthUnit::disparity);
    CHECK(depth.bits == 8);
    write_text(folder / "grey.jpg", multi_picture(grey_jpeg(90), {grey_jpeg(70)}));
    CHECK_FALSE(jpeg_has_depth(folder / "grey.jpg"));
    constexpr unsigned kPreview = 0x010001;
    write_text(folder / "preview.jpg", multi_picture(photo(), {grey_jpeg(70)}, kPreview));
    CHECK_FALSE(jpeg_has_depth(folder / "preview.jpg"));
}

TEST_CASE("a gain map, a matte and a preview are no depth", "[jpeg_photo]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "hdr.jpg";
    const std::string gain_map = apple_picture(
        "<apdi:AuxiliaryImageType>urn:com:apple:photo:2020:aux:hdrgainmap"
        "</apdi:AuxiliaryImageType>");
    const std::string matte = apple_picture(
        "<apdi:AuxiliaryImageType>depth</apdi:AuxiliaryImageType>"
        "<apdi:AuxiliaryImageSubType>portraiteffectsmatte</apdi:AuxiliaryImageSubType>");
    const std::string iso = with_segments(
        grey_jpeg(80), {app_segment(2, std::string("urn:iso:std:iso:ts:21496:-1") + '\0')});
    for (const std::string& other : {gain_map, matte, iso, photo(32, 24)}) {
        write_text(file, multi_picture(photo(), {other}));
        CHECK_FALSE(jpeg_has_depth(file));
        CHECK(reader_of(file).name == "picture by OpenCV's codecs");
        const bool is_of_gain = other == gain_map || other == iso;
        CHECK(jpeg_has_gain_map(file) == is_of_gain);
    }
    write_text(file, multi_picture(photo(), {gain_map, apple_picture(kDisparity)}));
    CHECK(jpeg_has_depth(file));
    write_text(file,
               dynamic_depth_photo(photo(), "", {{"Item:Semantic=\"GainMap\"", grey_jpeg(80)}}));
    CHECK_FALSE(jpeg_has_depth(file));
}

TEST_CASE("Dynamic Depth is found behind the photo by the lengths of its directory",
          "[jpeg_photo]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "portrait.jpg";
    const std::string map = encoded_as(ramp(), ".png");
    const std::string range =
        "<DepthMap:Format>RangeInverse</DepthMap:Format><DepthMap:Near>0.5</DepthMap:Near>"
        "<DepthMap:Far>20</DepthMap:Far><DepthMap:DepthURI>own/map</DepthMap:DepthURI>";
    const std::vector<std::string> names{
        "Item:Semantic=\"Depth\"", "Item:DataURI=\"android/depthmap\"", "Item:DataURI=\"own/map\""};
    for (const std::string& name : names) {
        CAPTURE(name);
        const std::string bytes =
            dynamic_depth_photo(photo(), range + "<DepthMap:Units>Meters</DepthMap:Units>",
                                {{"Item:Semantic=\"Original\"", photo(40, 30)}, {name, map}}, 7);
        const StillPicture depth = depth_in(file, bytes);
        CHECK(contains(origins_of(depth.findings), "Dynamic Depth"));
        CHECK(stated_by(depth).unit == DepthUnit::m);
        CHECK_THAT(depth.picture.at<float>(0, 0), WithinRel(0.5, 1e-5));
        CHECK(read_still(file, PictureRole::colour).picture.size() == cv::Size(40, 30));
    }
    const StillPicture unknown =
        depth_in(file, dynamic_depth_photo(photo(), range + "<DepthMap:Units>None</DepthMap:Units>",
                                           {{names[0], map}}));
    CHECK(stated_by(unknown).unit == DepthUnit::disparity);  // one over distances of no unit
    CHECK_THAT(unknown.picture.at<float>(0, 0), WithinRel(2.0, 1e-5));
}

TEST_CASE("colour and depth are upright by the orientation of the photo", "[jpeg_photo]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "turned.jpg";
    constexpr int kQuarterClockwise = 6;
    const auto bytes = [](const cv::Mat& levels) {
        return with_segments(gdepth_photo(photo(), "", encoded_as(levels, ".png")),
                             {orientation_segment(kQuarterClockwise)});
    };
    const cv::Mat turned = depth_in(file, bytes(ramp())).picture;
    CHECK(read_still(file, PictureRole::colour).picture.size() == cv::Size(48, 64));
    REQUIRE(turned.size() == cv::Size(24, 32));
    CHECK(turned.at<std::uint8_t>(0, 23) == 255);      // the upper left corner is upper right
    CHECK(turned.at<std::uint8_t>(0, 0) == 255 - 23);  // the lower left one upper left
    CHECK(turned.at<std::uint8_t>(31, 23) == 255 - 4 * 31);
    const cv::Mat upright = depth_in(file, bytes(ramp(24, 32))).picture;  // stands already
    REQUIRE(upright.size() == cv::Size(24, 32));
    CHECK(upright.at<std::uint8_t>(0, 0) == 255);
}

TEST_CASE("every orientation turns depth as it turns the colour", "[jpeg_photo]") {
    const TemporaryFolder folder;
    const int orientation = GENERATE(range(1, 9));
    CAPTURE(orientation);
    cv::Mat picture(48, 64, CV_8UC1, cv::Scalar::all(200));
    picture(cv::Rect(0, 0, 32, 24)).setTo(20);  // the corner that tells how it lies
    cv::Mat colours;
    cv::merge(std::vector<cv::Mat>{picture, picture, picture}, colours);
    const std::string bytes =
        with_segments(gdepth_photo(encoded_as(colours, ".jpg"), "GDepth:Format=\"RangeLinear\" ",
                                   encoded_as(picture, ".png")),
                      {orientation_segment(orientation)});
    const cv::Mat depth = depth_in(folder / "a.jpg", bytes).picture;
    const cv::Mat colour = read_still(folder / "a.jpg", PictureRole::colour).picture;
    REQUIRE(depth.size() == colour.size());
    const int right = depth.cols - 5;
    const int bottom = depth.rows - 5;
    const std::vector<cv::Point> corners{{5, 5}, {right, 5}, {5, bottom}, {right, bottom}};
    for (const cv::Point& at : corners)
        CHECK(std::abs(depth.at<std::uint8_t>(at) - colour.at<cv::Vec3b>(at)[0]) < 20);
}

TEST_CASE("a plain photo stays colour, and a lost or damaged depth map is told", "[jpeg_photo]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "a.jpg";
    write_text(file, photo());
    CHECK_FALSE(jpeg_has_depth(file));
    CHECK(reader_of(file).name == "picture by OpenCV's codecs");
    write_text(file,
               with_segments(photo(), {xmp_segment(xmp_packet(names_extended_xmp() + kInverse))}));
    CHECK_FALSE(jpeg_has_depth(file));  // a program has dropped the extended part
    write_text(file, gdepth_photo(photo(), kInverse, "no picture"));
    CHECK(reader_of(file).name == "photo with depth (JPEG)");
    CHECK(contains(refusal([&] { (void)open_media(file); }), "depth map is damaged"));
    CHECK(read_still(file, PictureRole::colour).picture.size() == cv::Size(64, 48));
}

TEST_CASE("a photo with depth cut off anywhere is refused in one line or shown",
          "[jpeg_photo][malformed]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "part.jpg";
    const std::string map = encoded_as(ramp(), ".png");
    const std::string whole =
        GENERATE_COPY(gdepth_photo(photo(), kInverse, map, photo(), 3),
                      multi_picture(photo(), {apple_picture(kDisparity)}),
                      dynamic_depth_photo(photo(), "", {{"Item:Semantic=\"Depth\"", map}}));
    for (std::size_t bytes = 1; bytes < whole.size(); bytes += 37) {
        CAPTURE(bytes);
        write_text(file, whole.substr(0, bytes));
        for (const auto role : {PictureRole::depth, PictureRole::colour}) {
            const std::string said = refusal([&] { (void)open_picture_source(file, role); });
            REQUIRE(said.find('\n') == std::string::npos);
        }
        (void)refusal([&] { (void)describe_media(file); });
    }
}

TEST_CASE("metadata that claim other lengths, sizes or entities are refused or passed over",
          "[jpeg_photo][malformed]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "a.jpg";
    const std::string map = encoded_as(ramp(), ".png");
    std::string lie = dynamic_depth_photo(photo(), "", {{"Item:Semantic=\"Depth\"", map}});
    const std::string length = "Item:Length=\"" + std::to_string(map.size());
    lie.replace(lie.find(length), length.size(), std::string(length).replace(13, 1, "9000"));
    write_text(file, lie);
    CHECK_FALSE(jpeg_has_depth(file));
    std::string large = map;
    const std::string side("\0\x0f\xff\xff", 4);
    large.replace(16, 4, side).replace(20, 4, side);
    write_text(file, gdepth_photo(photo(), kInverse, large));
    CHECK(contains(refusal([&] { (void)read_still(file, PictureRole::depth); }), "damaged"));
    const std::string packet = xmp_packet(kInverse + "GDepth:Data=\"" + base64_text(map) + "\"");
    write_text(file, with_segments(photo(), {xmp_segment(packet)}));
    CHECK(read_still(file, PictureRole::depth).picture.size() == cv::Size(32, 24));
    std::string grows = packet;  // a parser writes it before each name
    const std::string space = "http://ns.adobe.com/xmp/note/";
    grows.replace(grows.find(space), space.size(), std::string(1000, 'n'));
    for (const std::string& hostile : {"<!DOCTYPE x []>" + packet, grows}) {
        write_text(file, with_segments(photo(), {xmp_segment(hostile)}));
        CHECK(contains(refusal([&] { (void)read_still(file, PictureRole::depth); }), "damaged"));
    }
}
