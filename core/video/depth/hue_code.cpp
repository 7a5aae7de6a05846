// Computes hues, decides red, and decodes the ramp.
#include "core/video/depth/hue_code.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr float kBelowOne = 1.0F - std::numeric_limits<float>::epsilon();

/// Hues this near to 0 or 1 may have changed sides by noise of codecs.
constexpr float kRed = 0.06F;
/// Hues of a surface that continues into red are this near to it.
constexpr float kBesideRed = 0.25F;
/// A side is certain if it has this many times the neighbours of the other.
constexpr int kCertain = 4;

/// Blue, green and red from 0 to 1, without gaps between rows, of a picture of 3 or 4 channels.
cv::Mat as_real(const cv::Mat& picture) {
    cv::Mat colours = picture;
    if (picture.channels() == 4) cv::cvtColor(picture, colours, cv::COLOR_BGRA2BGR);
    const double highest = highest_level(colours.depth() == CV_16U ? 16 : 8);
    cv::Mat real;
    colours.convertTo(real, CV_32F, 1.0 / highest);
    return real;
}

/// Hue 0 to 360, saturation and value 0 to 1.
cv::Mat hue_saturation_value(const cv::Mat& picture) {
    cv::Mat colours = as_real(picture);
    cv::cvtColor(colours, colours, cv::COLOR_BGR2HSV);
    return colours;
}

/// Distance of a colour from grey; 1 for a pure hue.
float chroma_of(const cv::Vec3f& pixel) {
    return pixel[1] * pixel[2];
}

float hue_at(const cv::Vec3f& pixel, const HueCode& code) {
    if (pixel[1] < code.least_saturation || pixel[2] < code.least_value) return kNone;
    const float hue = std::min(pixel[0] / 360.0F, kBelowOne);
    return hue < code.nearest || hue > code.farthest ? kNone : hue;
}

/// The median chroma of every few pixels with data; 0 if there are none.
float usual_chroma(const cv::Mat& colours, const cv::Mat& hues) {
    constexpr int kEvery = 3;
    std::vector<float> chromas;
    for (int j = 0; j < hues.rows; j += kEvery) {
        for (int i = 0; i < hues.cols; i += kEvery) {
            if (std::isfinite(hues.at<float>(j, i)))
                chromas.push_back(chroma_of(colours.at<cv::Vec3f>(j, i)));
        }
    }
    if (chromas.empty()) return 0.0F;
    const auto middle = chromas.begin() + static_cast<std::ptrdiff_t>(chromas.size() / 2);
    std::nth_element(chromas.begin(), middle, chromas.end());
    return *middle;
}

/// Distance on the circle of hues, at most 0.5.
float hue_distance(float a, float b) {
    const float apart = std::abs(a - b);
    return std::min(apart, 1.0F - apart);
}

/// A mixture of two surfaces' hues is paler or darker than either, with any hue between. So a pale
/// or dark pixel without a pure one of its hue beside it loses its data. (A pixel mixed with black
/// has a pure one beside it.)
void drop_mixtures(const cv::Mat& colours, cv::Mat& hues) {
    constexpr float kPure = 0.8F;  // of the usual chroma
    constexpr float kSameSurface = 0.03F;
    constexpr int kReach = 1;  // chroma of every other pixel, smoothed by a decoder
    const float pure = kPure * usual_chroma(colours, hues);
    const cv::Mat given = hues.clone();
    const auto is_pure = [&](int j, int i) {
        return chroma_of(colours.at<cv::Vec3f>(j, i)) >= pure;
    };
    const auto belongs = [&](int j, int i) {
        for (int y = std::max(j - kReach, 0); y <= std::min(j + kReach, given.rows - 1); ++y) {
            for (int x = std::max(i - kReach, 0); x <= std::min(i + kReach, given.cols - 1); ++x) {
                const float apart = hue_distance(given.at<float>(y, x), given.at<float>(j, i));
                if (apart < kSameSurface && is_pure(y, x)) return true;
            }
        }
        return false;
    };
    for (int j = 0; j < hues.rows; ++j) {
        for (int i = 0; i < hues.cols; ++i) {
            if (std::isfinite(given.at<float>(j, i)) && !is_pure(j, i) && !belongs(j, i))
                hues.at<float>(j, i) = kNone;
        }
    }
}

/// Counts of near and far hues around one red area.
struct Rim {
    int near{0};
    int far{0};

    [[nodiscard]] int side() const {  // -1: the nearest, 1: the farthest, 0: not known
        if (near > kCertain * far) return -1;
        return far > kCertain * near ? 1 : 0;
    }
};

/// Calls `visit` with the hue of each of the 8 neighbours.
template <typename Visit>
void visit_neighbours(const cv::Mat& hues, int j, int i, const Visit& visit) {
    for (int y = std::max(j - 1, 0); y <= std::min(j + 1, hues.rows - 1); ++y) {
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, hues.cols - 1); ++x)
            visit(hues.at<float>(y, x));
    }
}

/// The rims of connected areas; `labels`: 0 outside of them.
std::vector<Rim> rims_of(const cv::Mat& hues, const cv::Mat& labels, int areas) {
    std::vector<Rim> rims(static_cast<std::size_t>(areas));
    for (int j = 0; j < hues.rows; ++j) {
        for (int i = 0; i < hues.cols; ++i) {
            const int label = labels.at<int>(j, i);
            if (label == 0) continue;
            Rim& rim = rims[static_cast<std::size_t>(label)];
            visit_neighbours(hues, j, i, [&rim](float hue) {
                rim.near += static_cast<int>(hue >= kRed && hue < kBesideRed);
                rim.far += static_cast<int>(hue > 1.0F - kBesideRed && hue <= 1.0F - kRed);
            });
        }
    }
    return rims;
}

/// Moves the areas of `mask` to the side that their rim shows, if it does.
void assign_area_sides(cv::Mat& hues, const cv::Mat& mask) {
    cv::Mat labels;
    const int areas = cv::connectedComponents(mask, labels, 8, CV_32S);
    const std::vector<Rim> rims = rims_of(hues, labels, areas);
    for (int j = 0; j < hues.rows; ++j) {
        for (int i = 0; i < hues.cols; ++i) {
            const int label = labels.at<int>(j, i);
            if (label == 0) continue;
            float& hue = hues.at<float>(j, i);
            const int side = rims[static_cast<std::size_t>(label)].side();
            if (side < 0 && hue > 0.5F) hue = 0.0F;
            if (side > 0 && hue < 0.5F) hue = kBelowOne;
        }
    }
}

constexpr double kLeastColoured = 0.02;  ///< least share of coloured pixels

bool has_colour(const cv::Vec3f& bgr) {
    return std::max({bgr[0], bgr[1], bgr[2]}) - std::min({bgr[0], bgr[1], bgr[2]}) > 0.15F;
}

float mean_of(const cv::Vec3f& bgr) {
    return (bgr[0] + bgr[1] + bgr[2]) / 3.0F;
}

/// On the ramp from black: blue rises first, then green, then red.
bool is_on_ramp(const cv::Vec3f& bgr) {
    constexpr float kBeside = 0.15F;  // codecs mix colours of neighbours
    const float along = 3.0F * mean_of(bgr);
    for (int channel = 0; channel < 3; ++channel) {
        const float there = std::clamp(along - static_cast<float>(channel), 0.0F, 1.0F);
        if (std::abs(bgr[channel] - there) > kBeside) return false;
    }
    return true;
}

}  // namespace

HueCode record3d_code(std::optional<DepthRange> metres) {
    constexpr DepthRange kDefaultRange_m{0.0, 3.0};
    HueCode code;
    code.metres = metres.value_or(kDefaultRange_m);
    code.nearest = 0.1 / 3.0;
    code.farthest = 2.8 / 3.0;
    code.red_is_data = false;
    return code;
}

cv::Mat hues_of(const cv::Mat& picture, const HueCode& code) {
    cv::Mat hues(picture.rows, picture.cols, CV_32F, cv::Scalar(kNone));
    if (picture.channels() < 3) return hues;
    const cv::Mat colours = hue_saturation_value(picture);
    const auto* const pixels = colours.ptr<cv::Vec3f>();
    std::transform(pixels, pixels + colours.total(), hues.ptr<float>(),
                   [&code](const cv::Vec3f& pixel) { return hue_at(pixel, code); });
    if (code.red_is_data) assign_red_side(hues);
    drop_mixtures(colours, hues);
    return hues;
}

void assign_red_side(cv::Mat& hues) {
    const cv::Mat low = hues < kRed;
    const cv::Mat high = hues > 1.0F - kRed;
    if (cv::countNonZero(high) > 0) assign_area_sides(hues, low | high);
}

/// Black, also where codecs made it a little brighter, is 0.
cv::Mat ramp_levels(const cv::Mat& picture) {
    constexpr float kBlack = 0.06F;
    cv::Mat levels(picture.rows, picture.cols, CV_32F, cv::Scalar(0.0));
    if (picture.channels() < 3) return levels;
    const cv::Mat colours = as_real(picture);
    const auto* const pixels = colours.ptr<cv::Vec3f>();
    std::transform(pixels, pixels + colours.total(), levels.ptr<float>(), [](const cv::Vec3f& bgr) {
        return std::max({bgr[0], bgr[1], bgr[2]}) < kBlack ? 0.0F : 255.0F * mean_of(bgr);
    });
    return levels;
}

double share_on_ramp(const cv::Mat& picture) {
    if (picture.channels() < 3 || picture.empty()) return 0.0;
    const cv::Mat colours = as_real(picture);
    std::size_t coloured = 0;
    std::size_t on_ramp = 0;
    for (const cv::Vec3f& pixel : cv::Mat_<cv::Vec3f>(colours)) {
        if (!has_colour(pixel)) continue;
        ++coloured;
        on_ramp += static_cast<std::size_t>(is_on_ramp(pixel));
    }
    if (static_cast<double>(coloured) < kLeastColoured * static_cast<double>(colours.total()))
        return 0.0;
    return static_cast<double>(on_ramp) / static_cast<double>(coloured);
}

}  // namespace dibhr
