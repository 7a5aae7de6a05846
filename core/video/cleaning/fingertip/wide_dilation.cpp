#include "core/video/cleaning/fingertip/wide_dilation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/video/cleaning/fingertip/levels.hpp"

namespace dibhr::fingertip {

namespace {

/// Radius of the first ball, in the pixel steps of the second.
constexpr double kSmoothSteps = 4.0;
// Rounding of levels that were raised: of a pixel, and of the level.
constexpr float kRounding_px = 0.01F;
constexpr float kRounding = 4e-6F;
/// A piece of the coarse surface has the shape of its own pixels and of those next to them, by
/// which it is convex.
constexpr int kBeside = 2;

/// Every `step`-th pixel in both directions, up to or beyond the last one.
void thin_out(const DepthImage& fine, int step, DepthImage& coarse) {
    coarse.columns = (fine.columns + step - 2) / step + 1;
    coarse.rows = (fine.rows + step - 2) / step + 1;
    coarse.highest_level = fine.highest_level;
    coarse.levels.resize(coarse.index(0, coarse.rows));
    for (int j = 0; j < coarse.rows; ++j)
        for (int i = 0; i < coarse.columns; ++i)
            coarse.at(i, j) =
                fine.at(std::min(i * step, fine.columns - 1), std::min(j * step, fine.rows - 1));
}

/// Calls `visit(first, end)` for each run of marks.
template <typename Visit>
void each_run(const std::uint8_t* marks, int count, Visit&& visit) {
    for (int k = 0; k < count; ++k) {
        if (marks[k] == 0) continue;
        const int first = k;
        while (k < count && marks[k] != 0) ++k;
        visit(first, k);
    }
}

}  // namespace

std::size_t WideDilation::Bound::at(int row) const {
    const int margin = (pitch_ - columns_) / 2;
    return static_cast<std::size_t>(std::ptrdiff_t{row + margin} * pitch_ + margin);
}

void WideDilation::Bound::find(const DepthImage& image, const DepthImage& thinned, int step,
                               const Ball& first) {
    columns_ = thinned.columns;
    rows_ = thinned.rows;
    const int margin = static_cast<int>((first.radius_px - 1.0) / step) + 1;
    pitch_ = columns_ + 2 * margin;
    const auto count =
        static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(rows_ + 2 * margin);
    levels_.assign(count, kNothing);
    highest_.assign(count, kNothing);
    find_highest(image, step);
    widen(first, step);
    const float slack = kRounding_px * first.levels_per_px;
    for (float& level : levels_) level += slack + kRounding * std::fabs(level);
    // The last thinned pixel of a row or column may be in the cell before it.
    for (int j = 0; j < rows_; ++j) {
        float* const last = levels_.data() + at(j) + columns_ - 1;
        *last = std::max(*last, last[-1]);
    }
    float* const last = levels_.data() + at(rows_ - 1);
    for (int i = 0; i < columns_; ++i) last[i] = std::max(last[i], last[i - pitch_]);
}

/// Of each cell.
void WideDilation::Bound::find_highest(const DepthImage& image, int step) {
    const auto count = static_cast<std::size_t>(image.columns);
    std::vector<float>& row = row_;
    std::vector<float> along(count + static_cast<std::size_t>(step));
    for (int top = 0; top < image.rows; top += step) {
        row.assign(along.size() + static_cast<std::size_t>(step), kNothing);
        for (int j = top; j < std::min(top + step, image.rows); ++j)
            raise_all(image.levels.data() + image.index(0, j), 0.0F, count, row.data());
        std::copy_n(row.data(), along.size(), along.data());
        for (int k = 1; k < step; ++k) raise_all(row.data() + k, 0.0F, count, along.data());
        float* const cells = highest_.data() + at(top / step);
        for (int i = 0; i < image.columns; i += step)
            cells[i / step] = along[static_cast<std::size_t>(i)];
    }
}

/// By the first ball: its fall at a distance is at least away^2 / (2 radius), and squares add up.
void WideDilation::Bound::widen(const Ball& first, int step) {
    const int margin = (pitch_ - columns_) / 2;
    const auto fall = [&](int cells) {
        const double away_px = step * std::max(std::abs(cells) - 1, 0);
        return static_cast<float>(away_px * away_px / (2.0 * first.radius_px) *
                                  double{first.levels_per_px});
    };
    const auto count = static_cast<std::size_t>(columns_);
    const auto pitch = static_cast<std::size_t>(pitch_);
    row_.resize(pitch);
    for (int j = 0; j < rows_; ++j) {
        std::fill(row_.begin(), row_.end(), kNothing);
        for (int away = -margin; away <= margin; ++away)
            raise_all(highest_.data() + at(j + away) - margin, fall(away), pitch, row_.data());
        for (int away = -margin; away <= margin; ++away)
            raise_all(row_.data() + margin + away, fall(away), count, levels_.data() + at(j));
    }
}

void WideDilation::dilate(const DepthImage& image, const Fingertip& finger, int step, float most,
                          DepthImage& result) {
    step_ = step;
    const double first_px = kSmoothSteps * step;
    const Fingertip first{first_px, finger.relief_px};
    const Fingertip rest{(finger.radius_px - first_px) / step, finger.relief_px / step};
    thin_out(image, step, coarse_);
    bound_.find(image, coarse_, step, Ball(first, image.highest_level));
    fine_.take(image, first);
    const Tiles touched = touched_by_rest(image, Ball(rest, image.highest_level));
    fine_.dilate(touched);
    find_coarse(image, rest, most);
    fine_.dilate(above_coarse(image));
    result.columns = image.columns;
    result.rows = image.rows;
    result.highest_level = image.highest_level;
    result.levels.resize(image.levels.size());
    raise_between(most, result);
}

/// Tiles that hold what the second ball may touch, and its neighbours. The first ball lowers
/// nothing, so the thinned image bounds where the second one rests.
Tiles WideDilation::touched_by_rest(const DepthImage& image, const Ball& rest) {
    const int columns = coarse_.columns;
    const int rows = coarse_.rows;
    lowest_.fit(columns, rows, static_cast<int>(rest.radius_px) + 1 + kPadding_px, kNothing);
    lowest_.copy(coarse_);
    squares_.find(lowest_, columns, rows, rest);
    grounds_.prepare(lowest_, 0, columns, rest, squares_, 0, rows);
    Tiles tiles(image.columns, image.rows);
    for (int j = 0; j < rows; ++j) {
        const int top = (j - kBeside) * step_;
        const int bottom = (j + kBeside) * step_ + 1;
        each_run(grounds_.in_reach(j, bound_.row(j)), columns, [&](int first, int end) {
            tiles.mark({(first - kBeside) * step_, (end - 1 + kBeside) * step_ + 1, top, bottom});
        });
    }
    return tiles;
}

/// Dilates the thinned image, whose levels the first ball has raised.
void WideDilation::find_coarse(const DepthImage& image, const Fingertip& rest, float most) {
    for (int j = 0; j < coarse_.rows; ++j) {
        const int row = std::min(j * step_, image.rows - 1);
        const float* const felt = fine_.felt(row);
        fine_.dilated().each_run(row, [&](int left, int right) {
            for (int i = (left + step_ - 1) / step_; i < coarse_.columns; ++i) {
                const int column = std::min(i * step_, image.columns - 1);
                if (column >= right) break;
                coarse_.at(i, j) = std::min(felt[column], most);
            }
        });
    }
    const std::size_t count = coarse_.levels.size();
    const float highest = range_of(coarse_.levels.data(), count, most).highest;
    second_.take(coarse_, rest);
    second_.dilate_all();
    copy_up_to(highest, second_.felt(0), count, coarse_.levels.data());
}

/// Tiles that the first ball may raise above the coarse image. Between its pixels that is no lower
/// than the lowest of the four around.
Tiles WideDilation::above_coarse(const DepthImage& image) const {
    Tiles tiles(image.columns, image.rows);
    const int columns = coarse_.columns;
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(columns));
    for (int j = 0; j < coarse_.rows; ++j) {
        const float* const upper = coarse_.levels.data() + coarse_.index(0, j);
        const float* const lower =
            coarse_.levels.data() + coarse_.index(0, std::min(j + 1, coarse_.rows - 1));
        const float* const bound = bound_.row(j);
        for (int i = 0; i < columns; ++i) {
            const int next = std::min(i + 1, columns - 1);
            const float lowest = std::min({upper[i], upper[next], lower[i], lower[next]});
            marks[static_cast<std::size_t>(i)] = bound[i] > lowest ? 1 : 0;
        }
        each_run(marks.data(), columns, [&](int first, int end) {
            tiles.mark({first * step_, end * step_, j * step_, (j + 1) * step_});
        });
    }
    return tiles;
}

/// Every pixel is between four pixels of the coarse image, or raised above by the first ball.
void WideDilation::raise_between(float most, DepthImage& result) {
    const auto count = static_cast<std::size_t>(result.columns);
    stretch(0, lower_);
    for (int j = 0; j < result.rows; ++j) {
        float* const row = result.levels.data() + result.index(0, j);
        const int above = j / step_;
        const int below = j % step_;
        if (below == 0) {
            std::swap(upper_, lower_);
            if (above + 1 < coarse_.rows) stretch(above + 1, lower_);
            std::copy_n(upper_.data(), count, row);
        } else {
            const float share = static_cast<float>(below) / static_cast<float>(step_);
            lerp_rows(upper_.data(), lower_.data(), share, count, row);
        }
        fine_.dilated().each_run(j, [&](int left, int right) {
            raise_up_to(most, fine_.felt(j) + left, static_cast<std::size_t>(right - left),
                        row + left);
        });
    }
}

/// A row of the coarse image, at the columns of the fine one.
void WideDilation::stretch(int coarse_row, std::vector<float>& levels) const {
    const float* const from = coarse_.levels.data() + coarse_.index(0, coarse_row);
    const auto cells = static_cast<std::size_t>(coarse_.columns - 1);
    const auto step = static_cast<std::size_t>(step_);
    levels.resize(cells * step + 1);
    std::vector<float> between(cells);
    for (std::size_t k = 0; k < step; ++k) {
        const float share = static_cast<float>(k) / static_cast<float>(step_);
        lerp_rows(from, from + 1, share, cells, between.data());
        for (std::size_t i = 0; i < cells; ++i) levels[i * step + k] = between[i];
    }
    levels.back() = from[cells];
}

}  // namespace dibhr::fingertip
