// Decides the side of each pixel beside a step by those around it, then takes single teeth.
#include "core/video/cleaning/outlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// An outline is a step of more than this part of the range.
constexpr float kStepOfOutline = 0.05F;
constexpr int kSideReach_px = 2;  ///< of the pixels that decide a side
constexpr int kSide_px = 2 * kSideReach_px + 1;
/// By their distance along rows and columns the 5 x 5 pixels around weigh this, as a Gaussian of
/// 1.2 px.
constexpr float kOneAway = 0.70664828F, kTwoAway = 0.24935221F;
constexpr std::array<float, kSide_px> kWeights{kTwoAway, kOneAway, 1.0F, kOneAway, kTwoAway};
/// The largest step beside a pixel, over the range of the 5 x 5 around: below it, there is a ramp.
constexpr float kTwoSides = 0.4F;
constexpr float kOnSide = 0.5F;  ///< nearer to the middle a pixel is on neither side

constexpr int kSpur_px = 2;          ///< a line one pixel wide loses this at its ends
constexpr int kCheckedAtOnce = 320;  ///< pixels of a row that are checked together
constexpr int kMostPasses = 64;      ///< over the teeth that are left

float step_of(const DepthImage& image) {
    return kStepOfOutline * static_cast<float>(image.highest_level);
}

/// A row of pixels and its neighbours.
struct Rows {
    const float* above;
    const float* row;
    const float* below;
};

Rows rows_at(const DepthImage& image, int row) {
    const float* const begin = image.levels.data() + image.index(0, row);
    return {begin - image.columns, begin, begin + image.columns};
}

/// Sets a mark to 1 where a pixel and its four neighbours differ by more than `step`, else 0.
DIBHR_VECTOR_CLONES void mark_steps(const Rows& rows, float step, int begin, int end,
                                    std::uint8_t* __restrict marks) {
    const float* const above = rows.above;
    const float* const row = rows.row;
    const float* const below = rows.below;
    for (int i = begin; i < end; ++i) {
        const float low = std::min(std::min(std::min(row[i - 1], row[i + 1]), row[i]),
                                   std::min(above[i], below[i]));
        const float high = std::max(std::max(std::max(row[i - 1], row[i + 1]), row[i]),
                                    std::max(above[i], below[i]));
        marks[i] = static_cast<std::uint8_t>(high - low > step ? 1 : 0);
    }
}

/// More than 0: a pixel is a tooth. The differences are those to its four neighbours.
inline float tooth(float up, float down, float left, float right, float step) {
    // In numbers of 0 and 1, which the compiler vectorises.
    const auto if_so = [](bool so) { return so ? 1.0F : 0.0F; };
    const auto are_across = [&](float one, float other) {
        return if_so(one > step) * if_so(other > step) + if_so(one < -step) * if_so(other < -step);
    };
    // It hangs together with one side only: a line one pixel wide is none.
    const auto is_one_alike = [&](float one, float other) {
        return std::fabs(if_so(std::fabs(one) <= step) - if_so(std::fabs(other) <= step));
    };
    return are_across(up, down) * is_one_alike(left, right) +
           are_across(left, right) * is_one_alike(up, down);
}

/// 1: the pixel is beyond two opposite neighbours by more than `step`, as a tooth is; else 0. The
/// differences are those to its four neighbours. One without data (NaN) may count as beyond.
inline int may_be_tooth(float up, float down, float left, float right, float step) {
    return static_cast<int>(std::min(up, down) > step) |
           static_cast<int>(std::max(up, down) < -step) |
           static_cast<int>(std::min(left, right) > step) |
           static_cast<int>(std::max(left, right) < -step);
}

/// Whether any pixel may be a tooth.
DIBHR_VECTOR_CLONES bool may_have_teeth(const Rows& rows, float step, int begin, int end) {
    const float* const above = rows.above;
    const float* const row = rows.row;
    const float* const below = rows.below;
    int found = 0;
    for (int i = begin; i < end; ++i) {
        const float up = row[i] - above[i];
        const float down = row[i] - below[i];
        const float left = row[i] - row[i - 1];
        const float right = row[i] - row[i + 1];
        found |= may_be_tooth(up, down, left, right, step);
    }
    return found != 0;
}

/// Sets a mark to 1 where a pixel is a tooth, else 0.
DIBHR_VECTOR_CLONES void mark_each_tooth(const Rows& rows, float step, int begin, int end,
                                         std::uint8_t* __restrict marks) {
    const float* const above = rows.above;
    const float* const row = rows.row;
    const float* const below = rows.below;
    for (int i = begin; i < end; ++i) {
        const float teeth = tooth(row[i] - above[i], row[i] - below[i], row[i] - row[i - 1],
                                  row[i] - row[i + 1], step);
        marks[i] = static_cast<std::uint8_t>(teeth > 0.0F ? 1 : 0);
    }
}

/// The same, quicker: teeth are few.
void mark_teeth(const Rows& rows, float step, int begin, int end, std::uint8_t* marks) {
    if (may_have_teeth(rows, step, begin, end))
        mark_each_tooth(rows, step, begin, end, marks);
    else
        std::fill(marks + begin, marks + end, std::uint8_t{0});
}

/// As the functions above.
using Mark = void (*)(const Rows& rows, float step, int begin, int end, std::uint8_t* marks);

/// visit(pixel) for each pixel that `mark` marks, in order, but those on the border.
template <typename Visit>
void each_marked(const DepthImage& image, Mark mark, float step, const Visit& visit) {
    std::array<std::uint8_t, kCheckedAtOnce> marks{};
    for (int j = 1; j + 1 < image.rows; ++j) {
        const Rows rows = rows_at(image, j);
        for (int begin = 1; begin < image.columns - 1; begin += kCheckedAtOnce) {
            const int count = std::min(kCheckedAtOnce, image.columns - 1 - begin);
            mark({rows.above + begin, rows.row + begin, rows.below + begin}, step, 0, count,
                 marks.data());
            const auto begin_of = static_cast<std::uint32_t>(image.index(begin, j));
            visit_marked(marks.data(), count, [&](int from, int end) {
                for (int k = from; k < end; ++k) visit(begin_of + static_cast<std::uint32_t>(k));
            });
        }
    }
}

/// Whether the pixel, which is not on the border, is a tooth.
bool is_tooth_at(const DepthImage& image, std::uint32_t pixel, float step) {
    const float* const at = image.levels.data() + pixel;
    const float up = *at - at[-image.columns];
    const float down = *at - at[image.columns];
    const float left = *at - at[-1];
    const float right = *at - at[1];
    return may_be_tooth(up, down, left, right, step) != 0 &&
           tooth(up, down, left, right, step) > 0.0F;
}

/// visit(right, down) for each of the pixels around one, and for the one itself.
template <typename Visit>
void each_in_square(int reach, const Visit& visit) {
    for (int down = -reach; down <= reach; ++down)
        for (int right = -reach; right <= reach; ++right) visit(right, down);
}

/// The pixel whose level is the median of those around one, and of the one itself.
std::uint32_t median_around(const DepthImage& image, std::uint32_t pixel, int reach) {
    std::array<std::pair<float, std::uint32_t>, std::size_t{kSide_px} * kSide_px> all{};
    auto end = all.begin();
    each_in_square(reach, [&](int right, int down) {
        const auto near = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(pixel) + right +
                                                     std::ptrdiff_t{down} * image.columns);
        *end++ = {image.levels[near], near};
    });
    const auto middle = all.begin() + (end - all.begin()) / 2;
    std::nth_element(all.begin(), middle, end);
    return middle->second;
}

/// A pixel and its four neighbours, without those on the border: visit(pixel).
template <typename Visit>
void each_around(const DepthImage& image, std::uint32_t pixel, const Visit& visit) {
    const auto columns = static_cast<std::uint32_t>(image.columns);
    const std::uint32_t i = pixel % columns;
    const std::uint32_t j = pixel / columns;
    if (j > 1) visit(pixel - columns);
    if (i > 1) visit(pixel - 1);
    visit(pixel);
    if (i + 2 < columns) visit(pixel + 1);
    if (j + 2 < static_cast<std::uint32_t>(image.rows)) visit(pixel + columns);
}

/// The largest step in the 3 x 3 pixels around one. (Half way between the lowest and the highest
/// level around, a steep face behind its outline would be two sides.)
struct Step {
    float middle, height;
};

constexpr std::size_t kStepsTogether = 16;  ///< pixels whose steps are found together
/// By place in the 3 x 3 around, then by pixel.
using Around = std::array<std::array<float, kStepsTogether>, 9>;
struct Steps {
    std::array<float, kStepsTogether> middle{}, height{};
    /// 1: the pixel and two opposite neighbours are of one side. It stays on its line. Else 0.
    std::array<std::uint8_t, kStepsTogether> on_line{};
};

DIBHR_VECTOR_CLONES void find_largest_steps(const Around& around, Steps& __restrict steps) {
    for (std::size_t i = 0; i < kStepsTogether; ++i) {
        float height = 0.0F;
        float middle = around[4][i];
        const auto compare = [&](std::size_t one, std::size_t other) {
            const float step = std::fabs(around[one][i] - around[other][i]);
            const float between = 0.5F * (around[one][i] + around[other][i]);
            middle = step > height ? between : middle;
            height = std::max(height, step);
        };
        for (std::size_t k = 0; k < 3; ++k) {
            compare(3 * k, 3 * k + 1);
            compare(3 * k + 1, 3 * k + 2);
            compare(k, k + 3);
            compare(k + 3, k + 6);
        }
        const float own = (around[4][i] - middle) * (2.0F / height);
        const float side = own > 0.0F ? 1.0F : -1.0F;
        float on_line = 0.0F;  // above 0: with two opposite neighbours
        for (std::size_t k = 0; k < 4; ++k)
            on_line = std::max(on_line, std::min(side * (around[k][i] - middle),
                                                 side * (around[8 - k][i] - middle)));
        steps.middle[i] = middle;
        steps.height[i] = height;
        steps.on_line[i] = static_cast<std::uint8_t>((on_line > 0.0F ? 1 : 0) &
                                                     (std::fabs(own) > kOnSide ? 1 : 0));
    }
}

/// The two sides of the largest step in the 3 x 3 pixels around one.
class Sides {
  public:
    Sides(const float* at, std::ptrdiff_t columns, const Step& step)
        : at_(at), columns_(columns), step_(step), per_half_(2.0F / step.height) {}

    /// The side of a pixel: -1 is the lower one, 1 the higher one.
    [[nodiscard]] float of(int right, int down) const {
        const float level = at_[down * columns_ + right];
        return std::min(std::max((level - step_.middle) * per_half_, -1.0F), 1.0F);  // no branches
    }

    /// The side of most of the 5 x 5 pixels around, nearer ones weigh more: above 0 is the higher
    /// one. 0: there is a ramp.
    [[nodiscard]] float of_most() const {
        float low = *at_;
        float high = *at_;
        float sum = 0.0F;
        for (int y = -kSideReach_px; y <= kSideReach_px; ++y)
            for (int x = -kSideReach_px; x <= kSideReach_px; ++x) {
                const float level = at_[y * columns_ + x];
                low = std::min(low, level);
                high = std::max(high, level);
                sum += kWeights[static_cast<std::size_t>(x + kSideReach_px)] *
                       kWeights[static_cast<std::size_t>(y + kSideReach_px)] * of(x, y);
            }
        return step_.height < kTwoSides * (high - low) ? 0.0F : sum;
    }

    struct Level {
        float level;
        bool unseen;  ///< most of its pixels are
    };
    /// Mean level of the nearest pixels on a side. `unseen`: the mark of this one; null: all were
    /// seen.
    [[nodiscard]] std::optional<Level> level(bool high, const std::uint8_t* unseen) const {
        for (int reach = 1; reach <= kSideReach_px; ++reach) {
            float sum = 0.0F;
            int count = 0;
            int marks = 0;
            for (int y = -reach; y <= reach; ++y)
                for (int x = -reach; x <= reach; ++x) {
                    const float side = of(x, y);
                    if ((x == 0 && y == 0) || (high ? side <= kOnSide : side >= -kOnSide)) continue;
                    sum += at_[y * columns_ + x];
                    marks += unseen != nullptr ? unseen[y * columns_ + x] : 0;
                    ++count;
                }
            if (count > 0) return Level{sum / static_cast<float>(count), 2 * marks > count};
        }
        return std::nullopt;
    }

  private:
    const float* at_;
    std::ptrdiff_t columns_;
    Step step_;
    float per_half_;
};

/// The new level of a pixel if most around it are on another side.
std::optional<Sides::Level> turned_level(const DepthImage& image, std::uint32_t pixel,
                                         const Step& step, std::span<const std::uint8_t> unseen) {
    const auto is_inside = [](int at, int count) {
        return at >= kSideReach_px && at < count - kSideReach_px;
    };
    if (!is_inside(static_cast<int>(pixel) % image.columns, image.columns) ||
        !is_inside(static_cast<int>(pixel) / image.columns, image.rows))
        return std::nullopt;
    const Sides sides(image.levels.data() + pixel, image.columns, step);
    const float own = sides.of(0, 0);
    const float most = sides.of_most();
    if (most == 0.0F || (std::fabs(own) > kOnSide && (own > 0.0F) == (most > 0.0F)))
        return std::nullopt;
    return sides.level(most > 0.0F, unseen.empty() ? nullptr : unseen.data() + pixel);
}

}  // namespace

void OutlineSmoother::smooth(DepthImage& image, std::size_t recorded_teeth,
                             std::span<std::uint8_t> unseen) {
    const float step = step_of(image);
    find_steps(image, step);
    turn_sides(image, unseen);
    keep_teeth(image, step);
    touched_ = pixels_;
    for (int k = 0; k < kMostPasses && !pixels_.empty(); ++k)
        take_teeth(image, step, k < kSpur_px ? 1 : 0, unseen);
    if (teeth_ <= recorded_teeth) return;
    pixels_.swap(touched_);
    keep_teeth(image, step);
    for (int k = 0; k < kMostPasses && !pixels_.empty() && teeth_ > recorded_teeth; ++k)
        take_teeth(image, step, 1, unseen);
    for (int reach = 1; reach <= kSideReach_px && teeth_ > recorded_teeth; ++reach) {
        find_steps(image, step);
        keep_teeth(image, step);
        for (const std::uint32_t pixel : pixels_)
            if (teeth_ > recorded_teeth) take_medians(image, pixel, step, reach, unseen);
    }
}

void OutlineSmoother::find_steps(const DepthImage& image, float step) {
    pixels_.clear();
    each_marked(image, mark_steps, step, [&](std::uint32_t pixel) { pixels_.push_back(pixel); });
}

/// Moves pixels to the side that most around them have, all at once. pixels_ then has those around
/// the moved ones, too: all that may be teeth.
void OutlineSmoother::turn_sides(DepthImage& image, std::span<std::uint8_t> unseen) {
    turned_.clear();
    Around around{};
    Steps steps;
    for (std::size_t begin = 0; begin < pixels_.size(); begin += kStepsTogether) {
        const std::size_t count = std::min(kStepsTogether, pixels_.size() - begin);
        for (std::size_t k = 0; k < count; ++k) {
            const float* const at = image.levels.data() + pixels_[begin + k];
            for (std::ptrdiff_t y = -1; y <= 1; ++y)
                for (std::ptrdiff_t x = -1; x <= 1; ++x)
                    around[static_cast<std::size_t>(3 * y + x + 4)][k] = at[y * image.columns + x];
        }
        find_largest_steps(around, steps);
        for (std::size_t k = 0; k < count; ++k) {
            if (steps.on_line[k] != 0) continue;
            const std::uint32_t pixel = pixels_[begin + k];
            const auto taken =
                turned_level(image, pixel, {steps.middle[k], steps.height[k]}, unseen);
            if (taken) turned_.push_back({pixel, taken->level, taken->unseen});
        }
    }
    for (const Turned& turned : turned_) {
        image.levels[turned.pixel] = turned.level;
        if (!unseen.empty()) unseen[turned.pixel] = turned.unseen ? 1 : 0;
        each_around(image, turned.pixel, [&](std::uint32_t near) { pixels_.push_back(near); });
    }
}

/// Of pixels_ remain the teeth, in order.
void OutlineSmoother::keep_teeth(const DepthImage& image, float step) {
    std::erase_if(pixels_, [&](std::uint32_t pixel) { return !is_tooth_at(image, pixel, step); });
    std::sort(pixels_.begin(), pixels_.end());
    pixels_.erase(std::unique(pixels_.begin(), pixels_.end()), pixels_.end());
    teeth_ = pixels_.size();
}

/// Moves each tooth of pixels_ that leaves fewer, or as many if `as_many` is 1, one after the
/// other; pixels_ then are the teeth beside those.
void OutlineSmoother::take_teeth(DepthImage& image, float step, std::size_t as_many,
                                 std::span<std::uint8_t> unseen) {
    const auto is_tooth = [&](std::uint32_t pixel) { return is_tooth_at(image, pixel, step); };
    const auto teeth_around = [&](std::uint32_t pixel) {
        std::size_t count = 0;
        each_around(image, pixel, [&](std::uint32_t near) { count += is_tooth(near) ? 1 : 0; });
        return count;
    };
    const auto columns = static_cast<std::uint32_t>(image.columns);
    turned_.clear();
    for (const std::uint32_t pixel : pixels_) {
        if (!is_tooth(pixel)) continue;
        float* const at = image.levels.data() + pixel;
        const auto mean_of = [at](std::ptrdiff_t apart) { return 0.5F * (at[-apart] + at[apart]); };
        const float across = mean_of(1);
        const float down = mean_of(image.columns);
        const float own = *at;
        const std::size_t before = teeth_around(pixel);
        // Of a tooth the two neighbours along the outline are farther away than the others' mean.
        const bool takes_down = std::fabs(down - own) > std::fabs(across - own);
        *at = takes_down ? down : across;
        const std::size_t after = teeth_around(pixel);
        if (after >= before + as_many) {
            *at = own;
            continue;
        }
        const std::uint32_t apart = takes_down ? columns : 1;
        const bool is_unseen = !unseen.empty() && unseen[pixel - apart] + unseen[pixel + apart] > 1;
        turned_.push_back({pixel, *at, is_unseen});
        if (!unseen.empty()) unseen[pixel] = is_unseen ? 1 : 0;
        teeth_ = teeth_ + after - before;
    }
    pixels_.clear();
    for (const Turned& turned : turned_)
        each_around(image, turned.pixel, [&](std::uint32_t near) {
            if (is_tooth(near)) pixels_.push_back(near);
        });
    std::sort(pixels_.begin(), pixels_.end());
    pixels_.erase(std::unique(pixels_.begin(), pixels_.end()), pixels_.end());
    touched_.insert(touched_.end(), pixels_.begin(), pixels_.end());
}

/// Where that leaves fewer teeth, the pixels around a tooth become the medians of those around
/// each: some teeth only go together with their neighbours.
void OutlineSmoother::take_medians(DepthImage& image, std::uint32_t pixel, float step, int reach,
                                   std::span<std::uint8_t> unseen) {
    const int column = static_cast<int>(pixel) % image.columns;
    const int row = static_cast<int>(pixel) / image.columns;
    const int read_px = 2 * reach;  // around the tooth
    if (std::min(column, image.columns - 1 - column) < read_px + 1 ||
        std::min(row, image.rows - 1 - row) < read_px + 1)
        return;
    const auto pixel_at = [&](int right, int down) {
        return static_cast<std::uint32_t>(image.index(column + right, row + down));
    };
    const auto count_teeth = [&] {
        std::size_t count = 0;
        each_in_square(reach + 1, [&](int right, int down) {
            count += is_tooth_at(image, pixel_at(right, down), step) ? 1 : 0;
        });
        return count;
    };
    const std::size_t before = count_teeth();
    turned_.clear();
    each_in_square(reach, [&](int right, int down) {
        const std::uint32_t near = pixel_at(right, down);
        const std::uint32_t median = median_around(image, near, reach);
        turned_.push_back({near, image.levels[median], !unseen.empty() && unseen[median] != 0});
    });
    for (Turned& turned : turned_) std::swap(image.levels[turned.pixel], turned.level);
    const std::size_t after = count_teeth();
    if (after >= before) {
        for (const Turned& turned : turned_) image.levels[turned.pixel] = turned.level;
        return;
    }
    teeth_ = teeth_ + after - before;
    if (unseen.empty()) return;
    for (const Turned& turned : turned_) unseen[turned.pixel] = turned.unseen ? 1 : 0;
}

std::size_t teeth_of(const DepthImage& image) {
    std::size_t count = 0;
    each_marked(image, mark_teeth, step_of(image), [&](std::uint32_t) { ++count; });
    return count;
}

}  // namespace dibhr
