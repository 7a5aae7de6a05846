// One scene of known depth in the codes that depth comes in.
#include "tests/core/video/coded_scene.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace dibhr::test {

namespace {

enum class Thing { none, plane, ball, step };

constexpr double kBallRadius = 60.0;

Thing thing_at(double x, double y) {
    if (y < 20.0) return Thing::none;
    if (x > 230.0 && x < 290.0 && y > 80.0 && y < 200.0) return Thing::step;
    return std::hypot(x - 110.0, y - 130.0) < kBallRadius ? Thing::ball : Thing::plane;
}

double depth_at(double x, double y) {
    switch (thing_at(x, y)) {
        case Thing::none:
            return std::numeric_limits<double>::quiet_NaN();
        case Thing::step:
            return 0.9;
        case Thing::ball: {
            const double off = std::hypot(x - 110.0, y - 130.0) / kBallRadius;
            return 0.12 - 0.1 * std::sqrt(1.0 - off * off);
        }
        case Thing::plane:
            return 0.35 + 0.22 * x / (kSceneColumns - 1) + 0.2 * y / (kSceneRows - 1);
    }
    return 0.0;
}

std::uint8_t level_of(double part) {
    return cv::saturate_cast<std::uint8_t>(255.0 * part);
}

}  // namespace

cv::Mat scene_depth() {
    cv::Mat depth(kSceneRows, kSceneColumns, CV_32F);
    for (int j = 0; j < depth.rows; ++j)
        for (int i = 0; i < depth.cols; ++i)
            depth.at<float>(j, i) = static_cast<float>(depth_at(i, j));
    return depth;
}

cv::Mat painted(const cv::Mat& depth, const std::function<cv::Vec3b(float)>& level) {
    cv::Mat picture(depth.size(), CV_8UC3);
    for (int j = 0; j < depth.rows; ++j)
        for (int i = 0; i < depth.cols; ++i)
            picture.at<cv::Vec3b>(j, i) = level(depth.at<float>(j, i));
    return picture;
}

cv::Vec3b as_hue(float depth) {
    if (!std::isfinite(depth)) return {0, 0, 0};
    const auto channel = [depth](double from) {
        const double at = std::fmod(from + 6.0 * static_cast<double>(depth), 6.0);
        return level_of(1.0 - std::clamp(std::min(at, 4.0 - at), 0.0, 1.0));
    };
    return {channel(1.0), channel(3.0), channel(5.0)};
}

cv::Vec3b as_grey(float depth) {
    if (!std::isfinite(depth)) return {0, 0, 0};
    const std::uint8_t level = level_of(1.0 - static_cast<double>(depth));
    return {level, level, level};
}

cv::Vec3b as_ramp(float depth) {
    if (!std::isfinite(depth)) return {0, 0, 0};
    const double along = 3.0 * (1.0 - static_cast<double>(depth));
    return {level_of(along), level_of(along - 1.0), level_of(along - 2.0)};
}

namespace {

/// Channels of OpenCV's pictures for the bytes of a number, the lowest byte first.
std::vector<std::size_t> channels_of_bytes(DepthCode code) {
    switch (code) {
        case DepthCode::rg16:
            return {1, 2};
        case DepthCode::gb16:
            return {0, 1};
        case DepthCode::bgr24:
        case DepthCode::terrain:
            return {0, 1, 2};
        case DepthCode::float32:
            return {2, 1, 0, 3};
        case DepthCode::float32_bgra:
            return {0, 1, 2, 3};
        default:
            return {2, 1, 0};  // rgb24
    }
}

}  // namespace

cv::Mat in_bytes(const cv::Mat& numbers, DepthCode code) {
    const std::vector<std::size_t> channels = channels_of_bytes(code);
    const bool is_float = channels.size() == 4;
    cv::Mat picture(numbers.rows, numbers.cols, is_float ? CV_8UC4 : CV_8UC3, cv::Scalar::all(0.0));
    for (int j = 0; j < picture.rows; ++j) {
        for (int i = 0; i < picture.cols; ++i) {
            const float number = numbers.at<float>(j, i);
            if (!std::isfinite(number)) continue;
            const double real = static_cast<double>(number);
            const auto bits =
                is_float ? std::bit_cast<std::uint32_t>(number)
                         : static_cast<std::uint32_t>(std::lround(
                               code == DepthCode::terrain ? 10.0 * (real + 10000.0) : real));
            std::uint8_t* const bgra = picture.ptr<std::uint8_t>(j) + i * picture.channels();
            for (std::size_t k = 0; k < channels.size(); ++k)
                bgra[channels[k]] = static_cast<std::uint8_t>(bits >> (8U * k) & 0xffU);
        }
    }
    return picture;
}

cv::Mat rough(int columns, int rows, int seed) {
    cv::RNG random(static_cast<std::uint64_t>(seed));
    cv::Mat sum(rows, columns, CV_32F, cv::Scalar(128.0));
    for (const int size : {2, 8, 32}) {
        cv::Mat noise(rows / size + 2, columns / size + 2, CV_32F);
        random.fill(noise, cv::RNG::NORMAL, 0.0, 14.0);
        cv::resize(noise, noise, sum.size(), 0.0, 0.0, cv::INTER_CUBIC);
        sum += noise;
    }
    cv::Mat picture;
    sum.convertTo(picture, CV_8U);
    return picture;
}

cv::Mat below_confidence(const cv::Mat& millimetres) {
    cv::Mat levels = millimetres.clone();
    for (int j = 0; j < levels.rows; ++j)
        for (int i = 0; i < levels.cols; ++i) {
            auto& level = levels.at<std::uint16_t>(j, i);
            level = static_cast<std::uint16_t>(level | ((i / 9 + j / 7) % 8) << 13);
        }
    return levels;
}

cv::Mat scene_photo(double to_the_right) {
    static constexpr std::array<std::array<double, 3>, 4> kColours{
        {{0.5, 0.4, 0.3}, {0.9, 0.7, 0.5}, {0.3, 0.5, 1.3}, {0.5, 1.2, 0.6}}};
    const cv::Mat texture = rough(kSceneColumns, kSceneRows, 7);
    cv::Mat photo(kSceneRows, kSceneColumns, CV_8UC3);
    for (int j = 0; j < photo.rows; ++j) {
        for (int i = 0; i < photo.cols; ++i) {
            // Near things move more.
            const double near = thing_at(i, j) == Thing::ball ? 1.0 : 0.3;
            const double x = std::min(i + near * to_the_right, kSceneColumns - 1.0);
            const auto thing = static_cast<std::size_t>(thing_at(x, j));
            const double light = texture.at<std::uint8_t>(j, static_cast<int>(x));
            for (int c = 0; c < 3; ++c)
                photo.at<cv::Vec3b>(j, i)[c] = cv::saturate_cast<std::uint8_t>(
                    light * kColours[thing][static_cast<std::size_t>(c)]);
        }
    }
    return photo;
}

cv::Mat beside(const cv::Mat& left, const cv::Mat& right) {
    cv::Mat both;
    cv::hconcat(left, right, both);
    return both;
}

cv::Mat above(const cv::Mat& top, const cv::Mat& bottom) {
    cv::Mat both;
    cv::vconcat(top, bottom, both);
    return both;
}

}  // namespace dibhr::test
