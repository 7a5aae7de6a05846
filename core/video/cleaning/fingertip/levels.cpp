#include "core/video/cleaning/fingertip/levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr::fingertip {

DIBHR_VECTOR_CLONES LevelRange range_of(const float* __restrict levels, std::size_t count,
                                        float most) {
    constexpr std::size_t kLanes = 16;
    std::array<float, kLanes> highest;
    std::array<int, kLanes> beyond{};
    highest.fill(levels[0]);
    for (std::size_t i = 0; i + kLanes <= count; i += kLanes) {
        for (std::size_t l = 0; l < kLanes; ++l) {
            const float level = levels[i + l];
            highest[l] = highest[l] > level ? highest[l] : level;
            beyond[l] |= std::fabs(level) <= most ? 0 : 1;
        }
    }
    for (std::size_t i = count - count % kLanes; i < count; ++i) {
        highest[0] = highest[0] > levels[i] ? highest[0] : levels[i];
        beyond[0] |= std::fabs(levels[i]) <= most ? 0 : 1;
    }
    return {*std::max_element(highest.begin(), highest.end()),
            *std::max_element(beyond.begin(), beyond.end()) == 0};
}

DIBHR_VECTOR_CLONES void copy_up_to(float most, const float* __restrict from, std::size_t count,
                                    float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = from[i] < most ? from[i] : most;
}

DIBHR_VECTOR_CLONES void raise_up_to(float most, const float* __restrict others, std::size_t count,
                                     float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) {
        const float other = others[i] < most ? others[i] : most;
        to[i] = other > to[i] ? other : to[i];
    }
}

DIBHR_VECTOR_CLONES void raise_all(const float* __restrict others, float fall, std::size_t count,
                                   float* __restrict all) {
    for (std::size_t i = 0; i < count; ++i) {
        const float other = others[i] - fall;
        all[i] = other > all[i] ? other : all[i];
    }
}

DIBHR_VECTOR_CLONES void lerp_rows(const float* __restrict a, const float* __restrict b,
                                   float share, std::size_t count, float* __restrict between) {
    for (std::size_t i = 0; i < count; ++i) {
        const float from = a[i];
        const float to = b[i];
        const float line = from + share * (to - from);
        const float lower = to > line ? line : to;
        const float higher = to < line ? line : to;
        const float weighed = share * to + (1.0F - share) * from;
        const bool around_0 = (from <= 0.0F && to >= 0.0F) || (from >= 0.0F && to <= 0.0F);
        between[i] = around_0 ? weighed : to > from ? lower : higher;
    }
}

}  // namespace dibhr::fingertip
