// Remembers the last levels, and decides which of them fill holes.
#include "core/video/cleaning/holes/depth_memory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kMostly = 0.9;  ///< least share of a patch that has held levels

// Measured on sensors' recordings, by the next level of such pixels: with a similar level within
// 3 px the held level comes back more often; else the background comes 2 to 10 times as often.
constexpr int kLike_px = 3;
constexpr int kSideOfSquare_px = 4;  ///< the levels around are found by squares,
constexpr int kSquares = 2;          ///< this many to each side: 8 to 11 px

bool is_like(float a, float b, float outline) {
    return std::fabs(a - b) <= outline;
}

/// Whether data within kLike_px is on one surface with `level`.
bool has_similar_near(const DepthImage& image, int i, int j, float level, float outline) {
    const int left = std::max(i - kLike_px, 0);
    const int right = std::min(i + kLike_px, image.columns - 1);
    for (int y = std::max(j - kLike_px, 0); y <= std::min(j + kLike_px, image.rows - 1); ++y)
        for (int x = left; x <= right; ++x)
            if (is_like(image.at(x, y), level, outline)) return true;
    return false;
}

/// The lower of each two levels; NaN is ignored.
DIBHR_VECTOR_CLONES void lower(float* __restrict levels, const float* other, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) levels[i] = other[i] < levels[i] ? other[i] : levels[i];
}

DIBHR_VECTOR_CLONES void lowest_of_squares(const float* row, float* __restrict lowest,
                                           std::size_t squares) {
    static_assert(kSideOfSquare_px == 4);
    for (std::size_t i = 0; i < squares; ++i)
        lowest[i] = std::min(std::min(row[4 * i], row[4 * i + 1]),
                             std::min(row[4 * i + 2], row[4 * i + 3]));
}

int squares_in(int pixels) {
    return (pixels + kSideOfSquare_px - 1) / kSideOfSquare_px;
}

}  // namespace

std::vector<HeldLevel> DepthMemory::take(const DepthImage& depth, double media_s) {
    if (levels_.size() != depth.levels.size()) {
        levels_.assign(depth.levels.size(), 0.0F);
        seen_in_.clear();
        whole_in_ = 0;
    }
    while (!times_.empty() && !(media_s - times_.front() < kHold_s)) {
        times_.pop_front();
        ++oldest_;
    }
    const auto now = oldest_ + static_cast<std::uint32_t>(times_.size());
    times_.push_back(media_s);
    if (!has_holes(depth)) {
        levels_ = depth.levels;
        whole_in_ = now;
        return {};
    }
    const std::uint32_t whole_in = std::exchange(whole_in_, 0);
    if (whole_in != 0 || seen_in_.empty()) seen_in_.assign(depth.levels.size(), whole_in);
    std::vector<HeldLevel> held;
    for (std::size_t k = 0; k < depth.levels.size(); ++k) {
        if (const float level = depth.levels[k]; !std::isnan(level)) {
            levels_[k] = level;
            seen_in_[k] = now;
        } else if (seen_in_[k] >= oldest_) {
            held.push_back({static_cast<std::uint32_t>(k), levels_[k]});
        }
    }
    return held;
}

void DepthMemory::forget() noexcept {
    levels_.clear();  // of another size than the next image: take() resets the rest
    times_.clear();
    oldest_ = 1;
}

void HeldFiller::fill(DepthImage& image, std::span<const HeldLevel> held) {
    if (held.empty()) return;
    find_farthest(image);
    find_seen_patches(image, held);
    const float outline = outline_levels(image);
    used_.clear();
    for (std::size_t k = 0; k < held.size(); ++k) {
        const auto [index, level] = held[k];
        const auto i = static_cast<int>(index % static_cast<std::uint32_t>(image.columns));
        const auto j = static_cast<int>(index / static_cast<std::uint32_t>(image.columns));
        const float behind = farthest_[static_cast<std::size_t>(j / kSideOfSquare_px) *
                                           static_cast<std::size_t>(squares_in(image.columns)) +
                                       static_cast<std::size_t>(i / kSideOfSquare_px)];
        const bool holds = behind == kInfinity ? was_seen(k)
                                               : is_like(level, behind, outline) ||
                                                     has_similar_near(image, i, j, level, outline);
        // A level below all levels around would be a pit.
        if (holds) used_.push_back({index, behind == kInfinity ? level : std::max(level, behind)});
    }
    for (const HeldLevel& level : used_) image.levels[level.index] = level.level;
}

void HeldFiller::find_farthest(const DepthImage& image) {
    const int columns = squares_in(image.columns);
    const int rows = squares_in(image.rows);
    const auto width = static_cast<std::size_t>(columns);
    lowest_.resize(width * static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j) {
        in_row_.assign(width * kSideOfSquare_px, kInfinity);
        for (int y = j * kSideOfSquare_px; y < std::min((j + 1) * kSideOfSquare_px, image.rows);
             ++y)
            lower(in_row_.data(), image.levels.data() + image.index(0, y),
                  static_cast<std::size_t>(image.columns));
        lowest_of_squares(in_row_.data(), lowest_.data() + width * static_cast<std::size_t>(j),
                          width);
    }
    farthest_.resize(lowest_.size());
    cv::Mat farthest(rows, columns, CV_32F, farthest_.data());
    cv::erode(cv::Mat(rows, columns, CV_32F, lowest_.data()), farthest,
              cv::Mat::ones(2 * kSquares + 1, 2 * kSquares + 1, CV_8U), {-1, -1}, 1,
              cv::BORDER_REPLICATE);
}

void HeldFiller::find_seen_patches(const DepthImage& image, std::span<const HeldLevel> held) {
    patches_.find_holes(image);
    const std::vector<Patches::Run>& runs = patches_.runs();
    held_in_.assign(runs.size(), 0);
    patch_of_.clear();
    auto run = runs.begin();
    for (const HeldLevel& level : held) {
        while (image.index(run->end - 1, run->row) < level.index) ++run;
        patch_of_.push_back(run->patch);
        ++held_in_[static_cast<std::size_t>(run->patch)];
    }
}

bool HeldFiller::was_seen(std::size_t k) const {
    const std::int32_t patch = patch_of_[k];
    return static_cast<double>(held_in_[static_cast<std::size_t>(patch)]) >=
           kMostly * static_cast<double>(patches_.patch(patch).pixels);
}

}  // namespace dibhr
