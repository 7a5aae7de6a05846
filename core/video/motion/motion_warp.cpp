// Moves pixels along their ways, the nearest visible; then fills gaps and refines outlines.
#include "core/video/motion/motion_warp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();
constexpr float kSameWay_px = 1.0F;              // ways of one object differ by less
constexpr float kOfOneSurface = 12.0F / 255.0F;  // of the highest level
constexpr int kGap_px = 8;                       // widest gap that is filled from its rim
constexpr int kReach_px = 48;                    // how far the continued background is searched

int rounded(float value) {
    return static_cast<int>(std::floor(value + 0.5F));
}

struct Starts {
    const std::int32_t *x, *y;
    const float *right, *down;
};

DIBHR_VECTOR_CLONES void find_places_of(const Starts& from, float share, int columns, int rows,
                                        std::int32_t* __restrict places, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        const int x = from.x[k] + static_cast<int>(std::floor(share * from.right[k] + 0.5F));
        const int y = from.y[k] + static_cast<int>(std::floor(share * from.down[k] + 0.5F));
        const bool inside = x >= 0 && y >= 0 && x < columns && y < rows;
        places[k] = inside ? y * columns + x : -1;
    }
}

/// The pixels of a row around a place, with weights that fall to both sides.
struct Tent {
    Tent(float place, int count)
        : middle(std::clamp(place, 0.0F, static_cast<float>(count - 1))),
          begin(std::max(static_cast<int>(middle) - kReach + 1, 0)),
          end(std::min(static_cast<int>(middle) + kReach + 1, count)) {}
    [[nodiscard]] float at(int k) const {
        return static_cast<float>(kReach) - std::fabs(static_cast<float>(k) - middle);
    }

    static constexpr int kReach = 3;  // [px]
    float middle;
    int begin, end;
};

bool is_moving(const MotionField::Way& way) {
    return way.right * way.right + way.down * way.down >= kShortestWay_px * kShortestWay_px;
}

bool is_same(const MotionField::Way& a, const MotionField::Way& b) {
    return std::fabs(a.right - b.right) < kSameWay_px && std::fabs(a.down - b.down) < kSameWay_px;
}

}  // namespace

void MotionWarp::Movers::clear() {
    for (auto* const values : {&right, &down, &level}) values->clear();
    for (auto* const values : {&x, &y}) values->clear();
    visibility.clear();
}

void MotionWarp::begin(const MotionField& motion, const DepthImage& first,
                       const DepthImage& second) {
    motion_ = &motion;
    first_ = &first;
    second_ = &second;
    movers_.clear();
    find_box();
    find_movers();
    first_movers_ = movers_.x.size();
    warp_first(1.0F);
    find_covered();
    first_movers_ = movers_.x.size();
    find_uncovered();
}

/// The box around all moving pixels and their destinations.
void MotionWarp::find_box() {
    PixelBox box{motion_->columns, motion_->rows, 0, 0};
    for (int j = 0; j < motion_->rows; ++j)
        for (int i = 0; i < motion_->columns; ++i) {
            const MotionField::Way way = motion_->at(i, j);
            if (!is_moving(way)) continue;
            const int x = i + rounded(way.right);
            const int y = j + rounded(way.down);
            box.left = std::min({box.left, i, x});
            box.top = std::min({box.top, j, y});
            box.right = std::max({box.right, i + 1, x + 1});
            box.bottom = std::max({box.bottom, j + 1, y + 1});
        }
    box_ = {std::max(box.left - 1, 0), std::max(box.top - 1, 0),
            std::min(box.right + 1, motion_->columns), std::min(box.bottom + 1, motion_->rows)};
    columns_ = std::max(box_.right - box_.left, 0);
    rows_ = std::max(box_.bottom - box_.top, 0);
}

std::uint32_t MotionWarp::add_mover(int i, int j, MotionField::Way way, float level,
                                    Visibility visibility) {
    movers_.x.push_back(i - box_.left);
    movers_.y.push_back(j - box_.top);
    movers_.right.push_back(way.right);
    movers_.down.push_back(way.down);
    movers_.level.push_back(level);
    movers_.visibility.push_back(visibility);
    return static_cast<std::uint32_t>(movers_.x.size() - 1);
}

void MotionWarp::find_movers() {
    still_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (const Visibility visibility : {Visibility::unmoved, Visibility::first, Visibility::second})
        add_mover(box_.left, box_.top, {}, 0.0F, visibility);
    for (int j = box_.top; j < box_.bottom; ++j)
        for (int i = box_.left; i < box_.right; ++i) {
            const MotionField::Way way = motion_->at(i, j);
            const std::uint32_t here = index(i, j);
            const bool goes = is_moving(way);
            still_[here] = {goes ? kNothing : first_->at(i, j), kStays};
            if (goes) add_mover(i, j, way, first_->at(i, j), Visibility::both);
        }
}

/// Destinations of entries [begin, end), at a share of their ways.
void MotionWarp::find_places(float share, std::size_t begin, std::size_t end) {
    places_.resize(movers_.x.size());
    find_places_of({movers_.x.data() + begin, movers_.y.data() + begin,
                    movers_.right.data() + begin, movers_.down.data() + begin},
                   share, columns_, rows_, places_.data() + begin, end - begin);
}

/// Moves the first image's pixels; the nearest one is visible.
void MotionWarp::warp_first(float share) {
    seen_ = still_;
    find_places(share, kFirstMover, first_movers_);
    for (std::size_t k = kFirstMover; k < first_movers_; ++k) {
        if (places_[k] < 0) continue;
        const float level = movers_.level[k];
        Seen& seen = seen_[static_cast<std::size_t>(places_[k])];
        if (level > seen.level) seen = {level, static_cast<std::uint32_t>(k)};
    }
}

/// Marks pixels of the first image that something else covers in the second.
void MotionWarp::find_covered() {
    for (std::size_t k = kFirstMover; k < first_movers_; ++k) {
        if (places_[k] < 0) continue;
        const Seen& seen = seen_[static_cast<std::size_t>(places_[k])];
        if (!is_same(movers_.way(seen.mover), movers_.way(k)))
            movers_.visibility[k] = Visibility::first;
    }
    for (int j = box_.top; j < box_.bottom; ++j)
        for (int i = box_.left; i < box_.right; ++i) {
            Seen& still = still_[index(i, j)];
            if (still.level != kNothing && !is_same(movers_.way(seen_[index(i, j)].mover), {}))
                still.mover = add_mover(i, j, {}, still.level, Visibility::first);
        }
}

/// Adds pixels of the second image to which none moves, except between two such neighbours alike.
void MotionWarp::find_uncovered() {
    const float alike = kOfOneSurface * static_cast<float>(second_->highest_level);
    const auto came = [&](int i, int j, float level) {
        return is_inside(i, j) && seen_[index(i, j)].level != kNothing &&
               std::fabs(second_->at(i, j) - level) < alike;
    };
    for (int j = box_.top; j < box_.bottom; ++j)
        for (int i = box_.left; i < box_.right; ++i) {
            if (seen_[index(i, j)].level != kNothing) continue;
            const float level = second_->at(i, j);
            const bool in_row = came(i - 1, j, level) && came(i + 1, j, level);
            const bool in_column = came(i, j - 1, level) && came(i, j + 1, level);
            if (!in_row && !in_column) add_mover(i, j, way_beside(i, j), level, Visibility::second);
        }
}

/// The way of the nearest pixel in the row or column of the second image that is alike in depth and
/// is in the first image, too. None: no motion.
MotionField::Way MotionWarp::way_beside(int i, int j) const {
    const float level = second_->at(i, j);
    const float alike = kOfOneSurface * static_cast<float>(second_->highest_level);
    for (int away = 1; away <= kReach_px; ++away)
        for (const auto& [right, down] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            const int x = i + away * right;
            const int y = j + away * down;
            if (!is_inside(x, y) || seen_[index(x, y)].level == kNothing) continue;
            if (std::fabs(second_->at(x, y) - level) < alike)
                return movers_.way(seen_[index(x, y)].mover);
        }
    return {};
}

/// Moves the second image's pixels to places without a pixel of the first.
void MotionWarp::warp_second(float share) {
    find_places(share - 1.0F, first_movers_, movers_.x.size());
    for (std::size_t k = first_movers_; k < movers_.x.size(); ++k) {
        if (places_[k] < 0) continue;
        Seen& seen = seen_[static_cast<std::size_t>(places_[k])];
        const float level = movers_.level[k];
        const bool is_first = seen.level != kNothing && seen.mover < first_movers_;
        if (!is_first && level > seen.level) seen = {level, static_cast<std::uint32_t>(k)};
    }
}

/// Fills remaining gaps from their farther side; narrow cracks between equal sides likewise.
void MotionWarp::fill_gaps() {
    for (int j = 0; j < rows_; ++j) {
        Seen* const row = seen_.data() + static_cast<std::ptrdiff_t>(j) * columns_;
        for (int i = 0; i < columns_; ++i) {
            if (row[i].level != kNothing) continue;
            int end = i;
            while (end < columns_ && row[end].level == kNothing) ++end;
            const bool left = i > 0 && end - i <= kGap_px;
            const bool right = end < columns_ && end - i <= kGap_px;
            const bool from_left = left && (!right || row[i - 1].level <= row[end].level);
            const Seen beside = from_left ? row[i - 1] : right ? row[end] : Seen{0.0F, kStays};
            std::fill(row + i, row + end, beside);
            i = end;
        }
    }
}

/// The share of pixels nearer than `level` around the place's origin in the first image and its
/// destination in the second, mean of both.
float MotionWarp::share_nearer(float level, MotionField::Way way, float share, int x, int y) const {
    const auto at = [&](const DepthImage& image, float times) {
        const Tent columns(static_cast<float>(x + box_.left) + times * way.right, image.columns);
        const Tent rows(static_cast<float>(y + box_.top) + times * way.down, image.rows);
        float nearer = 0.0F;
        float all = 0.0F;
        for (int j = rows.begin; j < rows.end; ++j)
            for (int i = columns.begin; i < columns.end; ++i) {
                const float weight = rows.at(j) * columns.at(i);
                nearer += image.at(i, j) > level ? weight : 0.0F;
                all += weight;
            }
        return nearer / all;
    };
    return 0.5F * (at(*first_, -share) + at(*second_, 1.0F - share));
}

/// The background that is visible at a place which a nearer pixel does not reach.
MotionWarp::Seen MotionWarp::behind(const Seen& far, int x, int y) const {
    if (far.mover >= kFirstMover) return far;
    const float alike = kOfOneSurface * static_cast<float>(first_->highest_level);
    const float in_first = first_->at(x + box_.left, y + box_.top);
    const float in_second = second_->at(x + box_.left, y + box_.top);
    const bool first = std::fabs(in_first - far.level) < alike;
    const bool second = std::fabs(in_second - far.level) < alike;
    if (first == second) return {far.level, kStays};
    return first ? Seen{in_first, kStaysInFirst} : Seen{in_second, kStaysInSecond};
}

/// Decides for one of two neighbouring places: the near pixel is visible if most around is near.
void MotionWarp::refine_outline(float share, int x, int y, const Seen& near, const Seen& far) {
    const auto at = place(x, y);
    const bool is_near = seen_[at].mover == near.mover;
    const float between = 0.5F * (near.level + far.level);
    const bool reaches = share_nearer(between, movers_.way(near.mover), share, x, y) > 0.5F;
    if (is_near != reaches) refined_.push_back({at, reaches ? near : behind(far, x, y)});
}

/// One image gives an outline's place to one pixel; both images, and the pixels along the outline,
/// give it more exactly.
void MotionWarp::refine_outlines(float share) {
    const float alike = kOfOneSurface * static_cast<float>(first_->highest_level);
    refined_.clear();
    const auto look_at = [&](int x, int y, int i, int j) {
        const Seen& here = seen_[place(x, y)];
        const Seen& there = seen_[place(i, j)];
        if (!(std::fabs(here.level - there.level) > alike)) return;
        const bool is_near = here.level > there.level;
        const Seen& near = is_near ? here : there;
        const Seen& far = is_near ? there : here;
        if (near.mover < kFirstMover || movers_.visibility[near.mover] != Visibility::both) return;
        refine_outline(share, x, y, near, far);
        refine_outline(share, i, j, near, far);
    };
    for (int y = 0; y < rows_; ++y)
        for (int x = 0; x < columns_; ++x) {
            if (x + 1 < columns_) look_at(x, y, x + 1, y);
            if (y + 1 < rows_) look_at(x, y, x, y + 1);
        }
    for (const Refined& refined : refined_) seen_[refined.at] = refined.seen;
}

void MotionWarp::warp_to(float share) {
    warp_first(share);
    warp_second(share);
    fill_gaps();
    refine_outlines(share);
}

}  // namespace dibhr
