// Compares sampled pixels with the colours of each map.
#include "core/video/depth/colour_maps.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace dibhr {

namespace {

using Colours = std::vector<cv::Vec3b>;

constexpr int kSamplesAlong = 48;  ///< pixels of a picture that are compared, in a row and a column

/// ColorBrewer's Spectral, from which matplotlib makes Spectral_r; BGR.
constexpr std::array<std::array<std::uint8_t, 3>, 11> kSpectral{{{0x42, 0x01, 0x9e},
                                                                 {0x4f, 0x3e, 0xd5},
                                                                 {0x43, 0x6d, 0xf4},
                                                                 {0x61, 0xae, 0xfd},
                                                                 {0x8b, 0xe0, 0xfe},
                                                                 {0xbf, 0xff, 0xff},
                                                                 {0x98, 0xf5, 0xe6},
                                                                 {0xa4, 0xdd, 0xab},
                                                                 {0xa5, 0xc2, 0x66},
                                                                 {0xbd, 0x88, 0x32},
                                                                 {0xa2, 0x4f, 0x5e}}};

std::vector<Colours> made_maps() {
    constexpr std::array kMaps{cv::COLORMAP_JET,     cv::COLORMAP_TURBO, cv::COLORMAP_VIRIDIS,
                               cv::COLORMAP_INFERNO, cv::COLORMAP_MAGMA, cv::COLORMAP_PLASMA,
                               cv::COLORMAP_HOT};
    cv::Mat ramp(1, 256, CV_8UC1);
    for (int k = 0; k < 256; ++k) ramp.at<std::uint8_t>(0, k) = static_cast<std::uint8_t>(k);
    std::vector<Colours> maps;
    for (const int map : kMaps) {
        cv::Mat painted;
        cv::applyColorMap(ramp, painted, map);
        maps.emplace_back(painted.begin<cv::Vec3b>(), painted.end<cv::Vec3b>());
    }
    cv::Mat spectral(1, static_cast<int>(kSpectral.size()), CV_8UC3);
    for (std::size_t k = 0; k < kSpectral.size(); ++k)
        spectral.at<cv::Vec3b>(0, static_cast<int>(k)) = cv::Vec3b(kSpectral[k].data());
    cv::Mat smooth;
    cv::resize(spectral, smooth, {256, 1}, 0.0, 0.0, cv::INTER_LINEAR);
    maps.emplace_back(smooth.begin<cv::Vec3b>(), smooth.end<cv::Vec3b>());
    return maps;
}

/// Pixels of a grid over the picture; no mean of neighbours, whose colours are on no map.
Colours samples_of(const cv::Mat& picture) {
    Colours samples;
    for (int j = 0; j < kSamplesAlong; ++j)
        for (int i = 0; i < kSamplesAlong; ++i)
            samples.push_back(
                picture.at<cv::Vec3b>((2 * j + 1) * picture.rows / (2 * kSamplesAlong),
                                      (2 * i + 1) * picture.cols / (2 * kSamplesAlong)));
    return samples;
}

int difference(const cv::Vec3b& a, const cv::Vec3b& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

bool is_on(const Colours& map, const cv::Vec3b& colour) {
    constexpr int kCompressed = 20;  // levels by which JPEG changes a colour
    return std::any_of(map.begin(), map.end(), [&](const cv::Vec3b& one) {
        return difference(one, colour) <= kCompressed;
    });
}

/// The colour map that has the most of the picture's colours; null: none has nearly all of them.
const Colours* colour_map_of(const cv::Mat& picture) {
    constexpr double kNearlyAllOfMap = 0.93;
    constexpr double kColoured = 0.5;
    constexpr int kGreyChroma = 24;
    constexpr int kLeastSpan = 60;  // of a channel: less is a plain picture of one colour
    if (picture.type() != CV_8UC3 || picture.empty()) return nullptr;
    static const std::vector<Colours> maps = made_maps();
    Colours samples = samples_of(picture);
    // Black is no data in most paintings.
    std::erase_if(samples, [](const cv::Vec3b& c) { return std::max({c[0], c[1], c[2]}) < 8; });
    const auto count = static_cast<double>(samples.size());
    if (count < 0.1 * kSamplesAlong * kSamplesAlong) return nullptr;
    const auto coloured = std::count_if(samples.begin(), samples.end(), [](const cv::Vec3b& c) {
        return std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}) >= kGreyChroma;
    });
    if (static_cast<double>(coloured) < kColoured * count) return nullptr;
    int span = 0;
    for (int channel = 0; channel < 3; ++channel) {
        const auto [low, high] = std::minmax_element(
            samples.begin(), samples.end(),
            [channel](const cv::Vec3b& a, const cv::Vec3b& b) { return a[channel] < b[channel]; });
        span = std::max(span, (*high)[channel] - (*low)[channel]);
    }
    if (span < kLeastSpan) return nullptr;
    const Colours* best = nullptr;
    double most = kNearlyAllOfMap * count;
    for (const Colours& map : maps) {
        const auto on_map = static_cast<double>(std::count_if(
            samples.begin(), samples.end(), [&](const cv::Vec3b& c) { return is_on(map, c); }));
        if (on_map < most) continue;
        best = &map;
        most = on_map;
    }
    return best;
}

}  // namespace

bool is_colour_mapped(const cv::Mat& picture) {
    return colour_map_of(picture) != nullptr;
}

bool has_map_of_rising_brightness(const cv::Mat& picture) {
    const Colours* const map = colour_map_of(picture);
    if (map == nullptr) return false;
    constexpr double kMostFall = 8.0;  // levels, by rounding: jet, turbo and Spectral fall by 100
    double highest = 0.0;
    return std::all_of(map->begin(), map->end(), [&highest](const cv::Vec3b& c) {
        const double brightness = 0.114 * c[0] + 0.587 * c[1] + 0.299 * c[2];
        highest = std::max(highest, brightness);
        return brightness >= highest - kMostFall;
    });
}

bool has_two_levels(const cv::Mat& picture) {
    if (picture.type() != CV_8UC3 || picture.empty()) return false;
    const Colours samples = samples_of(picture);
    const cv::Vec3b& first = samples.front();
    const auto second = std::find_if(samples.begin(), samples.end(),
                                     [&](const cv::Vec3b& c) { return c != first; });
    return second != samples.end() && std::all_of(second, samples.end(), [&](const cv::Vec3b& c) {
               return c == first || c == *second;
           });
}

}  // namespace dibhr
