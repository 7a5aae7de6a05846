#include "core/video/cleaning/fingertip/tiles.hpp"

#include <cstdint>
#include <numeric>

namespace dibhr::fingertip {

namespace {

constexpr double kStart_px = 2000.0;  ///< an area is begun in the time of so many pixels
constexpr double kOfGrounds = 0.15;   ///< of a pixel's time

struct Cost {
    int reach_px;

    [[nodiscard]] double of(const Area& area) const {
        const double around_px =
            1.0 * (area.columns() + 2 * reach_px) * (area.rows() + 2 * reach_px);
        return kStart_px + kOfGrounds * around_px +
               (1.0 - kOfGrounds) * area.columns() * area.rows();
    }
};

Area around_both(const Area& a, const Area& b) {
    return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top),
            std::max(a.bottom, b.bottom)};
}

bool overlap(const Area& a, const Area& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// Adds an area; those that are cheaper together become one.
void add(Area area, const Cost& cost, std::vector<Area>& areas) {
    for (std::size_t k = 0; k < areas.size();) {
        const Area both = around_both(area, areas[k]);
        if (!overlap(area, areas[k]) && cost.of(both) > cost.of(area) + cost.of(areas[k])) {
            ++k;
            continue;
        }
        area = both;
        areas[k] = areas.back();
        areas.pop_back();
        k = 0;
    }
    areas.push_back(area);
}

}  // namespace

Tiles::Tiles(int columns, int rows)
    : columns_(columns),
      rows_(rows),
      across_((columns + kSide_px - 1) / kSide_px),
      down_((rows + kSide_px - 1) / kSide_px),
      marks_(at(0, down_), 0) {}

void Tiles::mark(const Area& area) {
    const int left = std::max(area.left, 0) / kSide_px;
    const int right = (std::min(area.right, columns_) + kSide_px - 1) / kSide_px;
    const int bottom = (std::min(area.bottom, rows_) + kSide_px - 1) / kSide_px;
    for (int y = std::max(area.top, 0) / kSide_px; y < bottom; ++y)
        for (int x = left; x < right; ++x) marks_[at(x, y)] = 1;
}

void Tiles::mark(const Tiles& others) {
    for (std::size_t k = 0; k < marks_.size(); ++k)
        marks_[k] = static_cast<std::uint8_t>(marks_[k] | others.marks_[k]);
}

void Tiles::unmark(const Tiles& others) {
    for (std::size_t k = 0; k < marks_.size(); ++k)
        marks_[k] = static_cast<std::uint8_t>(marks_[k] & (1 - others.marks_[k]));
}

void Tiles::keep_rows(int top, int bottom) {
    std::fill(marks_.begin(), marks_.begin() + static_cast<std::ptrdiff_t>(at(0, top / kSide_px)),
              std::uint8_t{0});
    const int end = (bottom + kSide_px - 1) / kSide_px;
    std::fill(marks_.begin() + static_cast<std::ptrdiff_t>(at(0, end)), marks_.end(),
              std::uint8_t{0});
}

int Tiles::count() const {
    return std::accumulate(marks_.begin(), marks_.end(), 0);
}

int Tiles::middle_row() const {
    const int all = count();
    int above = 0;
    for (std::size_t k = 0; k < marks_.size(); ++k) {
        above += marks_[k];
        if (2 * above >= all) return static_cast<int>(k) / across_ * kSide_px;
    }
    return 0;
}

void Tiles::widen(int more_px) {
    const std::vector<std::uint8_t> before = marks_;
    for (int y = 0; y < down_; ++y)
        for (int x = 0; x < across_; ++x)
            if (before[at(x, y)] != 0)
                mark({x * kSide_px - more_px, (x + 1) * kSide_px + more_px, y * kSide_px - more_px,
                      (y + 1) * kSide_px + more_px});
}

std::vector<Area> Tiles::areas(int reach_px) const {
    std::vector<Area> areas;
    for (int top = 0; top < rows_; top += kSide_px) {
        const int bottom = std::min(top + kSide_px, rows_);
        each_run(top, [&](int left, int right) {
            add({left, right, top, bottom}, Cost{reach_px}, areas);
        });
    }
    return areas;
}

}  // namespace dibhr::fingertip
