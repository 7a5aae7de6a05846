// Counts pixels without data around those with data, and tiles of the picture that have any.
#include "core/video/cleaning/sparse_meter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/video/cleaning/patches.hpp"

namespace dibhr {

namespace {

constexpr double kLeastSeenShare = 0.001;
constexpr int kAround_px = 5;
constexpr double kLeastUnseenAround = 0.4;
constexpr double kLeastCovered = 0.4;
/// A tile's side, in mean spacings: evenly spread, 16 seen pixels are in each.
constexpr double kTileInSpacings = 4.0;
constexpr double kCoveredTile = 0.25;  ///< of the mean number of seen pixels

/// The share of tiles that are covered by seen pixels.
double covered_share(const std::vector<std::uint8_t>& unseen, const DepthImage& image,
                     double seen_share) {
    const int side = static_cast<int>(std::ceil(kTileInSpacings / std::sqrt(seen_share)));
    const int across = std::max(image.columns / side, 1);
    const int down = std::max(image.rows / side, 1);
    std::vector<int> tiles(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), 0);
    for (int j = 0; j < image.rows; ++j)
        for (int i = 0; i < image.columns; ++i) {
            if (unseen[image.index(i, j)] != 0) continue;
            const int tile = std::min(j / side, down - 1) * across + std::min(i / side, across - 1);
            ++tiles[static_cast<std::size_t>(tile)];
        }
    const double least = kCoveredTile * seen_share * side * side;
    const auto covered =
        std::count_if(tiles.begin(), tiles.end(), [least](int seen) { return seen >= least; });
    return static_cast<double>(covered) / static_cast<double>(tiles.size());
}

}  // namespace

void SparseMeter::add(const DepthImage& image) {
    if (std::min(image.columns, image.rows) < kLeastSide_px) return;
    std::vector<std::uint8_t> marks(image.levels.size());
    (void)mark_holes(image.levels.data(), marks.data(), marks.size());
    const auto pixels = static_cast<double>(marks.size());
    const double seen = pixels - static_cast<double>(std::count(marks.begin(), marks.end(), 1));
    if (seen < kLeastSeenShare * pixels) return;
    constexpr double kWhole = 255.0;
    const cv::Mat unseen = cv::Mat1b(image.rows, image.columns, marks.data()) * kWhole;
    cv::Mat1b around;
    cv::boxFilter(unseen, around, CV_8U, {kAround_px, kAround_px});
    const double mean = cv::mean(around, ~unseen)[0] / kWhole;
    pixels_ += pixels;
    seen_ += seen;
    unseen_around_ += seen * mean;
    covered_ += seen * covered_share(marks, image, seen / pixels);
}

std::optional<double> SparseMeter::sparse_share() const noexcept {
    const bool is_sparse = has_measured() && unseen_around_ >= kLeastUnseenAround * seen_ &&
                           covered_ >= kLeastCovered * seen_;
    return is_sparse ? std::optional(seen_ / pixels_) : std::nullopt;
}

}  // namespace dibhr
