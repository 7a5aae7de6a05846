// Decides the side of each pixel beside a step by those around it, then takes single teeth.
#include "core/video/cleaning/outlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// An outline is a step of more than this part of the range.
constexpr float kStepOfOutline = 0.05F;
constexpr int kReach_px = 2;  ///< of the pixels that decide a side
constexpr int kSide_px = 2 * kReach_px + 1;
/// By their distance along rows and columns the 5 x 5 pixels around weigh this, as a Gaussian of
/// 1.2 px.
constexpr float kOneAway = 0.70664828F, kTwoAway = 0.24935221F;
constexpr std::array<float, kSide_px> kWeights{kTwoAway, kOneAway, 1.0F, kOneAway, kTwoAway};
/// The largest step beside a pixel, over the range of the 5 x 5 around: below it, there is a ramp.
constexpr float kTwoSides = 0.4F;
constexpr float kOnSide = 0.5F;  ///< nearer to the middle a pixel is on neither side

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kSpur_px = 2;      ///< a line one pixel wide loses this at its ends
constexpr int kChunk = 64;       ///< pixels of a row that are checked together
constexpr int kMostPasses = 64;  ///< over the teeth that are left

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

/// Whether any pixel is beyond two opposite neighbours by more than `step`, as a tooth is. A
/// neighbour without data (NaN) may count as beyond.
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
        found |= static_cast<int>(std::min(up, down) > step) |
                 static_cast<int>(std::max(up, down) < -step) |
                 static_cast<int>(std::min(left, right) > step) |
                 static_cast<int>(std::max(left, right) < -step);
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
    std::array<std::uint8_t, kChunk> marks{};
    for (int j = 1; j + 1 < image.rows; ++j) {
        const Rows rows = rows_at(image, j);
        for (int begin = 1; begin < image.columns - 1; begin += kChunk) {
            const int count = std::min(kChunk, image.columns - 1 - begin);
            mark({rows.above + begin, rows.row + begin, rows.below + begin}, step, 0, count,
                 marks.data());
            const auto begin_of = static_cast<std::uint32_t>(image.index(begin, j));
            for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(count); ++k) {
                const void* const next =
                    std::memchr(marks.data() + k, 1, static_cast<std::size_t>(count) - k);
                if (next == nullptr) break;
                k = static_cast<std::uint32_t>(static_cast<const std::uint8_t*>(next) -
                                               marks.data());
                visit(begin_of + k);
            }
        }
    }
}

/// Whether the pixel, which is not on the border, is a tooth.
bool is_tooth_at(const DepthImage& image, std::uint32_t pixel, float step) {
    const float* const at = image.levels.data() + pixel;
    return tooth(*at - at[-image.columns], *at - at[image.columns], *at - at[-1], *at - at[1],
                 step) > 0.0F;
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

/// The two sides of the largest step in the 3 x 3 pixels around one. (Half way between the lowest
/// and the highest level around, a steep face behind its outline would be two sides.)
class Sides {
  public:
    Sides(const float* at, std::ptrdiff_t columns) : at_(at), columns_(columns), middle_(*at) {
        const auto compare = [&](std::ptrdiff_t one, std::ptrdiff_t other) {
            const float step = std::fabs(at[one] - at[other]);
            middle_ = step > largest_ ? 0.5F * (at[one] + at[other]) : middle_;
            largest_ = std::max(largest_, step);
        };
        for (std::ptrdiff_t k = -1; k <= 1; ++k) {
            compare(k * columns - 1, k * columns);
            compare(k * columns, k * columns + 1);
            compare(k - columns, k);
            compare(k, k + columns);
        }
        per_half_ = 2.0F / largest_;
    }

    /// The side of a pixel: -1 is the lower one, 1 the higher one.
    [[nodiscard]] float of(int right, int down) const {
        const float level = at_[down * columns_ + right];
        return std::clamp((level - middle_) * per_half_, -1.0F, 1.0F);
    }

    /// Whether the pixel and two opposite neighbours are of one side: then it is on a line.
    [[nodiscard]] bool is_on_line() const {
        const auto above = [&](int right, int down) {
            return at_[down * columns_ + right] - middle_;
        };
        const bool high = above(0, 0) > 0.0F;
        const auto both = [&](int right, int down) {
            const float one = above(right, down);
            const float other = above(-right, -down);
            return high ? std::min(one, other) > 0.0F : std::max(one, other) < 0.0F;
        };
        return both(1, 0) || both(0, 1) || both(1, 1) || both(1, -1);
    }

    /// The side of most of the 5 x 5 pixels around, nearer ones weigh more: above 0 is the higher
    /// one. 0: there is a ramp.
    [[nodiscard]] float of_most() const {
        float low = *at_;
        float high = *at_;
        float sum = 0.0F;
        for (int y = -kReach_px; y <= kReach_px; ++y)
            for (int x = -kReach_px; x <= kReach_px; ++x) {
                const float level = at_[y * columns_ + x];
                low = std::min(low, level);
                high = std::max(high, level);
                sum += kWeights[static_cast<std::size_t>(x + kReach_px)] *
                       kWeights[static_cast<std::size_t>(y + kReach_px)] * of(x, y);
            }
        return largest_ < kTwoSides * (high - low) ? 0.0F : sum;
    }

    /// Mean level of the nearest pixels on a side; NaN: there are none.
    [[nodiscard]] float level(bool high) const {
        for (int reach = 1; reach <= kReach_px; ++reach) {
            float sum = 0.0F;
            int count = 0;
            for (int y = -reach; y <= reach; ++y)
                for (int x = -reach; x <= reach; ++x) {
                    const float side = of(x, y);
                    if ((x == 0 && y == 0) || (high ? side <= kOnSide : side >= -kOnSide)) continue;
                    sum += at_[y * columns_ + x];
                    ++count;
                }
            if (count > 0) return sum / static_cast<float>(count);
        }
        return kNaN;
    }

  private:
    const float* at_;
    std::ptrdiff_t columns_;
    float middle_;
    float largest_{0.0F};
    float per_half_{0.0F};
};

}  // namespace

void OutlineSmoother::smooth(DepthImage& image, std::size_t recorded_teeth) {
    const float step = step_of(image);
    find_steps(image, step);
    turn_sides(image);
    keep_teeth(image, step);
    touched_ = pixels_;
    for (int k = 0; k < kMostPasses && !pixels_.empty(); ++k)
        take_teeth(image, step, k < kSpur_px ? 1 : 0);
    if (teeth_ <= recorded_teeth) return;
    pixels_.swap(touched_);
    keep_teeth(image, step);
    for (int k = 0; k < kMostPasses && !pixels_.empty() && teeth_ > recorded_teeth; ++k)
        take_teeth(image, step, 1);
}

void OutlineSmoother::find_steps(const DepthImage& image, float step) {
    pixels_.clear();
    each_marked(image, mark_steps, step, [&](std::uint32_t pixel) { pixels_.push_back(pixel); });
}

/// Moves pixels to the side that most around them have, all at once. pixels_ then has those around
/// the moved ones, too: all that may be teeth.
void OutlineSmoother::turn_sides(DepthImage& image) {
    const auto is_inside = [](int at, int count) {
        return at >= kReach_px && at < count - kReach_px;
    };
    turned_.clear();
    for (const std::uint32_t pixel : pixels_) {
        if (!is_inside(static_cast<int>(pixel) % image.columns, image.columns) ||
            !is_inside(static_cast<int>(pixel) / image.columns, image.rows))
            continue;
        const Sides sides(image.levels.data() + pixel, image.columns);
        const float own = sides.of(0, 0);
        const bool is_on_side = std::fabs(own) > kOnSide;
        if (is_on_side && sides.is_on_line()) continue;
        const float most = sides.of_most();
        if (most == 0.0F || (is_on_side && (own > 0.0F) == (most > 0.0F))) continue;
        const float level = sides.level(most > 0.0F);
        if (!std::isnan(level)) turned_.emplace_back(pixel, level);
    }
    for (const auto& [pixel, level] : turned_) {
        image.levels[pixel] = level;
        each_around(image, pixel, [&](std::uint32_t near) { pixels_.push_back(near); });
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
void OutlineSmoother::take_teeth(DepthImage& image, float step, std::size_t as_many) {
    const auto is_tooth = [&](std::uint32_t pixel) { return is_tooth_at(image, pixel, step); };
    const auto teeth_around = [&](std::uint32_t pixel) {
        std::size_t count = 0;
        each_around(image, pixel, [&](std::uint32_t near) { count += is_tooth(near) ? 1 : 0; });
        return count;
    };
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
        *at = std::fabs(down - own) > std::fabs(across - own) ? down : across;
        const std::size_t after = teeth_around(pixel);
        if (after >= before + as_many) {
            *at = own;
            continue;
        }
        turned_.emplace_back(pixel, own);
        teeth_ = teeth_ + after - before;
    }
    pixels_.clear();
    for (const auto& turned : turned_)
        each_around(image, turned.first, [&](std::uint32_t near) {
            if (is_tooth(near)) pixels_.push_back(near);
        });
    std::sort(pixels_.begin(), pixels_.end());
    pixels_.erase(std::unique(pixels_.begin(), pixels_.end()), pixels_.end());
    touched_.insert(touched_.end(), pixels_.begin(), pixels_.end());
}

std::size_t teeth_of(const DepthImage& image) {
    std::size_t count = 0;
    each_marked(image, mark_teeth, step_of(image), [&](std::uint32_t) { ++count; });
    return count;
}

}  // namespace dibhr
