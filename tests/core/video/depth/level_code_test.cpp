// Levels that are no distances are decoded, and found out where they show it.
#include "core/video/depth/level_code.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinRel;
namespace fs = std::filesystem;

namespace {

constexpr double kNearest_m = 0.8;
constexpr double kFarthest_m = 3.8;

/// Metres; NaN: no data.
cv::Mat scene_m() {
    return scene_depth() * (kFarthest_m - kNearest_m) + kNearest_m;
}

cv::Mat whole(const cv::Mat& numbers, int none) {
    cv::Mat levels;
    cv::patchNaNs(numbers, 0.0);
    numbers.convertTo(levels, CV_16U);
    levels.setTo(none, levels == 0);
    return levels;
}

/// As a Kinect v1 has it.
cv::Mat kinect_levels() {
    cv::Mat inverse;
    cv::divide(1.0, scene_m(), inverse);
    const cv::Mat levels = (3.3309495161 - inverse) / 0.0030711016;
    return whole(levels, 2047);
}

cv::Mat points() {
    const cv::Mat z = scene_m();
    cv::Mat all(z.size(), CV_32FC3);
    for (int j = 0; j < z.rows; ++j)
        for (int i = 0; i < z.cols; ++i) {
            const float far = z.at<float>(j, i);
            const auto right = static_cast<float>(i - z.cols / 2) / 250.0F;
            const auto down = static_cast<float>(j - z.rows / 2) / 250.0F;
            all.at<cv::Vec3f>(j, i) = {far, far * down, far * right};
        }
    return all;
}

std::optional<DepthCode> found(const cv::Mat& picture) {
    return level_code_in({&picture, 1});
}

}  // namespace

TEST_CASE("bits that are turned to the left by three are turned back", "[levels]") {
    const cv::Mat turned(2, 2, CV_16UC1, cv::Scalar((1234 << 3) % 65536));
    CHECK(numbers_in_levels(turned, DepthCode::turned16, {}).at<std::uint16_t>(1, 1) == 1234);
    const cv::Mat far(2, 2, CV_16UC1, cv::Scalar((9000 << 3) % 65536 + (9000 >> 13)));
    CHECK(numbers_in_levels(far, DepthCode::turned16, {}).at<std::uint16_t>(0, 0) == 9000);
    CHECK(may_be_of({&turned, 1}, DepthCode::turned16));
    const cv::Mat plain(2, 2, CV_16UC1, cv::Scalar(1235));
    CHECK_FALSE(may_be_of({&plain, 1}, DepthCode::turned16));
}

TEST_CASE("raw disparities of a Kinect are distances, in either order of their bytes", "[levels]") {
    const bool is_swapped = GENERATE(false, true);
    const auto level = [=](int raw) { return is_swapped ? (raw << 8 | raw >> 8) & 0xffff : raw; };
    cv::Mat raw(1, 3, CV_16UC1, cv::Scalar(level(800)));
    raw.at<std::uint16_t>(0, 1) = static_cast<std::uint16_t>(level(2047));
    raw.at<std::uint16_t>(0, 2) = 0;
    const cv::Mat distances = numbers_in_levels(raw, DepthCode::kinect11, kKinectLevels);
    CHECK_THAT(static_cast<double>(distances.at<float>(0, 0)),
               WithinRel(1000.0 / (3.3309495161 - 800.0 * 0.0030711016), 1e-6));
    CHECK(std::isnan(distances.at<float>(0, 1)));
    CHECK(std::isnan(distances.at<float>(0, 2)));
}

TEST_CASE("disparities with a calibration are distances, and infinite ones are none", "[levels]") {
    cv::Mat disparities(1, 2, CV_32FC1, cv::Scalar(30.0));
    disparities.at<float>(0, 1) = INFINITY;
    const cv::Mat distances = numbers_in_levels(disparities, DepthCode::stereo, {50000.0, 20.0});
    CHECK(distances.at<float>(0, 0) == 1000.0F);
    CHECK(std::isnan(distances.at<float>(0, 1)));
}

TEST_CASE("a picture of other bits or channels has no data in a code of levels", "[levels]") {
    const cv::Mat bytes(3, 4, CV_8UC3, cv::Scalar(1, 2, 3));
    CHECK(cv::countNonZero(numbers_in_levels(bytes, DepthCode::turned16, {})) == 0);
    const auto code = GENERATE(DepthCode::kinect11, DepthCode::stereo, DepthCode::xyz);
    const cv::Mat numbers = numbers_in_levels(bytes, code, kKinectLevels);
    REQUIRE(numbers.size() == bytes.size());
    CHECK(std::isnan(numbers.at<float>(2, 3)));
    CHECK(numbers_in_levels(cv::Mat(), code, kKinectLevels).empty());
}

TEST_CASE("levels show a Kinect by its 2047, and points by the rays of a camera", "[levels]") {
    CHECK(found(kinect_levels()) == DepthCode::kinect11);
    CHECK(found(points()) == DepthCode::xyz);
    CHECK_FALSE(found(whole(scene_m() * 1000.0, 0)).has_value());
    CHECK_FALSE(found(whole(scene_m() * 1000.0, 2047)).has_value());
    cv::Mat photo;
    scene_photo().convertTo(photo, CV_32F, 1.0 / 255.0);
    CHECK_FALSE(found(photo).has_value());
    CHECK_FALSE(found(cv::Mat(40, 40, CV_32FC3, cv::Scalar(0.0, 0.0, 0.0))).has_value());
    CHECK_FALSE(level_code_in({}).has_value());
}

TEST_CASE("levels that are all multiples of 8 show bits turned by three", "[levels]") {
    const cv::Mat far_mm = whole(scene_m() * 1000.0, 0);
    const cv::Mat turned = far_mm * 8.0;
    CHECK(found(turned) == DepthCode::turned16);
    CHECK_FALSE(found(far_mm * 16.0).has_value());
    CHECK_FALSE(found(whole(scene_m() * 60.0, 0) * 8.0).has_value());  // of 8 bits
    CHECK_FALSE(found(cv::Mat(40, 40, CV_16UC1, cv::Scalar(8000.0))).has_value());
    const TemporaryFolder folder;
    picture(turned)(folder / "a.png");
    const DepthMeaning meaning =
        *open_depth(folder / "a.png", {.find_out = true})->description().meaning;
    CHECK(meaning.code.value == DepthCode::turned16);
    CHECK_THAT(meaning.range.value.near, WithinRel(1000.0 * kNearest_m, 0.1));
    picture(turned)(folder / "a_disparity.png");
    CHECK(open_depth(folder / "a_disparity.png", {.find_out = true})
              ->description()
              .meaning->code.value == DepthCode::grey);
}

TEST_CASE("distances that go on where the three highest bits change have a confidence there",
          "[levels]") {
    const cv::Mat millimetres = whole(scene_m() * 1000.0, 0);
    const cv::Mat confident = below_confidence(millimetres);
    CHECK(found(confident) == DepthCode::depth16);
    const cv::Mat back = numbers_in_levels(confident, DepthCode::depth16, {});
    CHECK(cv::countNonZero(back != millimetres) == 0);
    CHECK(level_code_meaning(DepthCode::depth16).no_data == std::vector<double>{0.0});
    // Distances that pass 8192, and outlines before what is far behind them.
    CHECK_FALSE(found(whole(scene_m() * 4000.0, 0)).has_value());
    CHECK_FALSE(found(whole(scene_m() * 17000.0, 0)).has_value());
    CHECK_FALSE(found(below_confidence(cv::Mat(90, 90, CV_16UC1, cv::Scalar(900)))).has_value());
    // A name alone makes no code, but a few such places are enough beside it.
    CHECK_FALSE(may_be_of({&millimetres, 1}, DepthCode::depth16));
    cv::Mat few = millimetres.clone();
    few.rowRange(100, 130).colRange(10, 40) += cv::Scalar(8192 * 5);
    CHECK_FALSE(found(few).has_value());
    CHECK(may_be_of({&few, 1}, DepthCode::depth16));
    const TemporaryFolder folder;
    picture(confident)(folder / "a_depth.png");
    const DepthMeaning meaning =
        *open_depth(folder / "a_depth.png", {.find_out = true})->description().meaning;
    CHECK(meaning.code == Known<DepthCode>{DepthCode::depth16, Origin::found});
    CHECK(meaning.unit == Known<DepthUnit>{DepthUnit::mm, Origin::found});
    CHECK_THAT(meaning.range.value.far, WithinRel(1000.0 * kFarthest_m, 0.1));
    picture(confident)(folder / "a_depth_mm.png");
    CHECK(open_depth(folder / "a_depth_mm.png", {.find_out = true})
              ->description()
              .meaning->code.value == DepthCode::depth16);
    picture(confident)(folder / "a_disparity.png");
    CHECK(open_depth(folder / "a_disparity.png", {.find_out = true})
              ->description()
              .meaning->code.value == DepthCode::grey);
}

TEST_CASE("found levels are felt as distances, unless a person says what they are", "[levels]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "a.png";
    picture(kinect_levels())(file);
    const auto opened = open_depth(file, {.find_out = true});
    const DepthMeaning& meaning = *opened->description().meaning;
    CHECK(meaning.code.value == DepthCode::kinect11);
    CHECK(meaning.unit.value == DepthUnit::mm);
    CHECK_THAT(meaning.range.value.near, WithinRel(1000.0 * kNearest_m, 0.1));
    CHECK_THAT(meaning.range.value.far, WithinRel(1000.0 * kFarthest_m, 0.1));
    const auto own =
        open_depth(file, {.find_out = true, .command_line = {.unit = DepthUnit::disparity}});
    CHECK(own->description().meaning->code.value == DepthCode::grey);
    CHECK(open_depth(file)->description().depth_bits == 16);
}

TEST_CASE("a stated code of levels is taken, or refused with its reason", "[levels]") {
    const TemporaryFolder folder;
    picture(whole(scene_m() * 1000.0, 0))(folder / "a.png");
    const auto with = [&folder](DepthCode code) {
        return refusal([&] {
            (void)open_depth(folder / "a.png", {.find_out = true, .command_line = {.code = code}});
        });
    };
    CHECK(with(DepthCode::turned16).empty());
    CHECK(with(DepthCode::xyz).find("three channels") != std::string::npos);
    CHECK(with(DepthCode::stereo).find("calib.txt") != std::string::npos);
}
