// Which parts of an image are to be dilated: squares of pixels, and the areas that they make.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dibhr::fingertip {

/// Pixels from `left` to before `right`, and so on.
struct Area {
    int left, right, top, bottom;

    [[nodiscard]] int columns() const { return right - left; }
    [[nodiscard]] int rows() const { return bottom - top; }
    /// With as many more pixels on all sides, as far as they are in an image of that size.
    [[nodiscard]] Area widened(int more, int columns, int rows) const {
        return {std::max(left - more, 0), std::min(right + more, columns), std::max(top - more, 0),
                std::min(bottom + more, rows)};
    }
};

/// The tiles of an image, each marked or not.
class Tiles {
  public:
    static constexpr int kSide_px = 16;

    Tiles() = default;
    /// None is marked.
    Tiles(int columns, int rows);

    void mark_all() { std::fill(marks_.begin(), marks_.end(), std::uint8_t{1}); }
    /// All that have pixels of the area, which may reach beyond the image.
    void mark(const Area& area);
    /// Those that are marked in tiles of an image of the same size.
    void mark(const Tiles& others);
    void unmark(const Tiles& others);
    /// Unmarks those outside of rows from `top` to before `bottom`, the height of whole tiles.
    void keep_rows(int top, int bottom);
    /// Marks those that have pixels so near to a marked one, too.
    void widen(int more_px);

    /// Areas that are apart and hold all marked tiles, so that raising pixels by their pieces takes
    /// little time: of each the grounds are found in the ball's reach around, too.
    [[nodiscard]] std::vector<Area> areas(int reach_px) const;
    /// The middle of all marked tiles from top to bottom, between two rows of tiles [px]; 0: none
    /// is marked.
    [[nodiscard]] int middle_row() const;
    [[nodiscard]] int count() const;

    /// Calls `visit(left, right)` for each run of marked tiles over a row of pixels.
    template <typename Visit>
    void each_run(int row, Visit&& visit) const {
        const std::uint8_t* const marks = marks_.data() + at(0, row / kSide_px);
        for (int x = 0; x < across_; ++x) {
            if (marks[x] == 0) continue;
            const int first = x;
            while (x < across_ && marks[x] != 0) ++x;
            visit(first * kSide_px, std::min(x * kSide_px, columns_));
        }
    }

  private:
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) +
               static_cast<std::size_t>(x);
    }

    int columns_{0}, rows_{0}, across_{0}, down_{0};
    std::vector<std::uint8_t> marks_{};
};

}  // namespace dibhr::fingertip
