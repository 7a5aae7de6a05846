#include "core/video/cleaning/fingertip/edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/video/cleaning/fingertip/narrowing.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr::fingertip {

namespace {

constexpr int kWide = 10;  ///< an EDGE over more lines than this is narrowed

/// Flags EDGEs that the ball touches: convex ones in reach, with a line between the ball's centres
/// over the TRIANGLEs before and after.
DIBHR_VECTOR_CLONES void flag_touched(const float* __restrict before, const float* __restrict after,
                                      const std::uint8_t* __restrict begin_in_reach,
                                      const std::uint8_t* __restrict end_in_reach,
                                      std::size_t count, std::uint8_t* __restrict flags) {
    for (std::size_t i = 0; i < count; ++i) {
        const int convex = after[i] > before[i] ? 1 : 0;
        const auto last = static_cast<float>(round_down(after[i] + kOverlap_px));
        const int any = last >= before[i] - kOverlap_px ? 1 : 0;
        flags[i] = static_cast<std::uint8_t>(convex & any & (begin_in_reach[i] | end_in_reach[i]));
    }
}

DIBHR_VECTOR_CLONES void flag_wide(const int* __restrict first, const int* __restrict last,
                                   std::size_t count, std::uint8_t* __restrict flags) {
    for (std::size_t k = 0; k < count; ++k)
        flags[k] = static_cast<std::uint8_t>(last[k] - first[k] >= kWide ? 1 : 0);
}

struct Leaning {
    const float* begins;
    const float* ends;
    const float* before;
    const float* after;
    float slope_per_level;
    int last_line;
};

/// Levels and slopes of the EDGEs of these numbers, and the lines between the TRIANGLEs beside.
DIBHR_VECTOR_CLONES void lean(const Leaning& all, const int* __restrict number, std::size_t count,
                              float* __restrict begin, float* __restrict rise,
                              float* __restrict sine, float* __restrict cosine,
                              int* __restrict first, int* __restrict last) {
    const Leaning of = all;
    for (std::size_t k = 0; k < count; ++k) {
        const int i = number[k];
        begin[k] = of.begins[i];
        rise[k] = of.ends[i] - of.begins[i];
        const float slope = rise[k] * of.slope_per_level;
        const float c = 1.0F / std::sqrt(1.0F + slope * slope);
        cosine[k] = c;
        sine[k] = slope * c;
        const int from = round_up(of.before[i] - kOverlap_px);
        const int to = round_down(of.after[i] + kOverlap_px);
        first[k] = from > -of.last_line ? from : -of.last_line;
        last[k] = to < of.last_line ? to : of.last_line;
    }
}

/// EDGEs parallel to each one, at a distance of at most the ball's radius.
struct Across {
    const float* begins;
    const float* ends;
    const float* other_begins;
    const float* other_ends;
    float px_per_level;
    float lines_per_px;
    Neighbour neighbour;
};

/// Most lines on the side of the parallel EDGE over which the ball does not enter that EDGE.
[[gnu::always_inline]] inline int most_lines(const Across& of, int i, float cosine) {
    const float rise_begin = of.other_begins[i] - of.begins[i];
    const float rise_end = of.other_ends[i] - of.ends[i];
    const float rise = rise_begin < rise_end ? rise_begin : rise_end;
    const float lean = of.neighbour.most_lean(rise * of.px_per_level, cosine);
    return round_down(lean * of.lines_per_px + kOverlap_px);
}

/// Limits the last line on that side, counted away from each EDGE.
DIBHR_VECTOR_CLONES void narrow_side(const Across& across, const int* __restrict number,
                                     const float* __restrict cosine, std::size_t count,
                                     int* __restrict last) {
    const Across of = across;
    for (std::size_t k = 0; k < count; ++k) {
        const int most = most_lines(of, number[k], cosine[k]);
        last[k] = last[k] < most ? last[k] : most;
    }
}

struct LineTable {
    const float* shifts;
    const float* reach;
    const float* height;
    const int* steps;
    int along_line;
    float radius_levels;
};

/// Of each line the pixel for which the ball touches the EDGE itself, and the ball's level there.
DIBHR_VECTOR_CLONES std::size_t touch(const LineTable& table, const TouchedEdges& edges,
                                      float* __restrict levels, int* __restrict to) {
    const LineTable lines = table;
    std::size_t count = 0;
    for (std::size_t k = 0; k < edges.count; ++k) {
        const float begin = edges.begin[k];
        const float rise = edges.rise[k];
        const float sine = edges.sine[k];
        const float cosine = edges.cosine[k];
        const int number = edges.number[k];
        const int last = edges.last[k];
        int first = edges.first[k];
        for (; first <= last; first += kAtOnce) {
            for (int l = 0; l < kAtOnce; ++l) {
                const int line = first + l;
                const float from = lines.shifts[line] - lines.reach[line] * sine;
                const int along = round_up(from);
                const float share = static_cast<float>(along) - from;
                levels[count + static_cast<std::size_t>(l)] =
                    begin + rise * share - (lines.radius_levels - lines.height[line] * cosine);
                to[count + static_cast<std::size_t>(l)] =
                    number + along * lines.along_line + lines.steps[line];
            }
            const int left = last - first + 1;
            count += static_cast<std::size_t>(left < kAtOnce ? left : kAtOnce);
        }
    }
    return count;
}

DIBHR_VECTOR_CLONES void raise_pixels(const float* __restrict levels, const int* __restrict to,
                                      std::size_t count, float* __restrict origin) {
    for (std::size_t n = 0; n < count; ++n) {
        float& level = origin[to[n]];
        level = level > levels[n] ? level : levels[n];
    }
}

}  // namespace

EdgeFamily edges_in_rows(int pitch) {
    return {1.0, 1, pitch, 1.0, 1.0, 0.0, 1, pitch};
}

EdgeFamily edges_in_columns(int pitch) {
    return {1.0, pitch, 1, 1.0, 1.0, 0.0, pitch, 1};
}

EdgeFamily diagonal_edges(int pitch) {
    const double diagonal_px = std::sqrt(2.0);
    return {diagonal_px, pitch - 1, pitch + 1, diagonal_px, 0.5 * diagonal_px, 0.5, pitch - 1, 1};
}

void Lines::lay(const Ball& ball, const EdgeFamily& family) {
    last = static_cast<int>(ball.radius_px / family.line_px);
    shifts.clear();
    reach.clear();
    height.clear();
    steps.clear();
    for (int k = -last; k <= last; ++k) {
        const double height_px = ball.height_px(k * family.line_px);
        steps.push_back(k * static_cast<int>(family.to_line));
        shifts.push_back(static_cast<float>(k * family.line_shift));
        reach.push_back(static_cast<float>(height_px / family.length_px));
        height.push_back(static_cast<float>(height_px * double{ball.levels_per_px}));
    }
    for (std::vector<float>* of : {&shifts, &reach, &height}) of->insert(of->end(), kAtOnce, 0.0F);
    steps.insert(steps.end(), kAtOnce, 0);
}

void TouchedEdges::make_room(std::size_t most) {
    for (std::vector<float>* of : {&begin, &rise, &sine, &cosine}) of->resize(most);
    for (std::vector<int>* of : {&number, &first, &last}) of->resize(most);
}

void EdgePass::prepare(const Ball& ball, const EdgeFamily& family, int most) {
    ball_ = ball;
    family_ = family;
    lines_.lay(ball, family);
    const auto count = static_cast<std::size_t>(most);
    edges_.make_room(whole_flags(count));
    wide_.make_room(whole_flags(count));
    wide_at_.resize(whole_flags(count));
    const std::size_t lines = 2 * static_cast<std::size_t>(lines_.last) + 1;
    levels_.resize(std::max(levels_.size(), count * lines + kAtOnce));
    to_.resize(levels_.size());
}

void EdgePass::raise(const float* before, const float* after, const float* begins,
                     const std::uint8_t* begin_in_reach, const std::uint8_t* end_in_reach,
                     std::size_t count, float* origin) {
    flags_.assign(whole_flags(count), 0);
    flag_touched(before, after, begin_in_reach, end_in_reach, count, flags_.data());
    find(before, after, begins);
    narrow_wide(begins);
    const auto middle = static_cast<std::size_t>(lines_.last);
    const LineTable table{lines_.shifts.data() + middle,        lines_.reach.data() + middle,
                          lines_.height.data() + middle,        lines_.steps.data() + middle,
                          static_cast<int>(family_.along_line), ball_.radius_levels};
    const std::size_t lines = touch(table, edges_, levels_.data(), to_.data());
    raise_pixels(levels_.data(), to_.data(), lines, origin);
}

void EdgePass::find(const float* before, const float* after, const float* begins) {
    const float* const ends = begins + family_.to_end;
    edges_.count = number_flagged(flags_, edges_.number.data());
    const Leaning all{
        begins,     ends, before, after, ball_.px_per_level / static_cast<float>(family_.length_px),
        lines_.last};
    lean(all, edges_.number.data(), edges_.count, edges_.begin.data(), edges_.rise.data(),
         edges_.sine.data(), edges_.cosine.data(), edges_.first.data(), edges_.last.data());
}

/// EDGEs over many lines are narrowed by neighbours. Meanwhile the first line is counted away from
/// the EDGE, as the last one is.
void EdgePass::narrow_wide(const float* begins) {
    is_wide_.assign(whole_flags(edges_.count), 0);
    flag_wide(edges_.first.data(), edges_.last.data(), edges_.count, is_wide_.data());
    wide_.count = number_flagged(is_wide_, wide_at_.data());
    if (wide_.count == 0) return;
    for (std::size_t w = 0; w < wide_.count; ++w) {
        const auto k = static_cast<std::size_t>(wide_at_[w]);
        wide_.number[w] = edges_.number[k];
        wide_.cosine[w] = edges_.cosine[k];
        wide_.first[w] = -edges_.first[k];
        wide_.last[w] = edges_.last[k];
    }
    for (const int distance : kDistances)
        if (distance <= ball_.radius_px) narrow(begins, distance);
    for (std::size_t w = 0; w < wide_.count; ++w) {
        const auto k = static_cast<std::size_t>(wide_at_[w]);
        edges_.first[k] = -wide_.first[w];
        edges_.last[k] = wide_.last[w];
    }
}

void EdgePass::narrow(const float* begins, int distance) {
    const std::ptrdiff_t aside = distance * family_.aside;
    Across across{begins,
                  begins + family_.to_end,
                  begins + aside,
                  begins + aside + family_.to_end,
                  ball_.px_per_level,
                  static_cast<float>(1.0 / family_.line_px),
                  Neighbour(distance * family_.aside_px, ball_)};
    narrow_side(across, wide_.number.data(), wide_.cosine.data(), wide_.count, wide_.last.data());
    across.other_begins = begins - aside;
    across.other_ends = begins - aside + family_.to_end;
    narrow_side(across, wide_.number.data(), wide_.cosine.data(), wide_.count, wide_.first.data());
}

}  // namespace dibhr::fingertip
