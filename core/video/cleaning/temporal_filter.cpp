// Medians of five frames, then means of those of eleven frames that are like the median.
#include "core/video/cleaning/temporal_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "core/video/cleaning/even_motion.hpp"
#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMedianReach = 2;       ///< frames to each side
constexpr float kAlike = 3.0F;                ///< standard deviations; beyond, levels do not mix
constexpr float kFilledShare = 0.05F;         ///< weight of a filled pixel against a seen one
constexpr float kLeastNoise = 0.1F / 255.0F;  ///< of the highest level: least assumed noise

// A patch that lasts less than three frames is kept if enough of its rim is connected to ("held
// by") a surface that stays. Measured on people who walk past within two frames, whose feet touch
// the floor, and on hands, whose palm stays longer than the fingers.
constexpr int kWide_px = 5;
constexpr double kHeldShare = 0.4;   ///< of the rim
constexpr double kHeldWidths = 0.7;  ///< of a thin patch: rim pixels a width
constexpr int kThinInWidth = 20;  ///< a thin patch is at most this part of the image's width wide
constexpr int kHeldWithin_px = 4;
constexpr float kSurely = 2.0F;  ///< bounds; beyond, a level is another surface and not noise

// Moving parts are found in the frames before and after, by regions as wide as a finger.
constexpr int kRegion_px = 32;
constexpr std::size_t kLeastOthers = 32;  ///< surely other pixels; with fewer a region is skipped
constexpr std::size_t kSamples = 20;      ///< of these pixels
constexpr std::size_t kSpread = 7;        ///< coprime to 20: the first samples are from all over
constexpr float kAlikeStep = 0.2F;        ///< of a sample's distance from the median: same surface

float median_of_three(float a, float b, float c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

float median_of_five(float a, float b, float c, float d, float e) {
    const float low = std::max(std::min(a, b), std::min(c, d));
    const float high = std::min(std::max(a, b), std::max(c, d));
    return median_of_three(e, low, high);
}

DIBHR_VECTOR_CLONES void medians(const float* a, const float* b, const float* c, const float* d,
                                 const float* e, float* __restrict out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out[i] = median_of_five(a[i], b[i], c[i], d[i], e[i]);
}

DIBHR_VECTOR_CLONES void medians(const float* a, const float* b, const float* c,
                                 float* __restrict out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out[i] = median_of_three(a[i], b[i], c[i]);
}

constexpr std::uint8_t kSurelyOther = 3;  ///< another surface, and not noise; 1: maybe

/// Marks levels of another surface than the reference. Returns whether there are any.
DIBHR_VECTOR_CLONES bool mark_other(const float* levels, const float* reference,
                                    const NoiseBound& bound, std::uint8_t* __restrict marks,
                                    std::size_t count) {
    const NoiseBound of = bound;
    int any = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float off = std::fabs(levels[i] - reference[i]);
        const int other = off > of(reference[i]) ? 1 : 0;
        const int surely = off > kSurely * of(levels[i]) ? 3 : 1;
        const int mark = -other & surely;
        marks[i] = static_cast<std::uint8_t>(mark);
        any |= mark;
    }
    return any != 0;
}

DIBHR_VECTOR_CLONES void unmark(const std::uint8_t* filled, std::uint8_t* __restrict marks,
                                std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        marks[i] = static_cast<std::uint8_t>(filled[i] != 0 ? 0 : marks[i]);
}

DIBHR_VECTOR_CLONES void invert(const float* reference, const NoiseBound& bound,
                                float* __restrict per_bound, std::size_t count) {
    const NoiseBound of = bound;
    for (std::size_t i = 0; i < count; ++i) per_bound[i] = 1.0F / of(reference[i]);
}

/// Tukey's biweight: 0 at the bound and beyond.
inline float weight_of(float off, float per_bound) {
    const float part = off * per_bound;
    const float near = std::max(1.0F - part * part, 0.0F);
    return near * near;
}

/// The weighted mean of a pixel's differences from its reference.
struct Mean {
    float sum, weight;

    void add(float level, float seen, float reference, float per_bound) {
        const float off = level - reference;
        const float more = seen * weight_of(off, per_bound);
        sum += more * off;
        weight += more;
    }
    void add(float level, float reference, float per_bound) {
        add(level, 1.0F, reference, per_bound);
    }
};

inline float share_of(std::uint8_t filled) {
    return 1.0F - (1.0F - kFilledShare) * static_cast<float>(filled);
}

/// Rows of four frames at once: sums and weights are read and written a quarter as often.
using Four = std::array<const float*, 4>;
using FourFilled = std::array<const std::uint8_t*, 4>;

DIBHR_VECTOR_CLONES void add_four(const Four& rows, const float* reference, const float* per_bound,
                                  float* __restrict sum, float* __restrict weights,
                                  std::size_t count) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{sum[i], weights[i]};
        mean.add(a[i], reference[i], per_bound[i]);
        mean.add(b[i], reference[i], per_bound[i]);
        mean.add(c[i], reference[i], per_bound[i]);
        mean.add(d[i], reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
    }
}

DIBHR_VECTOR_CLONES void add_four(const Four& rows, const FourFilled& filled,
                                  const float* reference, const float* per_bound,
                                  float* __restrict sum, float* __restrict weights,
                                  std::size_t count) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
    const std::uint8_t *at_a = filled[0], *at_b = filled[1], *at_c = filled[2], *at_d = filled[3];
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{sum[i], weights[i]};
        mean.add(a[i], share_of(at_a[i]), reference[i], per_bound[i]);
        mean.add(b[i], share_of(at_b[i]), reference[i], per_bound[i]);
        mean.add(c[i], share_of(at_c[i]), reference[i], per_bound[i]);
        mean.add(d[i], share_of(at_d[i]), reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
    }
}

DIBHR_VECTOR_CLONES void add_one(const float* levels, const float* reference,
                                 const float* per_bound, float* __restrict sum,
                                 float* __restrict weights, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{sum[i], weights[i]};
        mean.add(levels[i], reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
    }
}

DIBHR_VECTOR_CLONES void add_one(const float* levels, const std::uint8_t* filled,
                                 const float* reference, const float* per_bound,
                                 float* __restrict sum, float* __restrict weights,
                                 std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{sum[i], weights[i]};
        mean.add(levels[i], share_of(filled[i]), reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
    }
}

DIBHR_VECTOR_CLONES void divide(const float* reference, const float* sum, const float* weights,
                                float* __restrict out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        out[i] = reference[i] + (weights[i] > 0.0F ? sum[i] / weights[i] : 0.0F);
}

/// The rim of a patch, and how much of it is held by the surface beside it.
struct Rim {
    int pixels{0};
    int held{0};
    float half_width_px{0.0F};  ///< of the patch
};

}  // namespace

void TemporalFilter::gather(std::span<const SingleFrameDepth* const> frames, std::size_t now) {
    const SingleFrameDepth& here = *frames[now];
    const std::size_t first = now - std::min(now, kReachInTime);
    const std::size_t end = std::min(frames.size(), now + kReachInTime + 1);
    count_ = 0;
    nearest_ = 0;
    for (std::size_t k = first; k < end; ++k) {
        if (!are_alike(frames[k]->depth, here.depth)) continue;
        const std::size_t away = k > now ? k - now : now - k;
        if (away <= kMedianReach && nearest_++ == 0) first_near_ = count_;
        neighbours_[count_++] = {frames[k]->depth.levels.data(),
                                 frames[k]->filled.empty() ? nullptr : frames[k]->filled.data()};
    }
}

/// The median of `count` pixels over the frame and those near it: over five frames, else three.
void TemporalFilter::find_reference(const float* here, std::size_t at, std::size_t count,
                                    float* reference) const {
    const Neighbour* n = neighbours_.data() + first_near_;
    if (nearest_ == 5) {
        medians(n[0].levels + at, n[1].levels + at, n[2].levels + at, n[3].levels + at,
                n[4].levels + at, reference, count);
    } else if (nearest_ >= 3) {
        if (nearest_ == 4 && n[1].levels != here) ++n;
        medians(n[0].levels + at, n[1].levels + at, n[2].levels + at, reference, count);
    } else {
        std::copy_n(here + at, count, reference);
    }
}

/// Averages row by row, so that each row stays in the cache. Returns whether any of the frame's own
/// levels is another surface than the median.
bool TemporalFilter::average_rows(const SingleFrameDepth& here, DepthImage& out) {
    const auto columns = static_cast<std::size_t>(out.columns);
    other_.resize(out.levels.size());
    reference_.resize(columns);
    bool any = false;
    for (int j = 0; j < out.rows; ++j) {
        const std::size_t at = out.index(0, j);
        find_reference(here.depth.levels.data(), at, columns, reference_.data());
        if (mark_other(here.depth.levels.data() + at, reference_.data(), bound_, other_.data() + at,
                       columns)) {
            if (!here.filled.empty()) unmark(here.filled.data() + at, other_.data() + at, columns);
            any = true;
        }
        average(reference_.data(), at, columns, out);
    }
    return any;
}

/// Where a frame has another level than the median, that level lasts two frames at most. It is kept
/// all the same where it is a part of a surface that stays longer: between two sides of it, as when
/// fingers pass one after the other, or in a patch that it holds; and where it moves.
void TemporalFilter::follow_parts(const SingleFrameDepth& here, DepthImage& out) {
    followed_.assign(other_.size(), 0);
    follow_between(here.depth);
    follow_patches(here.depth);
    for (int j = 0; j < out.rows; ++j) {
        const std::size_t at = out.index(0, j);
        visit_marked(followed_.data() + at, out.columns, [&](int begin, int end) {
            const std::size_t from = at + static_cast<std::size_t>(begin);
            average(here.depth.levels.data() + from, from, static_cast<std::size_t>(end - begin),
                    out);
        });
    }
    follow_motion(here, out);
}

/// A region moves if most of its other pixels are found in the frames before and after, moved as
/// far to opposite sides. A flip lasts one frame or two and does not move. At the ends of a clip
/// two frames of one side are compared.
void TemporalFilter::follow_motion(const SingleFrameDepth& here, DepthImage& out) {
    if (count_ < 3) return;
    std::size_t now = 0;
    while (neighbours_[now].levels != here.depth.levels.data()) ++now;
    const bool is_first = now == 0;
    const bool is_last = now + 1 == count_;
    const std::size_t a = is_first ? now + 2 : now - 1;
    const std::size_t b = is_last ? now - 2 : now + 1;
    EvenMotionSearch search(here.depth, {neighbours_[a].levels, is_first ? 2 : -1},
                            {neighbours_[b].levels, is_last ? -2 : 1});
    for (int top = 0; top < out.rows; top += kRegion_px) {
        for (int left = 0; left < out.columns; left += kRegion_px) {
            const Region region{left, top, std::min(left + kRegion_px, out.columns),
                                std::min(top + kRegion_px, out.rows)};
            if (take_samples(here.depth, region, search)) follow_region(here, region, search, out);
        }
    }
}

/// Takes samples of the surely other pixels of a region. Returns whether there are enough.
bool TemporalFilter::take_samples(const DepthImage& here, const Region& region,
                                  EvenMotionSearch& search) {
    surely_other_.clear();
    for (int j = region.top; j < region.bottom; ++j) {
        const std::size_t from = here.index(region.left, j);
        visit_marked(other_.data() + from, region.right - region.left, [&](int begin, int end) {
            for (int i = begin; i < end; ++i)
                if (const std::size_t at = from + static_cast<std::size_t>(i);
                    other_[at] == kSurelyOther)
                    surely_other_.push_back(at);
        });
    }
    if (surely_other_.size() < kLeastOthers) return false;
    const auto columns = static_cast<std::size_t>(here.columns);
    search.clear();
    for (std::size_t k = 0; k < kSamples; ++k) {
        const std::size_t at =
            surely_other_[k * kSpread % kSamples * surely_other_.size() / kSamples];
        const float level = here.levels[at];
        float reference = 0.0F;
        find_reference(here.levels.data(), at, 1, &reference);
        search.add({static_cast<std::ptrdiff_t>(at), static_cast<int>(at % columns),
                    static_cast<int>(at / columns), level,
                    std::max(bound_(level), kAlikeStep * std::fabs(level - reference))});
    }
    return true;
}

/// Filled pixels move along: the shadow beside a hand.
void TemporalFilter::follow_region(const SingleFrameDepth& here, const Region& region,
                                   const EvenMotionSearch& search, DepthImage& out) {
    const std::optional<EvenMotion> motion = search.found();
    if (!motion) return;
    for (int j = region.top; j < region.bottom; ++j) {
        std::size_t run = 0;
        for (int i = region.left; i < region.right; ++i) {
            const std::optional<float> level = is_other(here, here.depth.index(i, j))
                                                   ? search.level_along(*motion, i, j, bound_)
                                                   : std::nullopt;
            if (level) reference_[run++] = *level;
            if (run == 0 || (level && i + 1 < region.right)) continue;
            average(reference_.data(), here.depth.index(level ? i + 1 : i, j) - run, run, out);
            run = 0;
        }
    }
}

/// Whether the level is another one than the median, and not followed yet.
bool TemporalFilter::is_other(const SingleFrameDepth& here, std::size_t at) const {
    if (followed_[at] != 0) return false;
    if (here.filled.empty() || here.filled[at] == 0) return other_[at] != 0;
    float reference = 0.0F;
    find_reference(here.depth.levels.data(), at, 1, &reference);
    return std::fabs(here.depth.levels[at] - reference) > bound_(reference);
}

void TemporalFilter::follow_between(const DepthImage& here) {
    for (int j = 0; j < here.rows; ++j) {
        const std::uint8_t* const row = other_.data() + here.index(0, j);
        visit_marked(row, here.columns, [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                if (row[i] != kSurelyOther) continue;
                const Held held = held_at(here, i, j);
                const bool between =
                    (is_held(here, held, i, j, 1, 0) && is_held(here, held, i, j, -1, 0)) ||
                    (is_held(here, held, i, j, 0, 1) && is_held(here, held, i, j, 0, -1));
                if (between) followed_[here.index(i, j)] = 1;
            }
        });
    }
}

/// Only the part of the image that has wide patches is processed.
void TemporalFilter::follow_patches(const DepthImage& here) {
    const cv::Mat square = cv::Mat::ones(kWide_px, kWide_px, CV_8U);
    const cv::Mat other(here.rows, here.columns, CV_8U, other_.data());
    inner_.resize(other_.size());
    cv::Mat inner(here.rows, here.columns, CV_8U, inner_.data());
    cv::erode(other, inner, square);
    const cv::Rect found = cv::boundingRect(inner);
    if (found.empty()) return;
    constexpr int kAround_px = 2 * (kWide_px / 2) + 1;  // dilated twice, and a rim
    const cv::Rect box = cv::Rect(found.x - kAround_px, found.y - kAround_px,
                                  found.width + 2 * kAround_px, found.height + 2 * kAround_px) &
                         cv::Rect(0, 0, here.columns, here.rows);
    cv::Mat wide;
    cv::Mat patches;
    cv::Mat to_rim;
    cv::dilate(inner(box), wide, square);
    const int count = cv::connectedComponents(wide, patches);
    cv::distanceTransform(wide, to_rim, cv::DIST_L2, cv::DIST_MASK_3);
    const std::vector<char> held = held_patches(here, patches, to_rim, count, box.x, box.y);
    for (int j = 0; j < box.height; ++j) {
        const int* const patch = patches.ptr<int>(j);
        auto* const pixel = wide.ptr<std::uint8_t>(j);
        for (int i = 0; i < box.width; ++i)
            pixel[i] = held[static_cast<std::size_t>(patch[i])] != 0 ? 1 : 0;
    }
    cv::dilate(wide, wide, square);  // the corners that opening has removed
    for (int j = 0; j < box.height; ++j) {
        const auto* const pixel = wide.ptr<std::uint8_t>(j);
        const std::size_t at = here.index(box.x, box.y + j);
        for (std::size_t i = 0; i < static_cast<std::size_t>(box.width); ++i)
            followed_[at + i] =
                static_cast<std::uint8_t>(followed_[at + i] | (pixel[i] & other_[at + i]));
    }
}

/// `left` and `top`: the place of `patches` in the image.
std::vector<char> TemporalFilter::held_patches(const DepthImage& here, const cv::Mat& patches,
                                               const cv::Mat& to_rim, int count, int left,
                                               int top) const {
    std::vector<Rim> rims(static_cast<std::size_t>(count));
    const cv::Rect inside(0, 0, patches.cols, patches.rows);
    for (int j = 0; j < patches.rows; ++j) {
        const int* const row = patches.ptr<int>(j);
        for (int i = 0; i < patches.cols; ++i) {
            const int patch = row[i];
            if (patch == 0) continue;
            Rim& rim = rims[static_cast<std::size_t>(patch)];
            rim.half_width_px = std::max(rim.half_width_px, to_rim.at<float>(j, i));
            for (const auto& [right, down] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                const cv::Point beside(i + right, j + down);
                if (!inside.contains(beside)) continue;
                if (patches.at<int>(beside) == patch) continue;
                ++rim.pixels;
                const int x = left + i;
                const int y = top + j;
                if (other_[here.index(x, y)] == kSurelyOther)
                    rim.held += is_held(here, held_at(here, x, y), x, y, right, down) ? 1 : 0;
            }
        }
    }
    std::vector<char> held(rims.size(), 0);
    for (std::size_t k = 1; k < rims.size(); ++k) {
        const double width_px = 2.0 * static_cast<double>(rims[k].half_width_px);
        const bool thin = kThinInWidth * width_px <= here.columns;
        const double wanted = thin ? kHeldWidths * width_px : kHeldShare * rims[k].pixels;
        held[k] = rims[k].held > 0 && rims[k].held >= wanted ? 1 : 0;
    }
    return held;
}

TemporalFilter::Held TemporalFilter::held_at(const DepthImage& here, int i, int j) const {
    const std::size_t at = here.index(i, j);
    float reference = 0.0F;
    find_reference(here.levels.data(), at, 1, &reference);
    return {here.levels[at], reference, kSurely * bound_(here.levels[at])};
}

/// Whether in that direction the pixel's surface, and not that of the median, continues to pixels
/// that are not other. For surely other pixels only: else blotches of noise would hold each other.
bool TemporalFilter::is_held(const DepthImage& here, const Held& held, int i, int j, int right,
                             int down) const {
    for (int away = 1; away <= kHeldWithin_px; ++away) {
        const int x = i + away * right;
        const int y = j + away * down;
        if (x < 0 || y < 0 || x >= here.columns || y >= here.rows) return false;
        if (other_[here.index(x, y)] != 0) continue;
        const float off = std::fabs(here.at(x, y) - held.level);
        return off <= held.alike && 2.0F * off <= std::fabs(here.at(x, y) - held.reference);
    }
    return false;
}

/// Averages `count` pixels from `at` on, in one row; `reference`: from the first pixel on.
void TemporalFilter::average(const float* reference, std::size_t at, std::size_t count,
                             DepthImage& out) {
    per_bound_.resize(count);
    invert(reference, bound_, per_bound_.data(), count);
    sum_.assign(count, 0.0F);
    weights_.assign(count, 0.0F);
    std::size_t k = 0;
    for (; k + 4 <= count_; k += 4) {
        const Neighbour* n = neighbours_.data() + k;
        const Four rows{n[0].levels + at, n[1].levels + at, n[2].levels + at, n[3].levels + at};
        const FourFilled filled{filled_of(n[0], at), filled_of(n[1], at), filled_of(n[2], at),
                                filled_of(n[3], at)};
        if (std::any_of(n, n + 4, [](const Neighbour& one) { return one.filled != nullptr; }))
            add_four(rows, filled, reference, per_bound_.data(), sum_.data(), weights_.data(),
                     count);
        else
            add_four(rows, reference, per_bound_.data(), sum_.data(), weights_.data(), count);
    }
    for (; k < count_; ++k) {
        const Neighbour& n = neighbours_[k];
        if (n.filled == nullptr)
            add_one(n.levels + at, reference, per_bound_.data(), sum_.data(), weights_.data(),
                    count);
        else
            add_one(n.levels + at, n.filled + at, reference, per_bound_.data(), sum_.data(),
                    weights_.data(), count);
    }
    divide(reference, sum_.data(), weights_.data(), out.levels.data() + at, count);
}

const std::uint8_t* TemporalFilter::filled_of(const Neighbour& n, std::size_t at) const {
    return n.filled == nullptr ? nothing_filled_.data() : n.filled + at;
}

DepthImage TemporalFilter::filtered(std::span<const SingleFrameDepth* const> frames,
                                    std::size_t now, const DepthNoise& noise) {
    const SingleFrameDepth& here = *frames[now];
    DepthImage out{here.depth.columns, here.depth.rows, here.depth.highest_level, {}};
    out.levels.resize(here.depth.levels.size());
    bound_ = NoiseBound(noise, kAlike, kLeastNoise, here.depth.highest_level);
    gather(frames, now);
    nothing_filled_.assign(static_cast<std::size_t>(out.columns), 0);
    if (average_rows(here, out)) follow_parts(here, out);
    return out;
}

}  // namespace dibhr
