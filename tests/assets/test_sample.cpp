// The built-in sample's files: small, complete, and what the program in the repository renders.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>

#include "assets/sample/picture.hpp"
#include "tests/assets/sample_files.hpp"
#include "tests/support/catch.hpp"

namespace {

using dibhr::sample::kColumns;
using dibhr::sample::kFrames;
using dibhr::sample::kFramesPerSecond;
using dibhr::sample::kRows;
using dibhr::sample::Picture;
using dibhr::test::asset;
using dibhr::test::sample_video;

/// |decoded - exact| of every pixel, in levels, smallest first.
std::vector<double> depth_errors(const cv::Mat& decoded, const Picture& picture) {
    std::vector<double> errors(picture.level.size());
    for (std::size_t i = 0; i < errors.size(); ++i)
        errors[i] =
            std::abs(static_cast<double>(decoded.data[i]) - static_cast<double>(picture.level[i]));
    std::sort(errors.begin(), errors.end());
    return errors;
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Largest second difference along rows and columns of a depth picture inside `area`.
template <typename Level>
double roughest(const Level* level, cv::Rect area) {
    double worst = 0.0;
    for (int y = area.y; y < area.y + area.height; ++y)
        for (int x = area.x; x < area.x + area.width; ++x) {
            const Level* here = level + y * kColumns + x;
            for (const int step : {1, kColumns}) {
                const double bend = static_cast<double>(here[-step]) -
                                    2.0 * static_cast<double>(here[0]) +
                                    static_cast<double>(here[step]);
                worst = std::max(worst, std::abs(bend));
            }
        }
    return worst;
}

/// The first picture is rendered once.
Picture picture_of(int frame) {
    static const Picture first = dibhr::sample::picture_of(0);
    return frame == 0 ? first : dibhr::sample::picture_of(frame);
}

void check_rendered(int frame) {
    CAPTURE(frame);
    const auto index = static_cast<std::size_t>(frame);
    REQUIRE(sample_video().colour.size() > index);
    REQUIRE(sample_video().depth.size() > index);
    Picture picture = picture_of(frame);

    const cv::Mat rendered{kRows, kColumns, CV_8UC3, picture.bgr.data()};
    CHECK(cv::PSNR(sample_video().colour[index], rendered) >= 34.0);
    const auto errors = depth_errors(sample_video().depth[index], picture);
    CHECK(mean(errors) <= 0.5);
    CHECK(errors[errors.size() * 99U / 100U] <= 1.0);
}

}  // namespace

TEST_CASE("the sample is ten seconds of 640x480 colour and depth at 30 frames a second",
          "[sample]") {
    REQUIRE(sample_video().colour.size() == static_cast<std::size_t>(kFrames));
    REQUIRE(sample_video().depth.size() == static_cast<std::size_t>(kFrames));
    CHECK(sample_video().colour[0].size() == cv::Size{kColumns, kRows});
    CHECK(sample_video().depth[0].size() == cv::Size{kColumns, kRows});
    CHECK_THAT(sample_video().colour_frames_per_s,
               Catch::Matchers::WithinAbs(kFramesPerSecond, 1e-3));
    CHECK_THAT(sample_video().depth_frames_per_s,
               Catch::Matchers::WithinAbs(kFramesPerSecond, 1e-3));
}

TEST_CASE("the sample's two files are at most 6 MB together", "[sample]") {
    const auto bytes = std::filesystem::file_size(asset("sample/color.mp4")) +
                       std::filesystem::file_size(asset("sample/depth.mp4"));
    CHECK(bytes <= 6'000'000U);
}

TEST_CASE("the program still makes the sample: decoded frames are the rendered ones", "[sample]") {
    check_rendered(0);
    check_rendered(150);
}

TEST_CASE("the program still makes the sample: further decoded frames are the rendered ones",
          "[sample][long]") {
    check_rendered(75);
    check_rendered(299);
}

TEST_CASE("the depth of a cheek bends by less than a level from pixel to pixel", "[sample]") {
    const Picture picture = picture_of(0);
    const cv::Rect cheek = GENERATE(cv::Rect{270, 184, 20, 26}, cv::Rect{347, 184, 20, 26});
    CHECK(roughest(picture.level.data(), cheek) <= 0.5);
    REQUIRE_FALSE(sample_video().depth.empty());
    CHECK(roughest(sample_video().depth[0].ptr(), cheek) <= 1.0);
}

TEST_CASE(
    "the wall behind the person is smooth and nowhere a void, and nothing is cut off at white",
    "[sample]") {
    REQUIRE(sample_video().depth.size() == static_cast<std::size_t>(kFrames));
    double lowest = 255.0, highest = 0.0;
    for (const cv::Mat& depth : sample_video().depth) {
        double low = 0.0, high = 0.0;
        cv::minMaxLoc(depth, &low, &high);
        lowest = std::min(lowest, low);
        highest = std::max(highest, high);
    }
    CHECK(lowest >= 15.0);
    CHECK(highest >= 240.0);
    CHECK(highest <= 254.0);
    CHECK(roughest(sample_video().depth[0].ptr(), {10, 10, 150, 250}) <= 1.0);
}
