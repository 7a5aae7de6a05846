// Computes statistics of pictures, and compares them with bounds. The bounds lie between real depth
// recordings and other pictures: photographs, also grey ones, drawings, text, test pictures.
#include "core/video/sources/picture_kind.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/video/depth/byte_code.hpp"
#include "core/video/depth/colour_maps.hpp"
#include "core/video/depth/hue_code.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/depth/shared_texture.hpp"
#include "core/video/sources/packed.hpp"

namespace dibhr {

namespace {

constexpr int kLongSide = 320;  ///< of the reduced pictures [px]
constexpr std::size_t kMostKindSamples = 24;

// Bounds for single pixels, in levels of 255.
constexpr int kDark = 40;        ///< the highest channel is below
constexpr int kGrey = 16;        ///< channels differ by less
constexpr int kFullLight = 225;  ///< of a pure hue the highest channel is at least
constexpr int kNoLight = 40;     ///< and the lowest at most
constexpr float kFlat = 0.15F;   ///< levels a pixel
constexpr float kSlope = 4.0F;
constexpr float kEdge = 8.0F;

constexpr double kMostlyPure = 0.5;  ///< share from which on hues are analysed

cv::Mat reduced(const cv::Mat& picture, int long_side, int how) {
    const double scale = static_cast<double>(long_side) / std::max(picture.cols, picture.rows);
    if (scale >= 1.0) return picture;
    const cv::Size size(std::max(1, static_cast<int>(std::lround(picture.cols * scale))),
                        std::max(1, static_cast<int>(std::lround(picture.rows * scale))));
    cv::Mat small;
    cv::resize(picture, small, size, 0.0, 0.0, how);
    return small;
}

double share(int count, double of) {
    return of > 0.0 ? count / of : 0.0;
}

/// The range between percentiles 2 and 98 of the levels in the mask.
double range_of(const cv::Mat& levels, const cv::Mat& mask) {
    std::array<int, 256> counts{};
    int total = 0;
    for (int j = 0; j < levels.rows; ++j) {
        for (int i = 0; i < levels.cols; ++i) {
            if (mask.at<std::uint8_t>(j, i) == 0) continue;
            ++counts[levels.at<std::uint8_t>(j, i)];
            ++total;
        }
    }
    const auto percentile = [&](double part) {
        int level = 0;
        for (int below = counts[0]; level < 255 && below <= part * total;)
            below += counts[static_cast<std::size_t>(++level)];
        return level;
    };
    return total == 0 ? 0.0 : percentile(0.98) - percentile(0.02);
}

/// Statistics of 8-bit levels where the mask is not 0.
SurfaceStatistics surface_statistics(const cv::Mat& levels, const cv::Mat& mask) {
    SurfaceStatistics statistics;
    statistics.covered = share(cv::countNonZero(mask), static_cast<double>(mask.total()));
    statistics.range = range_of(levels, mask);
    cv::Mat inner;  // pixels whose neighbours have levels, too
    cv::erode(mask, inner, cv::Mat::ones(5, 5, CV_8U));
    const int count = cv::countNonZero(inner);
    if (count == 0 || statistics.range < 1.0) return statistics;
    cv::Mat around;
    cv::medianBlur(levels, around, 5);
    cv::Mat apart;
    cv::absdiff(levels, around, apart);
    const cv::Mat rise = rise_of(around);
    const cv::Mat edges = (rise >= kEdge) & inner;
    const cv::Mat slopes = (rise >= kFlat) & (rise < kSlope) & inner;
    statistics.edges = share(cv::countNonZero(edges), count);
    statistics.slopes = share(cv::countNonZero(slopes), count);
    statistics.texture = cv::mean(apart, inner & ~edges)[0] / statistics.range;
    return statistics;
}

SurfaceStatistics brightness_statistics(const cv::Mat& small) {
    cv::Mat grey;
    cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
    return surface_statistics(grey, cv::Mat(grey.size(), CV_8U, cv::Scalar(255)));
}

/// Resizes by the nearest pixel: hues are never mixed.
SurfaceStatistics hue_statistics(const cv::Mat& picture) {
    const cv::Mat hues = hues_of(reduced(picture, kLongSide, cv::INTER_NEAREST), HueCode{});
    const cv::Mat mask = hues == hues;  // not NaN
    cv::Mat levels;
    hues.convertTo(levels, CV_8U, 255.0);
    levels.setTo(0, ~mask);
    return surface_statistics(levels, mask);
}

/// Adds the weighted statistics of one picture to a mean.
void add(SurfaceStatistics& sum, const SurfaceStatistics& one, double weight) {
    sum.covered += weight * one.covered;
    sum.range += weight * one.range;
    sum.texture += weight * one.texture;
    sum.slopes += weight * one.slopes;
    sum.edges += weight * one.edges;
}

void add(PictureStatistics& sum, const PictureStatistics& one, double weight) {
    sum.lit += weight * one.lit;
    sum.coloured += weight * one.coloured;
    sum.pure += weight * one.pure;
    sum.ramp += weight * one.ramp;
    add(sum.brightness, one.brightness, weight);
    add(sum.hue, one.hue, weight);
}

// Comparison with the bounds.

/// Least slopes and edges, and most texture, of depth.
struct SurfaceBounds {
    double slopes;
    double edges;
    double texture;
};

// Real depth: slopes 0.25 to 0.39 of brightness and 0.86 of hue, texture 0.0016 to 0.0025 (beside
// its colour picture to 0.005). Soft grey photographs have texture from 0.0036 on, test pictures
// hue slopes to 0.17. Mixed hues at silhouettes are no data, so few edges are left of them.
constexpr SurfaceBounds kGreyDepth{0.18, 0.008, 0.003};
constexpr SurfaceBounds kHueDepth{0.35, 0.003, 0.006};
constexpr SurfaceBounds kGreyHalf{0.18, 0.008, 0.008};

/// Whether it has enough relief and is smooth.
bool is_surface(const SurfaceStatistics& statistics, const SurfaceBounds& bounds) {
    constexpr double kLeastRange = 40.0;
    constexpr double kMostEdges = 0.2;
    return statistics.range >= kLeastRange && statistics.edges >= bounds.edges &&
           statistics.edges <= kMostEdges && statistics.slopes >= bounds.slopes &&
           statistics.texture <= bounds.texture;
}

bool looks_grey_depth(const PictureStatistics& statistics, const SurfaceBounds& bounds) {
    return statistics.coloured <= 0.01 && is_surface(statistics.brightness, bounds);
}

bool looks_hue_depth(const PictureStatistics& statistics) {
    return statistics.pure >= 0.8 && statistics.hue.covered >= 0.05 &&
           is_surface(statistics.hue, kHueDepth);
}

/// Whether pictures whose hues look like depth are painted in the colours of a map, as jet, which
/// is pale in its middle and dark at its ends: there hues are not linear.
bool is_painted(std::span<const cv::Mat> pictures, const PictureStatistics& statistics) {
    constexpr double kLeastPure = 0.96;  // of hue codes, but for compression
    return statistics.pure < kLeastPure &&
           std::all_of(pictures.begin(), pictures.end(), is_colour_mapped);
}

bool looks_ramp_depth(const PictureStatistics& statistics) {
    return statistics.ramp >= 0.9 && statistics.coloured >= 0.2 &&
           is_surface(statistics.brightness, kGreyDepth);
}

// Halves.

/// How much the channels change at each place, at low resolution.
cv::Mat edges_of(const cv::Mat& half) {
    const cv::Mat small = reduced(half, kLongSide / 2, cv::INTER_AREA);
    cv::Mat strongest(small.size(), CV_32F, cv::Scalar(0.0));
    std::vector<cv::Mat> channels;
    cv::split(small, channels);
    for (const cv::Mat& channel : channels) {
        cv::Mat across;
        cv::Mat down;
        cv::Sobel(channel, across, CV_32F, 1, 0);
        cv::Sobel(channel, down, CV_32F, 0, 1);
        cv::Mat rise;
        cv::magnitude(across, down, rise);
        strongest = cv::max(strongest, rise);
    }
    cv::GaussianBlur(strongest, strongest, {}, 1.5);
    return strongest;
}

/// Of two pictures of the same size, -1 to 1; 0 for a uniform one.
double correlation(const cv::Mat& a, const cv::Mat& b) {
    cv::Mat result;
    cv::matchTemplate(a, b, result, cv::TM_CCOEFF_NORMED);
    const double value = static_cast<double>(result.at<float>(0, 0));
    return std::isfinite(value) ? value : 0.0;
}

/// Brightness without details.
cv::Mat soft(const cv::Mat& half) {
    cv::Mat grey;
    cv::cvtColor(reduced(half, kLongSide / 4, cv::INTER_AREA), grey, cv::COLOR_BGR2GRAY);
    return grey;
}

/// The picture moved to the right and down, with wrap-around.
cv::Mat rolled(const cv::Mat& picture, double right, double down) {
    const int x = static_cast<int>(picture.cols * right);
    const int y = static_cast<int>(picture.rows * down);
    cv::Mat twice;
    cv::repeat(picture, 2, 2, twice);
    return twice(cv::Rect(x, y, picture.cols, picture.rows)).clone();
}

/// The highest correlation of pictures that do not belong together: one moved or mirrored.
double correlation_by_chance(const cv::Mat& a, const cv::Mat& b) {
    cv::Mat mirrored;
    cv::flip(b, mirrored, 1);
    double highest = correlation(a, mirrored);
    for (const double part : {0.25, 0.5, 0.75}) {
        highest = std::max(highest, correlation(a, rolled(b, part, 0.0)));
        highest = std::max(highest, correlation(a, rolled(b, 0.0, part)));
    }
    return highest;
}

/// Mean statistics of each picture's depth half; without a packing, of whole pictures.
PictureStatistics mean_statistics(std::span<const cv::Mat> pictures,
                                  std::optional<DepthPacking> packing = {}, int gap_px = 0) {
    PictureStatistics mean;
    for (const cv::Mat& picture : pictures) {
        const cv::Rect whole({}, picture.size());
        const cv::Rect part =
            packing ? half_of(picture.size(), *packing, PictureRole::depth, gap_px) : whole;
        add(mean, picture_statistics(picture(part)), 1.0 / static_cast<double>(pictures.size()));
    }
    return mean;
}

/// Measures how much the halves show the same scene.
void compare_halves(std::span<const cv::Mat> pictures, PictureGuess& halves) {
    const double weight = 1.0 / static_cast<double>(pictures.size());
    for (const cv::Mat& picture : pictures) {
        const cv::Size size = picture.size();
        const cv::Mat colour =
            picture(half_of(size, halves.packing, PictureRole::colour, halves.gap_px));
        const cv::Mat depth =
            picture(half_of(size, halves.packing, PictureRole::depth, halves.gap_px));
        const cv::Mat colour_edges = edges_of(colour);
        const cv::Mat depth_edges = edges_of(depth);
        halves.brightness_alike += weight * std::abs(correlation(soft(colour), soft(depth)));
        halves.edges_agree += weight * correlation(colour_edges, depth_edges);
        halves.edges_by_chance += weight * correlation_by_chance(colour_edges, depth_edges);
    }
}

/// Whether one half looks like depth, whose code it stores, and the other like a photograph.
bool could_be_packed(PictureGuess& halves) {
    constexpr double kRougher = 2.5;
    const PictureStatistics& colour = halves.colour_half;
    const PictureStatistics& depth = halves.depth_half;
    if (looks_hue_depth(depth)) {
        halves.code = DepthCode::hue;
        return colour.lit >= 0.02 && colour.pure <= 0.3;
    }
    return looks_grey_depth(depth, kGreyHalf) && colour.coloured >= 0.05 &&
           colour.brightness.texture >= kRougher * depth.brightness.texture;
}

bool belong_together(const PictureGuess& halves) {
    constexpr double kLeastAgreement = 0.2;
    constexpr double kMoreThanChance = 0.05;
    constexpr double kMostAlike = 0.9;  // else the grey half is a copy of the coloured one
    return halves.edges_agree >= kLeastAgreement &&
           halves.edges_agree - halves.edges_by_chance >= kMoreThanChance &&
           (halves.code == DepthCode::hue || halves.brightness_alike <= kMostAlike);
}

/// Whether all pixels of a line are white, but for what compression changes.
bool is_white(const cv::Mat& line) {
    constexpr int kWhite = 200;
    double darkest = 0.0;
    cv::minMaxLoc(line.reshape(1), &darkest, nullptr);
    return darkest >= kWhite;
}

/// The gap of pictures of one size that all have it.
int gap_in_all(std::span<const cv::Mat> pictures, DepthPacking packing) {
    const int gap_px = gap_between_halves(pictures.front(), packing);
    const bool all = std::all_of(pictures.begin(), pictures.end(), [&](const cv::Mat& picture) {
        return picture.size() == pictures.front().size() &&
               gap_between_halves(picture, packing) >= gap_px;
    });
    return all ? gap_px : 0;
}

/// The packing whose halves agree most; photographs where no packing is possible.
PictureGuess guess_packing(std::span<const cv::Mat> pictures) {
    // Each packing stands beside the one with exchanged halves: index ^ 1.
    static constexpr std::array kPackings{DepthPacking::left_right, DepthPacking::right_left,
                                          DepthPacking::top_bottom, DepthPacking::bottom_top};
    std::array<PictureStatistics, kPackings.size()> depth_statistics;
    std::array<int, kPackings.size()> gaps_px{};
    for (std::size_t k = 0; k < kPackings.size(); ++k) {
        gaps_px[k] = gap_in_all(pictures, kPackings[k]);
        depth_statistics[k] = mean_statistics(pictures, kPackings[k], gaps_px[k]);
    }
    PictureGuess best;
    for (std::size_t k = 0; k < kPackings.size(); ++k) {
        PictureGuess halves;
        halves.packing = kPackings[k];
        halves.gap_px = gaps_px[k];
        halves.depth_half = depth_statistics[k];
        halves.colour_half = depth_statistics[k ^ 1U];
        if (!could_be_packed(halves)) continue;
        compare_halves(pictures, halves);
        if (!belong_together(halves) || halves.edges_agree < best.edges_agree) continue;
        best = halves;
        best.kind = PictureKind::packed;
    }
    return best;
}

bool is_large_enough(const cv::Mat& picture) {
    constexpr int kLeast = 16;  // a half of it shows something
    return picture.type() == CV_8UC3 && std::min(picture.cols, picture.rows) >= kLeast;
}

}  // namespace

int gap_between_halves(const cv::Mat& picture, DepthPacking packing) {
    constexpr int kLeast_px = 4;
    const bool beside = packing == DepthPacking::left_right || packing == DepthPacking::right_left;
    const int side = beside ? picture.cols : picture.rows;
    const auto line = [&](int at) { return (beside ? picture.col(at) : picture.row(at)).clone(); };
    // Lines at both sides of the middle; a middle line of its own counts once.
    int pairs = 0;
    while (pairs < side / 8 && is_white(line((side - 1) / 2 - pairs)) &&
           is_white(line(side / 2 + pairs)))
        ++pairs;
    const int gap_px = 2 * pairs - (pairs > 0 ? side % 2 : 0);
    const bool has_margins = gap_px > 0 && (is_white(line(0)) || is_white(line(side - 1)));
    return gap_px >= kLeast_px && pairs < side / 8 && !has_margins ? gap_px : 0;
}

bool has_painted_half(const cv::Mat& picture) {
    if (!is_large_enough(picture)) return false;
    for (const DepthPacking packing : {DepthPacking::left_right, DepthPacking::top_bottom}) {
        const int gap_px = gap_between_halves(picture, packing);
        if (gap_px == 0) continue;
        for (const PictureRole role : {PictureRole::colour, PictureRole::depth}) {
            if (is_colour_mapped(picture(half_of(picture.size(), packing, role, gap_px))))
                return true;
        }
    }
    return false;
}

PictureStatistics picture_statistics(const cv::Mat& picture) {
    const cv::Mat small = reduced(picture, kLongSide, cv::INTER_AREA);
    int lit = 0;
    int coloured = 0;
    int pure = 0;
    for (int j = 0; j < small.rows; ++j) {
        for (int i = 0; i < small.cols; ++i) {
            const auto& bgr = small.at<cv::Vec3b>(j, i);
            const int highest = std::max({bgr[0], bgr[1], bgr[2]});
            const int chroma = highest - std::min({bgr[0], bgr[1], bgr[2]});
            if (highest < kDark) continue;
            ++lit;
            coloured += static_cast<int>(chroma >= kGrey);
            pure += static_cast<int>(highest >= kFullLight && highest - chroma <= kNoLight);
        }
    }
    PictureStatistics statistics;
    statistics.lit = share(lit, static_cast<double>(small.total()));
    statistics.coloured = share(coloured, lit);
    statistics.pure = share(pure, lit);
    statistics.ramp = share_on_ramp(small);
    statistics.brightness = brightness_statistics(small);
    if (statistics.pure >= kMostlyPure) statistics.hue = hue_statistics(picture);
    return statistics;
}

bool is_coloured(const cv::Mat& picture) {
    constexpr double kMostColoured = 0.01;  // share of pixels that compression colours
    return picture_statistics(picture).coloured > kMostColoured;
}

bool may_be_grey_depth(const cv::Mat& picture) {
    return is_large_enough(picture) && looks_grey_depth(picture_statistics(picture), kGreyDepth);
}

bool is_photo_of_scene(const cv::Mat& colour, const cv::Mat& grey) {
    constexpr double kLeastInside = 0.35;
    constexpr double kLeastInAll = 0.8;
    if (!is_large_enough(colour) || !is_large_enough(grey)) return false;
    // The painting of a depth has the noise of the depth.
    if (is_colour_mapped(colour)) return false;
    if (picture_statistics(grey).brightness.texture <= kGreyDepth.texture) return false;
    cv::Mat luma;
    cv::Mat levels;
    cv::cvtColor(colour, luma, cv::COLOR_BGR2GRAY);
    cv::cvtColor(grey, levels, cv::COLOR_BGR2GRAY);
    const SharedTexture shared = shared_texture(luma, levels);
    return shared.inside >= kLeastInside || shared.all >= kLeastInAll;
}

bool looks_like_photo(const cv::Mat& picture) {
    // Depth: texture to 0.01 with the noise of a sensor, edges to 0.1. Photographs: mostly from
    // 0.012 and 0.17 on.
    constexpr double kLeastTexture = 0.012;
    constexpr double kLeastEdges = 0.12;
    constexpr int kLeast_px = 64;
    if (picture.type() != CV_8UC3 || std::min(picture.cols, picture.rows) < kLeast_px) return false;
    const SurfaceStatistics brightness = picture_statistics(picture).brightness;
    return brightness.texture >= kLeastTexture && brightness.edges >= kLeastEdges;
}

bool is_black_and_white(const cv::Mat& picture) {
    if (picture.empty() || (picture.depth() != CV_8U && picture.depth() != CV_16U)) return false;
    constexpr int kRowsApart = 32;  // of those that show of most pictures that they are not
    const cv::Mat levels = grey_of(picture);
    const cv::Mat some((levels.rows + kRowsApart - 1) / kRowsApart, levels.cols, levels.type(),
                       levels.data, kRowsApart * levels.step);
    const auto has_ends_alone = [](const cv::Mat& of, bool both) {
        const int black = cv::countNonZero(of == 0.0);
        const int white = cv::countNonZero(of == highest_level(of.depth() == CV_8U ? 8 : 16));
        return black + white == static_cast<int>(of.total()) && (!both || (black > 0 && white > 0));
    };
    return has_ends_alone(some, false) && has_ends_alone(levels, true);
}

PictureGuess guess_kind(std::span<const cv::Mat> pictures) {
    pictures = pictures.first(std::min(pictures.size(), kMostKindSamples));
    if (pictures.empty() || !std::all_of(pictures.begin(), pictures.end(), is_large_enough))
        return {};
    PictureGuess guess = guess_packing(pictures);
    guess.whole = mean_statistics(pictures);
    if (guess.kind == PictureKind::packed) return guess;
    if (looks_grey_depth(guess.whole, kGreyDepth)) guess.kind = PictureKind::grey_depth;
    if (looks_hue_depth(guess.whole) && !is_painted(pictures, guess.whole))
        guess.kind = PictureKind::hue_depth;
    // Last, because blue hues are on the ramp, too.
    if (looks_ramp_depth(guess.whole)) guess.kind = PictureKind::ramp_depth;
    if (const auto code = byte_code_in(pictures)) {
        guess.kind = PictureKind::byte_depth;
        guess.code = *code;
    }
    return guess;
}

}  // namespace dibhr
