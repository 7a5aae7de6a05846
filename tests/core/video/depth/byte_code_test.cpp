// Depth that is a number in the bytes of a picture's channels becomes depth again, and coloured
// pictures that hold none are never taken by their brightness.
#include "core/video/depth/byte_code.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/video/depth/level_code.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/sidecar.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

namespace fs = std::filesystem;

const DepthRequest kAsFound{.find_out = true};

DepthRequest told(DepthCode code) {
    return {.find_out = true, .command_line = {.code = code}};
}

/// The scene between two numbers; NaN: no data.
cv::Mat scene_between(double nearest, double farthest) {
    cv::Mat numbers;
    scene_depth().convertTo(numbers, CV_32F, farthest - nearest, nearest);
    return numbers;
}

/// Millimetres from 500 to 4500.
cv::Mat rg16_scene() {
    return in_bytes(scene_between(500.0, 4500.0), DepthCode::rg16);
}

/// Metres from 2 to 80 as CARLA writes them, and the sky.
cv::Mat rgb24_scene() {
    cv::Mat numbers = scene_between(2.0, 80.0);
    numbers.convertTo(numbers, CV_32F, 16777.215);
    numbers.setTo(16777215.0, ~(numbers == numbers));
    return in_bytes(numbers, DepthCode::rgb24);
}

cv::Mat painted_scene() {
    cv::Mat levels;
    scene_depth().convertTo(levels, CV_8U, 255.0);
    cv::applyColorMap(levels, levels, cv::COLORMAP_VIRIDIS);
    return levels;
}

void check_one_line(const std::string& line, const fs::path& file) {
    CHECK(contains(line, file.filename().string()));
    CHECK(contains(line, ": "));
    CHECK(line.find('\n') == std::string::npos);
}

DepthMeaning meaning_of(const Media& media) {
    return media.description().meaning.value();
}

}  // namespace

TEST_CASE("each code of bytes has its number", "[bytes]") {
    // Blue, green, red, alpha.
    const cv::Mat bgra(2, 3, CV_8UC4, cv::Scalar(3, 2, 1, 64));
    cv::Mat bgr;
    cv::cvtColor(bgra, bgr, cv::COLOR_BGRA2BGR);
    CHECK(numbers_in_bytes(bgr, DepthCode::rg16).at<std::uint16_t>(1, 2) == 256 + 2);
    CHECK(numbers_in_bytes(bgr, DepthCode::rgb24).at<float>(1, 2) == 1.0F + 512.0F + 196608.0F);
    const auto height_m =
        static_cast<double>(numbers_in_bytes(bgr, DepthCode::terrain).at<float>(1, 2));
    CHECK_THAT(height_m, WithinAbs(-10000.0 + 0.1 * (65536.0 + 512.0 + 3.0), 1e-3));
    // The bytes 01 02 03 40 of a little-endian float: 2 (1 + 0x030201 / 2^23).
    CHECK(numbers_in_bytes(bgra, DepthCode::float32).at<float>(1, 2) ==
          2.0F * (1.0F + 197121.0F / 8388608.0F));
    CHECK(numbers_in_bytes(bgra, DepthCode::rg16).at<std::uint16_t>(0, 0) == 258);
    CHECK(numbers_in_bytes(bgr, DepthCode::gb16).at<std::uint16_t>(1, 2) == 512 + 3);
    CHECK(numbers_in_bytes(bgr, DepthCode::bgr24).at<float>(1, 2) == 65536.0F + 512.0F + 3.0F);
    // The bytes 03 02 01 40.
    CHECK(numbers_in_bytes(bgra, DepthCode::float32_bgra).at<float>(1, 2) ==
          2.0F * (1.0F + 66051.0F / 8388608.0F));
}

TEST_CASE("a picture without these bytes has no data", "[bytes]") {
    const cv::Mat picture = GENERATE(cv::Mat(4, 5, CV_8UC1, cv::Scalar(7)),
                                     cv::Mat(4, 5, CV_16UC3, cv::Scalar(7, 7, 7)),
                                     cv::Mat(4, 5, CV_32FC1, cv::Scalar(7)));
    CHECK(cv::countNonZero(numbers_in_bytes(picture, DepthCode::rg16)) == 0);
    const cv::Mat real = numbers_in_bytes(picture, DepthCode::terrain);
    CHECK(real.size() == picture.size());
    CHECK(cv::countNonZero(real == real) == 0);
    CHECK(numbers_in_bytes(cv::Mat(), DepthCode::rg16).empty());
    const cv::Mat without_alpha =
        numbers_in_bytes(cv::Mat(4, 5, CV_8UC3, cv::Scalar(1, 2, 3)), DepthCode::float32);
    CHECK(cv::countNonZero(without_alpha == without_alpha) == 0);
}

TEST_CASE("a code is found out by bytes that wrap where the next byte steps", "[bytes]") {
    const auto found = [](const cv::Mat& picture) {
        const std::array pictures{picture};
        return byte_code_in(pictures);
    };
    CHECK(found(rg16_scene()) == DepthCode::rg16);
    CHECK(found(rgb24_scene()) == DepthCode::rgb24);
    CHECK(found(in_bytes(scene_between(0.6, 9.0), DepthCode::float32)) == DepthCode::float32);
    CHECK(found(in_bytes(scene_between(500.0, 900.0), DepthCode::float32)) == DepthCode::float32);
    CHECK(found(in_bytes(scene_between(300.0, 2900.0), DepthCode::terrain)) == DepthCode::terrain);
    CHECK(found(in_bytes(scene_between(500.0, 4500.0), DepthCode::gb16)) == DepthCode::gb16);
    CHECK(found(in_bytes(scene_between(3e6, 1.5e7), DepthCode::bgr24)) == DepthCode::bgr24);
    CHECK(found(in_bytes(scene_between(0.6, 9.0), DepthCode::float32_bgra)) ==
          DepthCode::float32_bgra);
    cv::Mat even(kSceneRows, kSceneColumns, CV_32F);  // continuous in both orders of a float
    for (int i = 0; i < even.cols; ++i)
        even.col(i) = cv::Scalar(std::round(1500.0 + 4.0 * i) / 1000.0);
    for (const DepthCode code : {DepthCode::float32, DepthCode::float32_bgra})
        CHECK(found(in_bytes(even, code)) == code);
    cv::Mat noisy = scene_between(500.0, 4500.0);  // as a sensor's, 6 mm
    cv::Mat noise(noisy.size(), CV_32F);
    cv::RNG(9).fill(noise, cv::RNG::NORMAL, 0.0, 6.0);
    noisy += noise;
    CHECK(found(in_bytes(noisy, DepthCode::rg16)) == DepthCode::rg16);
    // Things a little higher than the table that they lie on: half of the steps are edges.
    cv::Mat table = scene_between(3e6, 9e6);
    for (int j = 4; j + 4 < kSceneRows; j += 8)
        for (int i = 4; i + 4 < kSceneColumns; i += 8) {
            cv::Mat thing = table(cv::Rect(i, j, 4, 4));
            thing -= cv::Scalar(9000.0 * (3 + (i + j) / 4 % 8));
        }
    CHECK(found(in_bytes(table, DepthCode::bgr24)) == DepthCode::bgr24);
    cv::Mat opaque;  // as CARLA writes it
    cv::cvtColor(rgb24_scene(), opaque, cv::COLOR_BGR2BGRA);
    CHECK(found(opaque) == DepthCode::rgb24);
    CHECK_FALSE(found(scene_photo()));
    CHECK_FALSE(found(painted_scene()));
    CHECK_FALSE(found(painted(scene_depth(), as_hue)));
    CHECK_FALSE(found(painted(scene_depth(), as_grey)));
    cv::Mat see_through;
    cv::cvtColor(scene_photo(), see_through, cv::COLOR_BGR2BGRA);
    CHECK_FALSE(found(see_through));
    cv::Mat squares(kSceneRows, kSceneColumns, CV_8UC3);  // a byte steps where the next one wraps
    for (int j = 0; j < kSceneRows; ++j)
        for (int i = 0; i < kSceneColumns; ++i) {
            const int number = 25000 + (i / 40 + j / 40) % 2 * 100;
            squares.at<cv::Vec3b>(j, i) = {static_cast<std::uint8_t>(number / 256),
                                           static_cast<std::uint8_t>(number % 256), 90};
        }
    CHECK_FALSE(found(squares));
    CHECK_FALSE(byte_code_in({}));
}

TEST_CASE("pictures that decode by two codes of contrary orders are of none", "[bytes]") {
    // The left half has its highest byte in red, the right half in blue.
    cv::Mat both = in_bytes(scene_between(3e6, 1.5e7), DepthCode::bgr24);
    cv::Mat right = both.colRange(kSceneColumns / 2, kSceneColumns);
    cv::cvtColor(right.clone(), right, cv::COLOR_BGR2RGB);
    const std::array halves{both};
    CHECK_FALSE(byte_code_in(halves));
    const std::array films{in_bytes(scene_between(3e6, 1.5e7), DepthCode::bgr24), rgb24_scene()};
    CHECK_FALSE(byte_code_in(films));
}

TEST_CASE("a stated code whose bytes are in another order is refused with the right one",
          "[bytes]") {
    const TemporaryFolder folder;
    const auto [stated, right] =
        GENERATE(table<DepthCode, DepthCode>({{DepthCode::float32, DepthCode::float32_bgra},
                                              {DepthCode::float32_bgra, DepthCode::float32},
                                              {DepthCode::rgb24, DepthCode::bgr24},
                                              {DepthCode::rg16, DepthCode::gb16}}));
    CAPTURE(name_of(stated));
    const bool is_float = least_channels(right) == 4;
    const double nearest = is_float ? 0.6 : right == DepthCode::gb16 ? 500.0 : 3e6;
    const double farthest = is_float ? 9.0 : right == DepthCode::gb16 ? 4500.0 : 1.5e7;
    picture(in_bytes(scene_between(nearest, farthest), right))(folder / "a.png");
    const DepthRequest request = told(stated);
    const std::string line = refusal([&] { (void)open_depth(folder / "a.png", request); });
    check_one_line(line, folder / "a.png");
    CHECK(line.ends_with("--depth-code " + std::string(name_of(right))));
    const DepthMeaning meaning = meaning_of(*open_depth(folder / "a.png", kAsFound));
    CHECK(meaning.code == Known<DepthCode>{right, Origin::found});
}

TEST_CASE("24 bits with red as the highest byte may be distances or heights, which is asked",
          "[bytes]") {
    const TemporaryFolder folder;
    picture(in_bytes(scene_between(3e6, 1.5e7), DepthCode::bgr24))(folder / "a.png");
    const auto media = open_depth(folder / "a.png", kAsFound);
    CHECK(media->description().conclusion.near_sure < kSureEnough);
    for (const NearLevels near : kNearLevels) {
        CAPTURE(name_of(near));
        const auto& offered = media->description().conclusion.alternatives;
        CHECK(std::any_of(offered.begin(), offered.end(), [near](const DepthAlternative& answer) {
            return answer.statement.near == near;
        }));
    }
}

TEST_CASE("what a code means in itself is known with it", "[bytes]") {
    const TemporaryFolder folder;
    picture(rgb24_scene())(folder / "a.png");
    const auto media = open_media(folder / "a.png", {}, kAsFound);
    const DepthMeaning meaning = meaning_of(*media);
    CHECK(meaning.code == Known<DepthCode>{DepthCode::rgb24, Origin::found});
    CHECK(meaning.near.value == NearLevels::dark);
    CHECK(meaning.unit.value == DepthUnit::levels);
    CHECK(meaning.found_in == "the bytes of its colours, which carry as those of numbers");
    const auto frame = media->next();
    REQUIRE(frame);
    CHECK(std::isnan(frame->depth.at(100, 5)));  // the sky
    CHECK(frame->depth.at(110, 130) > frame->depth.at(260, 150));
    picture(in_bytes(scene_between(300.0, 2900.0), DepthCode::terrain))(folder / "b.png");
    const auto terrain = open_media(folder / "b.png", {}, kAsFound);
    CHECK(meaning_of(*terrain).near.value == NearLevels::bright);
    const auto heights = terrain->next();
    REQUIRE(heights);
    CHECK(heights->depth.at(260, 150) > heights->depth.at(110, 130));  // higher is nearer
}

TEST_CASE("a folder of pictures in bytes is decoded, and CARLA's are in metres", "[bytes]") {
    const TemporaryFolder folder;
    const bool is_carla = GENERATE(true, false);
    const fs::path place = folder / (is_carla ? "carla_town" : "town");
    fs::create_directories(place / "depth");
    fs::create_directories(place / "rgb");
    for (int k = 0; k < 3; ++k) {
        picture(rgb24_scene())(place / "depth" / (std::to_string(k) + ".png"));
        picture(scene_photo())(place / "rgb" / (std::to_string(k) + ".png"));
    }
    const bool as_two = GENERATE(true, false);
    const auto media = as_two ? open_media(place / "rgb", place / "depth", kAsFound)
                              : open_media(place, {}, kAsFound);
    const DepthMeaning meaning = meaning_of(*media);
    CHECK(meaning.code.value == DepthCode::rgb24);
    CHECK(media->description().frames == 3);
    CHECK(media->next()->colour.columns == kSceneColumns);
    CHECK(meaning.unit.value == (is_carla ? DepthUnit::m : DepthUnit::levels));
    if (is_carla) {
        CHECK(meaning.unit.origin == Origin::found);
        CHECK(media->description().conclusion.alternatives.empty());
        CHECK_THAT(meaning.range.value.near, WithinRel(2.0 + 78.0 * 0.02, 0.1));
        CHECK_THAT(meaning.range.value.far, WithinRel(2.0 + 78.0 * 0.9, 0.1));
    }
}

TEST_CASE("compression with losses destroys low bytes, which is said with the codec", "[bytes]") {
    const TemporaryFolder folder;
    const auto [name, encoding, codec] = GENERATE(table<std::string, std::string, std::string>(
        {{"a_depth.jpg", "", "JPG"},
         {"a_depth.mp4", "-c:v libx264 -crf 18 -pix_fmt yuv420p", "avc1"},
         {"a_depth.mp4", "-c:v libx264 -qp 0 -pix_fmt yuv444p", "avc1"},
         {"a_depth.mkv", "-c:v libx264rgb -crf 28 -pix_fmt bgr24", "H.264"},
         {"a_depth.mkv", "-c:v ffv1 -pix_fmt yuv420p", "FFV1"}}));
    CAPTURE(name, encoding);
    const fs::path file = folder / name;
    if (encoding.empty())
        picture(rg16_scene())(file);
    else
        video(rg16_scene(), "bgr24", encoding)(file);
    const std::string as_told = refusal([&] { (void)open_depth(file, told(DepthCode::rg16)); });
    check_one_line(as_told, file);
    CHECK(contains(as_told, "the low bytes of its depth"));
    CHECK(contains(as_told, codec));
    const std::string as_found = refusal([&] { (void)open_depth(file, kAsFound); });
    check_one_line(as_found, file);
    CHECK(contains(as_found, "neither grey nor a known code of depth"));
    CHECK((codec == "FFV1" || contains(as_found, "losses of " + codec)));
    CHECK(refusal([&] { (void)describe_media(file); }) == as_found);
}

TEST_CASE("a code that the picture cannot hold is refused", "[bytes]") {
    const TemporaryFolder folder;
    picture(cv::Mat(20, 20, CV_8UC1, cv::Scalar(9)))(folder / "grey.png");
    picture(cv::Mat(20, 20, CV_16UC3, cv::Scalar(9, 8, 7)))(folder / "deep.png");
    picture(rg16_scene())(folder / "colours.png");
    const std::array codes{DepthCode::rg16, DepthCode::terrain, DepthCode::float32};
    const std::array<fs::path, 3> files{folder / "grey.png", folder / "deep.png",
                                        folder / "colours.png"};
    for (std::size_t k = 0; k < files.size(); ++k) {
        CAPTURE(files[k]);
        const std::string line = refusal([&] { (void)open_depth(files[k], told(codes[k])); });
        check_one_line(line, files[k]);
        CHECK(contains(line, std::string(name_of(codes[k]))));
    }
}

TEST_CASE("coloured pictures without a code are refused as depth, in every form", "[bytes]") {
    const TemporaryFolder folder;
    const cv::Mat colours = GENERATE(some_of<cv::Mat>({painted_scene(), scene_photo()}, 1));
    cv::Mat rgb;
    cv::cvtColor(colours, rgb, cv::COLOR_BGR2RGB);
    cv::Mat real;
    colours.convertTo(real, CV_32F, 0.01);
    fs::create_directory(folder / "depth");
    for (int k = 0; k < 2; ++k) picture(colours)(folder / "depth" / (std::to_string(k) + ".png"));
    picture(colours)(folder / "a_depth.png");
    video(colours, "bgr24", "-c:v libx264 -crf 18 -pix_fmt yuv420p")(folder / "a_depth.mp4");
    // Not named as the picture, which else is taken for a painting of these numbers.
    write_text(folder / "b_depth.npy", npy("|u1", "(240, 320, 3)", bytes_of(rgb)));
    write_text(folder / "c_depth.pfm", pfm(real, "-1", true));
    for (const char* const name :
         {"depth", "a_depth.png", "a_depth.mp4", "b_depth.npy", "c_depth.pfm"}) {
        CAPTURE(name);
        const fs::path file = folder / name;
        const std::string line = refusal([&] { (void)open_depth(file, kAsFound); });
        check_one_line(line, file);
        CHECK(contains(line, "--depth-code"));
        // Their brightness, where a person wants it, and in the paper's mode.
        CHECK(refusal([&] { (void)open_depth(file, told(DepthCode::grey)); }).empty());
        CHECK(refusal([&] { (void)open_depth(file); }).empty());
    }
    picture(beside(scene_photo(), colours))(folder / "both.png");
    DepthRequest packed = kAsFound;
    packed.command_line.packing = DepthPacking::left_right;
    CHECK(contains(refusal([&] { (void)open_media(folder / "both.png", {}, packed); }),
                   "--depth-code"));
}

TEST_CASE("grey that compression has tinted a little is grey", "[bytes]") {
    const TemporaryFolder folder;
    cv::Mat tinted = painted(scene_depth(), as_grey);
    tinted += cv::Scalar(0, 9, 3);
    tinted(cv::Rect(10, 30, 12, 12)).setTo(cv::Scalar(30, 40, 200));
    picture(tinted)(folder / "a_depth.png");
    CHECK(meaning_of(*open_depth(folder / "a_depth.png", kAsFound)).code.value == DepthCode::grey);
}

TEST_CASE("every code has a name that a sidecar keeps", "[bytes]") {
    for (const DepthCode code : kDepthCodes) {
        CAPTURE(name_of(code));
        const DepthStatement said{.code = code};
        CHECK(statement_in(toml_of(said), "a") == said);
        const bool is_number = is_of_bytes(code) || is_of_levels(code);
        CHECK(is_number == (code != DepthCode::grey && code != DepthCode::hue));
        CHECK_FALSE((is_of_bytes(code) && is_of_levels(code)));
    }
}

TEST_CASE("halves in bytes are found out, or told", "[bytes]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "both.mkv";
    video(above(scene_photo(), rg16_scene()), "bgr24", "-c:v ffv1 -pix_fmt bgr0")(file);
    const bool is_told = GENERATE(true, false);
    DepthRequest request = is_told ? told(DepthCode::rg16) : kAsFound;
    request.command_line.packing = DepthPacking::top_bottom;
    const auto media = open_media(file, {}, request);
    const Origin origin = is_told ? Origin::command_line : Origin::found;
    CHECK(meaning_of(*media).code == Known<DepthCode>{DepthCode::rg16, origin});
    CHECK(media->description().depth_bits == 16);
    const auto frame = media->next();
    REQUIRE(frame);
    CHECK(frame->depth.rows == kSceneRows);
    CHECK(frame->depth.at(110, 130) > frame->depth.at(260, 150));
}
