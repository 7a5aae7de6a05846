// Pixels sent on their way, the nearest last.
#include "core/video/motion/motion_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dibhr {

namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();
constexpr float kSameWay_px = 1.0F;              // parts of one thing differ by less
constexpr float kOfOneSurface = 12.0F / 255.0F;  // of the highest level
constexpr int kGap_px = 8;                       // the widest that is mended from its rim
constexpr int kReach_px = 48;                    // how far to look for what goes on behind

int rounded(float value) {
    return static_cast<int>(std::floor(value + 0.5F));
}

bool is_same(const MotionField::Way& a, const MotionField::Way& b) {
    return std::fabs(a.right - b.right) < kSameWay_px && std::fabs(a.down - b.down) < kSameWay_px;
}

}  // namespace

Course::Course(const MotionField& motion, const DepthImage& first, const DepthImage& second)
    : motion_(motion), first_(first), second_(second) {
    find_box();
    const auto count = static_cast<std::size_t>(box_.right - box_.left) *
                       static_cast<std::size_t>(box_.bottom - box_.top);
    pixels_.resize(count);
    nearest_.resize(count);
    covered_.assign(count, 0);
    send_first(1.0F);
    find_covered();
    find_uncovered();
}

MotionField::Way Course::way_of(int i, int j) const {
    const MotionField::Way& way = motion_.at(i, j);
    const float squared = way.right * way.right + way.down * way.down;
    return squared < kShortestWay_px * kShortestWay_px ? MotionField::Way{} : way;
}

/// Around all that moves, and where it goes.
void Course::find_box() {
    Box box{motion_.columns, motion_.rows, 0, 0};
    for (int j = 0; j < motion_.rows; ++j)
        for (int i = 0; i < motion_.columns; ++i) {
            const MotionField::Way way = way_of(i, j);
            if (way == MotionField::Way{}) continue;
            const int x = i + rounded(way.right);
            const int y = j + rounded(way.down);
            box.left = std::min({box.left, i, x});
            box.top = std::min({box.top, j, y});
            box.right = std::max({box.right, i + 1, x + 1});
            box.bottom = std::max({box.bottom, j + 1, y + 1});
        }
    box_ = {std::max(box.left - 1, 0), std::max(box.top - 1, 0),
            std::min(box.right + 1, motion_.columns), std::min(box.bottom + 1, motion_.rows)};
}

/// What is nearest of the first image shows.
void Course::send_first(float share) {
    std::fill(nearest_.begin(), nearest_.end(), kNothing);
    for (int j = box_.top; j < box_.bottom; ++j)
        for (int i = box_.left; i < box_.right; ++i) {
            const std::size_t from = first_.index(i, j);
            const MotionField::Way way = way_of(i, j);
            const int x = i + rounded(share * way.right);
            const int y = j + rounded(share * way.down);
            if (!is_inside(x, y)) continue;
            const float level = first_.levels[from];
            const std::size_t to = index(x, y);
            if (!(level > nearest_[to])) continue;
            nearest_[to] = level;
            const bool covered = covered_[index(i, j)] != 0;
            const bool stays = way == MotionField::Way{};
            pixels_[to] = {way, level,
                           covered ? Shows::first : (stays ? Shows::as_it_was : Shows::both)};
        }
}

/// Something else is there at the end.
void Course::find_covered() {
    for (int j = box_.top; j < box_.bottom; ++j)
        for (int i = box_.left; i < box_.right; ++i) {
            const MotionField::Way way = way_of(i, j);
            const int x = i + rounded(way.right);
            const int y = j + rounded(way.down);
            if (!is_inside(x, y)) continue;
            covered_[index(i, j)] = is_same(pixels_[index(x, y)].way, way) ? 0 : 1;
        }
}

/// Nothing came there; where two neighbours that are alike did, it came with them.
void Course::find_uncovered() {
    const float alike = kOfOneSurface * static_cast<float>(second_.highest_level);
    const auto came = [&](int i, int j, float level) {
        return is_inside(i, j) && nearest_[index(i, j)] != kNothing &&
               std::fabs(second_.at(i, j) - level) < alike;
    };
    for (int j = box_.top; j < box_.bottom; ++j)
        for (int i = box_.left; i < box_.right; ++i) {
            if (nearest_[index(i, j)] != kNothing) continue;
            const float level = second_.at(i, j);
            const bool in_row = came(i - 1, j, level) && came(i + 1, j, level);
            const bool in_column = came(i, j - 1, level) && came(i, j + 1, level);
            if (!in_row && !in_column) uncovered_.push_back({i, j, way_beside(i, j)});
        }
}

/// Of what is alike and nearest in the pixel's row or column of the second image, and was in the
/// first; none: it stays.
MotionField::Way Course::way_beside(int i, int j) const {
    const float level = second_.at(i, j);
    const float alike = kOfOneSurface * static_cast<float>(second_.highest_level);
    for (int away = 1; away <= kReach_px; ++away)
        for (const auto& [right, down] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            const int x = i + away * right;
            const int y = j + away * down;
            if (!is_inside(x, y) || nearest_[index(x, y)] == kNothing) continue;
            if (std::fabs(second_.at(x, y) - level) < alike) return pixels_[index(x, y)].way;
        }
    return {};
}

/// Only where nothing of the first image shows.
void Course::send_second(float share) {
    for (const Uncovered& from : uncovered_) {
        const int x = from.i - rounded((1.0F - share) * from.way.right);
        const int y = from.j - rounded((1.0F - share) * from.way.down);
        if (!is_inside(x, y)) continue;
        Pixel& pixel = pixels_[index(x, y)];
        const float level = second_.at(from.i, from.j);
        float& nearest = nearest_[index(x, y)];
        if (nearest != kNothing && (pixel.shows != Shows::second || !(level > nearest))) continue;
        nearest = level;
        pixel = {from.way, level, Shows::second};
    }
}

/// What is left goes on from the farther side of the gap; a crack is as what it is in.
void Course::mend() {
    const int columns = box_.right - box_.left;
    for (int j = box_.top; j < box_.bottom; ++j)
        for (int i = 0; i < columns; ++i) {
            const std::size_t row = index(box_.left, j);
            const auto at = [row](int column) { return row + static_cast<std::size_t>(column); };
            if (nearest_[at(i)] != kNothing) continue;
            int end = i;
            while (end < columns && nearest_[at(end)] == kNothing) ++end;
            const bool left = i > 0 && end - i <= kGap_px;
            const bool right = end < columns && end - i <= kGap_px;
            const bool from_left = left && (!right || nearest_[at(i - 1)] <= nearest_[at(end)]);
            const Pixel beside = from_left ? pixels_[at(i - 1)]
                                 : right   ? pixels_[at(end)]
                                           : Pixel{};
            for (int k = i; k < end; ++k) {
                pixels_[at(k)] = beside;
                nearest_[at(k)] = beside.level;
            }
            i = end;
        }
}

void Course::go(float share) {
    send_first(share);
    send_second(share);
    mend();
}

}  // namespace dibhr
