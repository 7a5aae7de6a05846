// Loops over rows of a frame and of those around it, compiled for wide vectors, too.
#include "core/video/cleaning/rows_in_time.hpp"

#include <algorithm>
#include <cmath>

#include "core/video/cleaning/frame_groups.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr::in_time {

namespace {

constexpr float kGroupsApart = 1.5F;   ///< of groups' levels, which have half the deviation
constexpr float kFilledShare = 0.05F;  ///< weight of a filled pixel against a seen one
constexpr float kLeastFrames = 3.0F;   ///< for a variance

float median_of_three(float a, float b, float c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

float median_of_five(float a, float b, float c, float d, float e) {
    const float low = std::max(std::min(a, b), std::min(c, d));
    const float high = std::min(std::max(a, b), std::max(c, d));
    return median_of_three(e, low, high);
}

/// 1 up to kMixes, 0 from kApart on: a mean of levels with equal weights has the least noise.
/// `per_bound`: 1 over the deviations between the two.
inline float weight_of(float off, float per_bound) {
    constexpr float kZero = kApart / (kApart - kMixes);
    return std::min(std::max(kZero - std::fabs(off) * per_bound, 0.0F), 1.0F);
}

/// The weighted mean of a pixel's differences from its reference.
struct Mean {
    float sum, weight, squares;

    void add(float level, float seen, float reference, float per_bound) {
        const float off = level - reference;
        const float more = seen * weight_of(off, per_bound);
        sum += more * off;
        weight += more;
        squares += more * off * off;
    }
    void add(float level, float reference, float per_bound) {
        add(level, 1.0F, reference, per_bound);
    }
};

inline float share_of(std::uint8_t filled) {
    return 1.0F - (1.0F - kFilledShare) * static_cast<float>(filled);
}

inline float weight_in_group(float off, float per_bound) {
    return weight_of(off, kGroupsApart * per_bound);
}

}  // namespace

DIBHR_VECTOR_CLONES void medians(const float* a, const float* b, const float* c, const float* d,
                                 const float* e, float* __restrict out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out[i] = median_of_five(a[i], b[i], c[i], d[i], e[i]);
}

DIBHR_VECTOR_CLONES void medians(const float* a, const float* b, const float* c,
                                 float* __restrict out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out[i] = median_of_three(a[i], b[i], c[i]);
}

DIBHR_VECTOR_CLONES void take_where_missing(const float* levels, const float* here,
                                            float* __restrict reference, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        reference[i] = levels[i] == FrameGroups::kNoLevel ? here[i] : reference[i];
}

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

DIBHR_VECTOR_CLONES void add_four(const Four& rows, const float* reference, const float* per_bound,
                                  float* __restrict sum, float* __restrict weights,
                                  float* __restrict squares, std::size_t count) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{sum[i], weights[i], squares[i]};
        mean.add(a[i], reference[i], per_bound[i]);
        mean.add(b[i], reference[i], per_bound[i]);
        mean.add(c[i], reference[i], per_bound[i]);
        mean.add(d[i], reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
        squares[i] = mean.squares;
    }
}

DIBHR_VECTOR_CLONES void add_four(const Four& rows, const FourFilled& filled,
                                  const float* reference, const float* per_bound,
                                  float* __restrict sum, float* __restrict weights,
                                  float* __restrict squares, std::size_t count) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
    const std::uint8_t *at_a = filled[0], *at_b = filled[1], *at_c = filled[2], *at_d = filled[3];
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{sum[i], weights[i], squares[i]};
        mean.add(a[i], share_of(at_a[i]), reference[i], per_bound[i]);
        mean.add(b[i], share_of(at_b[i]), reference[i], per_bound[i]);
        mean.add(c[i], share_of(at_c[i]), reference[i], per_bound[i]);
        mean.add(d[i], share_of(at_d[i]), reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
        squares[i] = mean.squares;
    }
}

DIBHR_VECTOR_CLONES void add_one(const float* levels, const float* reference,
                                 const float* per_bound, float* __restrict sum,
                                 float* __restrict weights, float* __restrict squares,
                                 std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{sum[i], weights[i], squares[i]};
        mean.add(levels[i], reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
        squares[i] = mean.squares;
    }
}

DIBHR_VECTOR_CLONES void add_one(const float* levels, const std::uint8_t* filled,
                                 const float* reference, const float* per_bound,
                                 float* __restrict sum, float* __restrict weights,
                                 float* __restrict squares, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{sum[i], weights[i], squares[i]};
        mean.add(levels[i], share_of(filled[i]), reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
        squares[i] = mean.squares;
    }
}

DIBHR_VECTOR_CLONES void add_near_frames(const Near& rows, const float* reference,
                                         const float* per_bound, float* __restrict sum,
                                         float* __restrict weights, float* __restrict squares,
                                         std::size_t count) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4], *f = rows[5];
    const float *g = rows[6], *h = rows[7], *k = rows[8], *l = rows[9], *m = rows[10];
    for (std::size_t i = 0; i < count; ++i) {
        Mean mean{0.0F, 0.0F, 0.0F};
        mean.add(a[i], reference[i], per_bound[i]);
        mean.add(b[i], reference[i], per_bound[i]);
        mean.add(c[i], reference[i], per_bound[i]);
        mean.add(d[i], reference[i], per_bound[i]);
        mean.add(e[i], reference[i], per_bound[i]);
        mean.add(f[i], reference[i], per_bound[i]);
        mean.add(g[i], reference[i], per_bound[i]);
        mean.add(h[i], reference[i], per_bound[i]);
        mean.add(k[i], reference[i], per_bound[i]);
        mean.add(l[i], reference[i], per_bound[i]);
        mean.add(m[i], reference[i], per_bound[i]);
        sum[i] = mean.sum;
        weights[i] = mean.weight;
        squares[i] = mean.squares;
    }
}

DIBHR_VECTOR_CLONES void add_group(const float* levels, float weight, const float* reference,
                                   const float* per_bound, float* __restrict sum,
                                   float* __restrict weights, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float off = levels[i] - reference[i];
        const float more = weight * weight_in_group(off, per_bound[i]);
        sum[i] += more * off;
        weights[i] += more;
    }
}

DIBHR_VECTOR_CLONES void add_four_groups(const Four& rows, const std::array<float, 4>& each,
                                         const float* reference, const float* per_bound,
                                         float* __restrict sum, float* __restrict weights,
                                         std::size_t count) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
    const float of_a = each[0], of_b = each[1], of_c = each[2], of_d = each[3];
    for (std::size_t i = 0; i < count; ++i) {
        float whole = sum[i];
        float all = weights[i];
        const auto add = [&](float level, float weight) {
            const float off = level - reference[i];
            const float more = weight * weight_in_group(off, per_bound[i]);
            whole += more * off;
            all += more;
        };
        add(a[i], of_a);
        add(b[i], of_b);
        add(c[i], of_c);
        add(d[i], of_d);
        sum[i] = whole;
        weights[i] = all;
    }
}

DIBHR_VECTOR_CLONES void add_differences(const float* levels, const float* reference,
                                         const float* per_bound, float* __restrict off,
                                         float* __restrict squared, float* __restrict counted,
                                         std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float by = levels[i] - reference[i];
        const float counts = weight_of(by, per_bound[i]);
        off[i] += counts * by;
        squared[i] += counts * by * by;
        counted[i] += counts;
    }
}

DIBHR_VECTOR_CLONES void add_misfit(const float* levels, const float* reference,
                                    const float* per_bound, float* __restrict squared,
                                    float* __restrict counted, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float counts = levels[i] == FrameGroups::kNoLevel ? 0.0F : 1.0F;
        const float off = std::min(std::fabs(levels[i] - reference[i]) * per_bound[i], kMostMisfit);
        squared[i] += counts * off * off;
        counted[i] += counts;
    }
}

DIBHR_VECTOR_CLONES void divide(const float* reference, const float* sum, const float* weights,
                                float* __restrict out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        out[i] = reference[i] + (weights[i] > 0.0F ? sum[i] / weights[i] : 0.0F);
}

DIBHR_VECTOR_CLONES void add_variances(const float* sum, const float* weights, const float* squares,
                                       float* __restrict variances, float* __restrict counted,
                                       std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float counts = weights[i] >= kLeastFrames ? 1.0F : 0.0F;
        const float weight = std::max(weights[i], kLeastFrames);
        const float whole = squares[i] - sum[i] * sum[i] / weight;
        variances[i] += counts * std::max(whole, 0.0F) / (weight - 1.0F);
        counted[i] += counts;
    }
}

}  // namespace dibhr::in_time
