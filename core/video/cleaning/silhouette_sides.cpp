// Counts sides by sums of columns; smooths pixels whose neighbours are weighed as vectors.
#include "core/video/cleaning/silhouette_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

using namespace side_of_pixel;

namespace {

constexpr int kSmooth_px = 2;    ///< faces are smoothed over this distance to all sides
constexpr int kTogether_px = 4;  ///< over this distance pixels of a ramp go together
constexpr int kBalanceSide_px = 2 * kTogether_px + 1;
constexpr float kAlike = 0.03F;  ///< of the highest level: largest difference on one face
constexpr std::size_t kColumnsTogether = 16;  ///< whose balances are summed together
static_assert(kReadBeyond >= kColumnsTogether);

/// A pixel and those around it. Rows are as wide as vectors.
struct Patch {
    static constexpr std::size_t kSide = 2 * kSmooth_px + 1, kColumns = 8, kSize = kSide * kColumns;
    static constexpr std::size_t kMiddle = kSmooth_px * kColumns + kSmooth_px;
    std::array<float, kSize> levels{};
    std::array<int, kSize> sides{};
};
struct Weighed {
    std::array<float, Patch::kSize> levels{}, weights{};
};

/// Sums of columns over `rows` rows, `stride` apart: 2 for each pixel with a side, -1 for each
/// undecided one. `count`: a multiple of kColumnsTogether.
DIBHR_VECTOR_CLONES void sum_balances(const std::uint8_t* sides, std::size_t stride, int rows,
                                      std::int16_t* __restrict sums, std::size_t count) {
    for (std::size_t begin = 0; begin < count; begin += kColumnsTogether) {
        std::array<std::int16_t, kColumnsTogether> together{};
        const std::uint8_t* at = sides + begin;
        for (int j = 0; j < rows; ++j, at += stride)
            for (std::size_t i = 0; i < kColumnsTogether; ++i) {
                const int balance = (at[i] > kUndecided ? 2 : 0) - (at[i] == kUndecided ? 1 : 0);
                together[i] = static_cast<std::int16_t>(together[i] + balance);
            }
        for (std::size_t i = 0; i < kColumnsTogether; ++i) sums[begin + i] = together[i];
    }
}

/// `all_sides`: of the image's pixels. Pixels beyond its border are kOutside.
void copy_around(const DepthImage& image, const std::uint8_t* all_sides, int column, int row,
                 Patch& patch) {
    const int left = column - kSmooth_px;
    const int top = row - kSmooth_px;
    constexpr int kColumns = static_cast<int>(Patch::kColumns);
    if (left >= 0 && top >= 0 && left + kColumns <= image.columns &&
        row + kSmooth_px < image.rows) {
        for (std::size_t y = 0; y < Patch::kSide; ++y) {
            const std::size_t from = image.index(left, top + static_cast<int>(y));
            std::memcpy(patch.levels.data() + y * Patch::kColumns, image.levels.data() + from,
                        sizeof(float) * Patch::kColumns);
            std::copy_n(all_sides + from, Patch::kColumns,
                        patch.sides.data() + y * Patch::kColumns);
        }
        return;
    }
    for (std::size_t y = 0; y < Patch::kSide; ++y)
        for (std::size_t x = 0; x < Patch::kSide; ++x) {
            const int i = left + static_cast<int>(x);
            const int j = top + static_cast<int>(y);
            const bool inside = i >= 0 && j >= 0 && i < image.columns && j < image.rows;
            const std::size_t k = y * Patch::kColumns + x;
            patch.levels[k] = inside ? image.at(i, j) : 0.0F;
            patch.sides[k] = inside ? int{all_sides[image.index(i, j)]} : int{kOutside};
        }
}

/// 1 for those on the side of the pixel in the middle, or on neither, with a level like its own.
DIBHR_VECTOR_CLONES void weigh_side(const Patch& patch, float alike, Weighed& __restrict weighed) {
    const float own_level = patch.levels[Patch::kMiddle];
    const int own_side = patch.sides[Patch::kMiddle];
    for (std::size_t k = 0; k < Patch::kSize; ++k) {
        const int is_on_side =
            (patch.sides[k] <= kUndecided ? 1 : 0) | (patch.sides[k] == own_side ? 1 : 0);
        const int is_alike = std::fabs(patch.levels[k] - own_level) <= alike ? 1 : 0;
        const auto weight = static_cast<float>(is_on_side & is_alike);
        weighed.levels[k] = weight * patch.levels[k];
        weighed.weights[k] = weight;
    }
}

}  // namespace

void SideBalances::find(const std::uint8_t* sides, const DepthImage& image, const Run& run) {
    const int left = std::max(run.begin - kTogether_px, 0);
    const int right = std::min(run.end + kTogether_px, image.columns);
    const auto count = static_cast<std::size_t>(right - left);
    in_column_.resize((count + kColumnsTogether - 1) / kColumnsTogether * kColumnsTogether);
    const int top = std::max(run.row - kTogether_px, 0);
    const int bottom = std::min(run.row + kTogether_px + 1, image.rows);
    sum_balances(sides + image.index(left, top), static_cast<std::size_t>(image.columns),
                 bottom - top, in_column_.data(), in_column_.size());
    const auto column = [&](int i) { return int{in_column_[static_cast<std::size_t>(i - left)]}; };
    begin_ = run.begin;
    balances_.clear();
    int balance = 0;
    for (int i = left; i < run.end + kTogether_px; ++i) {
        if (i < right) balance += column(i);
        if (i - kBalanceSide_px >= left) balance -= column(i - kBalanceSide_px);
        if (i - kTogether_px >= run.begin) balances_.push_back(balance);
    }
}

float mean_of_side(const DepthImage& image, const std::uint8_t* sides, std::size_t pixel) {
    const auto columns = static_cast<std::size_t>(image.columns);
    Patch patch;
    copy_around(image, sides, static_cast<int>(pixel % columns), static_cast<int>(pixel / columns),
                patch);
    Weighed weighed;
    weigh_side(patch, kAlike * static_cast<float>(image.highest_level), weighed);
    float sum = 0.0F;
    float count = 0.0F;
    for (std::size_t y = 0; y < Patch::kSide; ++y)
        for (std::size_t x = 0; x < Patch::kSide; ++x) {
            sum += weighed.levels[y * Patch::kColumns + x];
            count += weighed.weights[y * Patch::kColumns + x];
        }
    return sum / count;
}

}  // namespace dibhr
