// Medians of five frames, then means of those of up to 27 frames that are like the median.
#include "core/video/cleaning/temporal_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "core/video/cleaning/even_motion.hpp"
#include "core/video/cleaning/patches.hpp"
#include "core/video/cleaning/rows_in_time.hpp"

namespace dibhr {

using namespace in_time;

namespace {

constexpr std::size_t kMedianReach = 2;  ///< frames to each side
constexpr float kAlike = 3.0F;  ///< standard deviations; beyond, a level may be another surface
/// Noise has so many times the variance of the levels that mix, since the farthest do not.
constexpr float kCutOff = 1.1F;
constexpr int kTile_px = 16;                  ///< rows that are averaged together
constexpr std::size_t kStillTile_px = 32;     ///< their columns that stand still or not as a whole
constexpr int kRowStep_px = 4;                ///< every fourth row tells
constexpr float kLeastNoise = 0.1F / 255.0F;  ///< of the highest level: least assumed noise
// A tile stands still if a group differs from the median of the nearest frames as noise does: by
// its mean in deviations, and by its mean square in those of what both have.
constexpr float kStillMean = 0.8F;
constexpr float kStillSquares = 2.5F;
constexpr float kOfMedian = 0.29F;       ///< variance of a median of five
constexpr int kMisfitRow_px = 8;         ///< every eighth row tells how tiles move
constexpr float kBetter = 0.03F;         ///< by so much of the misfit, about what noise makes of it
constexpr std::size_t kMovingTiles = 4;  ///< one of so many, or more: the camera moves
constexpr float kFits = 1.0F;            ///< misfit: noise alone has a third; else something passes
constexpr float kLeastCounted = 32.0F;   ///< pixels of a tile

// A patch that lasts less than three frames is kept if enough of its rim is connected to ("held
// by") a surface that stays. Measured on people who walk past within two frames, whose feet touch
// the floor, and on hands, whose palm stays longer than the fingers.
constexpr int kWide_px = 5;
constexpr double kHeldShare = 0.4;   ///< of the rim
constexpr double kHeldWidths = 0.7;  ///< of a thin patch: rim pixels a width
constexpr int kThinInWidth = 20;  ///< a thin patch is at most this part of the image's width wide
constexpr int kHeldWithin_px = 4;

// Moving parts are found in the frames before and after, by regions as wide as a finger.
constexpr int kRegion_px = 32;
constexpr std::size_t kLeastOthers = 32;  ///< surely other pixels; with fewer a region is skipped
constexpr std::size_t kSamples = 20;      ///< of these pixels
constexpr std::size_t kSpread = 7;        ///< coprime to 20: the first samples are from all over
constexpr float kAlikeStep = 0.2F;        ///< of a sample's distance from the median: same surface

/// The rim of a patch, and how much of it is held by the surface beside it.
struct Rim {
    int pixels{0};
    int held{0};
    float half_width_px{0.0F};  ///< of the patch
};

}  // namespace

void TemporalFilter::gather(std::span<const SingleFrameDepth* const> frames, std::size_t now) {
    const SingleFrameDepth& here = *frames[now];
    const std::size_t first = now - std::min(now, kNearInTime);
    const std::size_t end = std::min(frames.size(), now + kNearInTime + 1);
    count_ = 0;
    nearest_ = 0;
    any_filled_ = false;
    for (std::size_t k = first; k < end; ++k) {
        if (!are_alike(frames[k]->depth, here.depth)) continue;
        const std::size_t away = k > now ? k - now : now - k;
        any_filled_ = any_filled_ || !frames[k]->filled.empty();
        if (away <= kMedianReach && nearest_++ == 0) first_near_ = count_;
        if (k == now) now_ = count_;
        neighbours_[count_++] = {frames[k]->depth.levels.data(),
                                 frames[k]->filled.empty() ? nullptr : frames[k]->filled.data()};
    }
}

/// The rows of the neighbours from that pixel on, in its place.
TemporalFilter::Neighbours TemporalFilter::rows_at(std::size_t at) const {
    Neighbours rows = neighbours_;
    for (std::size_t k = 0; k < count_; ++k) {
        rows[k].levels += at;
        if (rows[k].filled != nullptr) rows[k].filled += at;
    }
    return rows;
}

/// The rows of the neighbours that show what the piece of row `j` does.
TemporalFilter::Neighbours TemporalFilter::rows_of(const Piece& piece, int j,
                                                   const DepthImage& size) {
    if (!piece.moves) return rows_at(size.index(piece.left, j));
    Neighbours rows = neighbours_;
    for (std::size_t k = 0; k < count_; ++k) {
        const std::size_t scratch = k * static_cast<std::size_t>(size.columns);
        rows[k].levels = shifted_row(rows[k].levels, size, rows[k].shift, j, piece.left,
                                     piece.count, FrameGroups::kNoLevel, shifted_.data() + scratch);
        if (rows[k].filled != nullptr)
            rows[k].filled =
                shifted_row<std::uint8_t>(rows[k].filled, size, rows[k].shift, j, piece.left,
                                          piece.count, 1, shifted_filled_.data() + scratch);
    }
    return rows;
}

/// The same of a group, the `number`-th one.
const float* TemporalFilter::row_of(const FrameGroup& group, const Piece& piece, int j,
                                    std::size_t number, const DepthImage& size) {
    return shifted_row(
        group.levels, size, group.shift, j, piece.left, piece.count, FrameGroups::kNoLevel,
        shifted_.data() + (neighbours_.size() + number) * static_cast<std::size_t>(size.columns));
}

/// The median of `count` pixels over the frame and those near it: over five frames, else three. It
/// is the frame's own level where one of them does not show the pixel.
void TemporalFilter::find_reference(const Neighbours& rows, const float* here, std::size_t count,
                                    float* reference) const {
    const Neighbour* n = rows.data() + first_near_;
    std::size_t of = 1;
    if (nearest_ == 5) {
        medians(n[0].levels, n[1].levels, n[2].levels, n[3].levels, n[4].levels, reference, count);
        of = 5;
    } else if (nearest_ >= 3) {
        if (nearest_ == 4 && first_near_ + 1 != now_) ++n;
        medians(n[0].levels, n[1].levels, n[2].levels, reference, count);
        of = 3;
    } else {
        std::copy_n(here, count, reference);
    }
    if (farthest_shift_ == 0) return;
    for (std::size_t k = 0; k < of; ++k)
        if (n[k].shift != Shift{}) take_where_missing(n[k].levels, here, reference, count);
}

/// Of one pixel, as its tile is read.
float TemporalFilter::reference_at(const DepthImage& here, std::size_t at) const {
    const float own = here.levels[at];
    float reference = 0.0F;
    Neighbours rows = rows_at(at);
    const auto columns = static_cast<std::size_t>(here.columns);
    const std::size_t tile =
        at / columns / kTile_px * ((columns + kStillTile_px - 1) / kStillTile_px) +
        at % columns / kStillTile_px;
    std::array<float, 2 * kNearInTime + 1> scratch{};
    if (farthest_shift_ != 0 && moving_[tile] != 0)
        for (std::size_t k = first_near_; k < first_near_ + nearest_; ++k)
            rows[k].levels = shifted_row(
                neighbours_[k].levels, here, rows[k].shift, static_cast<int>(at / columns),
                static_cast<int>(at % columns), 1, FrameGroups::kNoLevel, &scratch[k]);
    find_reference(rows, &own, 1, &reference);
    return reference;
}

void TemporalFilter::Sums::start(std::size_t count, float* weights_there) {
    reference.resize(count);
    per_bound.resize(count);
    sum.resize(count);
    squares.resize(count);
    weights = weights_there;
}

/// How most of the picture moves to each neighbour, which tiles do, and groups along that.
void TemporalFilter::find_motion(std::span<const SingleFrameDepth* const> frames, std::size_t now,
                                 const DepthNoise& noise) {
    farthest_shift_ = 0;
    moving_far_ = {};
    if (count_ < 2 || noise.per_frame_scale) return;
    const std::span<const PictureWay> ways = camera_.ways(frames, now, noise);
    if (ways.empty()) return;
    const auto add = [this](const Shift& shift) {
        farthest_shift_ = std::max({farthest_shift_, std::abs(shift.right), std::abs(shift.down)});
    };
    for (std::size_t k = now - std::min(now, kNearInTime), n = 0; n < count_; ++k) {
        if (frames[k]->depth.levels.data() != neighbours_[n].levels) continue;
        neighbours_[n].shift = rounded(ways[k]);
        add(neighbours_[n++].shift);
    }
    if (farthest_shift_ == 0) return;
    const DepthImage& here = frames[now]->depth;
    choose_tiles(here);
    if (farthest_shift_ == 0) return;
    moving_far_ = moving_groups_.around(
        frames, now, NoiseBound(noise, 1.0F, kLeastNoise, here.highest_level), ways);
    for (const FrameGroup& group : moving_far_) add(group.shift);
}

/// A tile moves with the picture where the frames beside fit along that way, and better than in
/// place, in the tiles around it, too: they tell more than one tile where noise is strong.
void TemporalFilter::choose_tiles(const DepthImage& here) {
    const auto columns = static_cast<std::size_t>(here.columns);
    const std::size_t across = (columns + kStillTile_px - 1) / kStillTile_px;
    const auto down = static_cast<std::size_t>((here.rows + kTile_px - 1) / kTile_px);
    moving_.assign(across * down, 1);
    for (const bool moves : {false, true}) {
        misfits_[moves ? 1 : 0].clear();
        for (std::size_t y = 0; y < down; ++y) {
            squared_off_.assign(columns, 0.0F);
            counted_.assign(columns, 0.0F);
            const int top = static_cast<int>(y) * kTile_px;
            for (int j = top + kMisfitRow_px / 2; j < std::min(top + kTile_px, here.rows);
                 j += kMisfitRow_px)
                add_misfits(j, moves, here);
            for (std::size_t x = 0; x < across; ++x) {
                float squared = 0.0F;
                float counted = 0.0F;
                for (std::size_t i = x * kStillTile_px;
                     i < std::min((x + 1) * kStillTile_px, columns); ++i) {
                    squared += squared_off_[i];
                    counted += counted_[i];
                }
                misfits_[moves ? 1 : 0].push_back(counted > 0.0F ? squared / counted
                                                  : moves        ? kMostMisfit * kMostMisfit
                                                                 : 0.0F);
            }
        }
    }
    for (std::size_t y = 0; y < down; ++y)
        for (std::size_t x = 0; x < across; ++x) {
            float better = 0.0F;
            float along = 0.0F;
            for (std::size_t v = y - std::min<std::size_t>(y, 1); v < std::min(y + 2, down); ++v)
                for (std::size_t u = x - std::min<std::size_t>(x, 1); u < std::min(x + 2, across);
                     ++u) {
                    const float weight = (u == x ? 2.0F : 1.0F) * (v == y ? 2.0F : 1.0F);
                    const std::size_t k = v * across + u;
                    better += weight * (misfits_[0][k] - misfits_[1][k]);
                    along += weight * misfits_[1][k];
                }
            const bool fits = misfits_[1][y * across + x] < kFits;
            moving_[y * across + x] = fits && better > kBetter * along ? 1 : 0;
        }
    // A few may be a hand that moves evenly, and chance.
    const auto count = static_cast<std::size_t>(std::count(moving_.begin(), moving_.end(), 1));
    if (kMovingTiles * count < moving_.size()) farthest_shift_ = 0;
}

/// What is smoothed afterwards takes a frame's weight for less than one where noise is alike from
/// frame to frame. Along the motion it is less alike than shapes that move make it in place.
void TemporalFilter::share_weights(const DepthImage& out) {
    const float factor = shared_[0] / shared_[1];
    const auto columns = static_cast<std::size_t>(out.columns);
    const std::size_t across = (columns + kStillTile_px - 1) / kStillTile_px;
    for (int j = 0; j < out.rows; ++j)
        visit_marked(moving_.data() + static_cast<std::size_t>(j / kTile_px) * across,
                     static_cast<int>(across), [&](int begin, int end) {
                         float* const row = evidence_.weights.data() + out.index(0, j);
                         for (std::size_t i = kStillTile_px * static_cast<std::size_t>(begin);
                              i < std::min(kStillTile_px * static_cast<std::size_t>(end), columns);
                              ++i)
                             row[i] *= factor;
                     });
}

/// Adds how far the farther neighbours are from the median, read in place or along the motion.
void TemporalFilter::add_misfits(int j, bool moves, const DepthImage& here) {
    const auto columns = static_cast<std::size_t>(here.columns);
    const Piece whole{0, columns, moves};
    const Neighbours rows = rows_of(whole, j, here);
    run_.start(columns, nullptr);
    find_reference(rows, here.levels.data() + here.index(0, j), columns, run_.reference.data());
    invert(run_.reference.data(), mixing_, run_.per_bound.data(), columns);
    for (std::size_t k = 0; k < count_; ++k)
        if (k < first_near_ || k >= first_near_ + nearest_)
            add_misfit(rows[k].levels, run_.reference.data(), run_.per_bound.data(),
                       squared_off_.data(), counted_.data(), columns);
}

/// Tiles side by side that are read alike; those from which some frame is read beyond the border
/// are apart, as they are copied.
void TemporalFilter::find_pieces(std::size_t row_of_tiles, std::size_t tiles, std::size_t columns) {
    pieces_.clear();
    if (farthest_shift_ == 0) {
        pieces_.push_back({0, columns, false});
        return;
    }
    const std::uint8_t* const moves = moving_.data() + row_of_tiles * tiles;
    const std::size_t beside =
        (static_cast<std::size_t>(farthest_shift_) + kStillTile_px - 1) / kStillTile_px;
    for (std::size_t x = 0, end = 0; x < tiles; x = end) {
        const auto is_at_border = [&](std::size_t tile) {
            return tile < beside || tile + beside + 1 >= tiles;
        };
        for (end = x + 1; end < tiles && moves[end] == moves[x] &&
                          (moves[x] == 0 || is_at_border(end) == is_at_border(x));)
            ++end;
        const std::size_t left = x * kStillTile_px;
        pieces_.push_back(
            {static_cast<int>(left), std::min(end * kStillTile_px, columns) - left, moves[x] != 0});
    }
}

/// Averages tiles side by side together, so that their rows stay in the cache. Returns whether any
/// of the frame's own levels is another surface than the median.
bool TemporalFilter::average_rows(const SingleFrameDepth& here, DepthImage& out) {
    const auto columns = static_cast<std::size_t>(out.columns);
    const std::size_t tiles = (columns + kStillTile_px - 1) / kStillTile_px;
    other_.resize(out.levels.size());
    rows_.resize(kTile_px);
    bool any = false;
    for (int top = 0; top < out.rows; top += kTile_px) {
        const int rows = std::min(kTile_px, out.rows - top);
        find_pieces(static_cast<std::size_t>(top / kTile_px), tiles, columns);
        for (int j = 0; j < rows; ++j) {
            const std::size_t at = out.index(0, top + j);
            const float* const levels = here.depth.levels.data() + at;
            Sums& sums = rows_[static_cast<std::size_t>(j)];
            sums.start(columns, evidence_.weights.data() + at);
            for (const Piece& piece : pieces_) {
                const auto left = static_cast<std::size_t>(piece.left);
                const Neighbours near = rows_of(piece, top + j, out);
                find_reference(near, levels + left, piece.count, sums.reference.data() + left);
                add_near(near, left, piece.count, sums);
            }
            if (mark_other(levels, sums.reference.data(), bound_, other_.data() + at, columns)) {
                if (!here.filled.empty())
                    unmark(here.filled.data() + at, other_.data() + at, columns);
                any = true;
            }
        }
        if (count_ > 1) measure_variances(rows, out);
        for (const Piece& piece : pieces_) add_groups(piece, top, rows, out);
        for (int j = 0; j < rows; ++j)
            take_mean(rows_[static_cast<std::size_t>(j)], out.index(0, top + j), out);
    }
    return any;
}

/// The variance of levels in time, in which motion has no part: levels of other surfaces do not
/// count. Where too few frames count it is that of the clip's noise.
void TemporalFilter::measure_variances(int rows, const DepthImage& out) {
    constexpr int kPart = TimeEvidence::kTile_px;
    const auto columns = static_cast<std::size_t>(out.columns);
    const int tile_columns = (out.columns + kPart - 1) / kPart;
    for (int part = 0; part < rows; part += kPart) {
        off_.assign(columns, 0.0F);
        counted_.assign(columns, 0.0F);
        const int bottom = std::min(part + kPart, rows);
        for (int j = part; j < bottom; j += 2) {  // every second row tells
            const Sums& sums = rows_[static_cast<std::size_t>(j)];
            add_variances(sums.sum.data(), sums.weights, sums.squares.data(), off_.data(),
                          counted_.data(), columns);
        }
        const Sums& middle = rows_[static_cast<std::size_t>((part + bottom) / 2)];
        for (int x = 0; x < tile_columns; ++x) {
            const auto left = static_cast<std::size_t>(x * kPart);
            const std::size_t right = std::min(left + kPart, columns);
            float variance = 0.0F;
            float counted = 0.0F;
            for (std::size_t i = left; i < right; ++i) {
                variance += off_[i];
                counted += counted_[i];
            }
            const float law = bound_(middle.reference[(left + right) / 2]) / kAlike;
            const auto pixels =
                static_cast<float>(right - left) * static_cast<float>((bottom - part + 1) / 2);
            evidence_.variances.push_back(2.0F * counted < pixels ? law * law
                                                                  : kCutOff * variance / counted);
        }
    }
}

/// Adds groups of frames where the tile stands still: else what moves slowly would be smeared. All
/// of them or none, since those of one side alone would be late.
void TemporalFilter::add_groups(const Piece& piece, int top, int rows, const DepthImage& out) {
    const std::span<const FrameGroup> far = piece.moves ? moving_far_ : far_;
    if (far.empty()) return;
    const std::size_t tiles = (piece.count + kStillTile_px - 1) / kStillTile_px;
    still_.assign(tiles, 1);
    for (const FrameGroup& group : far) find_still(group, piece, top, rows, out);
    visit_marked(still_.data(), static_cast<int>(tiles), [&](int begin, int end) {
        const std::size_t from = kStillTile_px * static_cast<std::size_t>(begin);
        const std::size_t count =
            std::min(kStillTile_px * static_cast<std::size_t>(end), piece.count) - from;
        const Piece part{piece.left + static_cast<int>(from), count, piece.moves};
        const auto left = static_cast<std::size_t>(part.left);
        for (int j = 0; j < rows; ++j) {
            Sums& sums = rows_[static_cast<std::size_t>(j)];
            const float* const reference = sums.reference.data() + left;
            const float* const per_bound = sums.per_bound.data() + left;
            const auto row = [&](std::size_t k) { return row_of(far[k], part, top + j, k, out); };
            std::size_t k = 0;
            for (; k + 4 <= far.size(); k += 4) {
                const FrameGroup* g = far.data() + k;
                add_four_groups({row(k), row(k + 1), row(k + 2), row(k + 3)},
                                {g[0].weight, g[1].weight, g[2].weight, g[3].weight}, reference,
                                per_bound, sums.sum.data() + left, sums.weights + left, count);
            }
            for (; k < far.size(); ++k)
                add_group(row(k), far[k].weight, reference, per_bound, sums.sum.data() + left,
                          sums.weights + left, count);
        }
    });
}

/// Unmarks tiles of the piece that do not stand still from that group to the frame.
void TemporalFilter::find_still(const FrameGroup& group, const Piece& piece, int top, int rows,
                                const DepthImage& out) {
    const auto columns = static_cast<std::size_t>(out.columns);
    const auto first_column = static_cast<std::size_t>(piece.left);
    for (std::vector<float>* sums : {&off_, &squared_off_, &counted_}) sums->assign(columns, 0.0F);
    for (int j = kRowStep_px / 2; j < rows; j += kRowStep_px) {
        const Sums& sums = rows_[static_cast<std::size_t>(j)];
        add_differences(row_of(group, piece, top + j, 0, out), sums.reference.data() + first_column,
                        sums.per_bound.data() + first_column, off_.data() + first_column,
                        squared_off_.data() + first_column, counted_.data() + first_column,
                        piece.count);
    }
    constexpr int kPart = TimeEvidence::kTile_px;
    const auto parts = static_cast<std::size_t>((out.columns + kPart - 1) / kPart);
    const std::size_t first = parts * static_cast<std::size_t>(top / kPart);
    const float shared = shared_[piece.moves ? 1 : 0];
    for (std::size_t x = 0; x < still_.size(); ++x) {
        float off = 0.0F;
        float squared = 0.0F;
        float counted = 0.0F;
        const std::size_t left = first_column + kStillTile_px * x;
        const std::size_t right = std::min(left + kStillTile_px, columns);
        for (std::size_t i = left; i < right; ++i) {
            off += off_[i];
            squared += squared_off_[i];
            counted += counted_[i];
        }
        if (counted < kLeastCounted) {
            still_[x] = 0;
            continue;
        }
        float variance = 0.0F;
        float count = 0.0F;
        for (int y = 0; y * kPart < rows; ++y)
            for (std::size_t part = left / kPart; part * kPart < right; ++part, ++count)
                variance += evidence_.variances[first + static_cast<std::size_t>(y) * parts + part];
        variance /= count;
        const float of_group = std::min(shared / static_cast<float>(kGroupInTime), 1.0F);
        const float of_median = std::min(shared * kOfMedian, 1.0F);
        const float mean = off / counted;
        if (mean * mean > kStillMean * kStillMean * variance ||
            squared / counted > kStillSquares * (of_group + of_median) * variance)
            still_[x] = 0;
    }
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
        const float reference = reference_at(here, at);
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
    std::array<float, kRegion_px> levels{};
    for (int j = region.top; j < region.bottom; ++j) {
        std::size_t run = 0;
        for (int i = region.left; i < region.right; ++i) {
            const std::optional<float> level = is_other(here, here.depth.index(i, j))
                                                   ? search.level_along(*motion, i, j, bound_)
                                                   : std::nullopt;
            if (level) levels[run++] = *level;
            if (run == 0 || (level && i + 1 < region.right)) continue;
            average(levels.data(), here.depth.index(level ? i + 1 : i, j) - run, run, out);
            run = 0;
        }
    }
}

/// Whether the level is another one than the median, and not followed yet.
bool TemporalFilter::is_other(const SingleFrameDepth& here, std::size_t at) const {
    if (followed_[at] != 0) return false;
    if (here.filled.empty() || here.filled[at] == 0) return other_[at] != 0;
    const float reference = reference_at(here.depth, at);
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
    const float reference = reference_at(here, at);
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

/// Averages `count` pixels from `at` on, in one row, over the nearest frames; `reference`: from the
/// first pixel on.
void TemporalFilter::average(const float* reference, std::size_t at, std::size_t count,
                             DepthImage& out) {
    run_.start(count, evidence_.weights.data() + at);
    std::copy_n(reference, count, run_.reference.begin());
    add_near(rows_at(at), 0, count, run_);
    take_mean(run_, at, out);
}

void TemporalFilter::take_mean(const Sums& sums, std::size_t at, DepthImage& out) {
    divide(sums.reference.data(), sums.sum.data(), sums.weights, out.levels.data() + at,
           sums.sum.size());
}

/// The sums of the nearest frames, whose rows begin at the pixel `left` of the sums.
void TemporalFilter::add_near(const Neighbours& rows, std::size_t left, std::size_t count,
                              Sums& sums) const {
    const float* const reference = sums.reference.data() + left;
    float* const per_bound = sums.per_bound.data() + left;
    invert(reference, mixing_, per_bound, count);
    float* const sum = sums.sum.data() + left;
    float* const weights = sums.weights + left;
    float* const squares = sums.squares.data() + left;
    if (count_ == rows.size() && !any_filled_) {
        Near all{};
        for (std::size_t k = 0; k < rows.size(); ++k) all[k] = rows[k].levels;
        add_near_frames(all, reference, per_bound, sum, weights, squares, count);
        return;
    }
    std::fill_n(sum, count, 0.0F);
    std::fill_n(weights, count, 0.0F);
    std::fill_n(squares, count, 0.0F);
    std::size_t k = 0;
    for (; k + 4 <= count_; k += 4) {
        const Neighbour* n = rows.data() + k;
        const Four four{n[0].levels, n[1].levels, n[2].levels, n[3].levels};
        const FourFilled filled{filled_of(n[0]), filled_of(n[1]), filled_of(n[2]), filled_of(n[3])};
        if (std::any_of(n, n + 4, [](const Neighbour& one) { return one.filled != nullptr; }))
            add_four(four, filled, reference, per_bound, sum, weights, squares, count);
        else
            add_four(four, reference, per_bound, sum, weights, squares, count);
    }
    for (; k < count_; ++k) {
        const Neighbour& n = rows[k];
        if (n.filled == nullptr)
            add_one(n.levels, reference, per_bound, sum, weights, squares, count);
        else
            add_one(n.levels, n.filled, reference, per_bound, sum, weights, squares, count);
    }
}

const std::uint8_t* TemporalFilter::filled_of(const Neighbour& n) const {
    return n.filled == nullptr ? nothing_filled_.data() : n.filled;
}

DepthImage TemporalFilter::filtered(std::span<const SingleFrameDepth* const> frames,
                                    std::size_t now, const DepthNoise& noise) {
    const SingleFrameDepth& here = *frames[now];
    DepthImage out{here.depth.columns, here.depth.rows, here.depth.highest_level, {}};
    out.levels.resize(here.depth.levels.size());
    bound_ = NoiseBound(noise, kAlike, kLeastNoise, here.depth.highest_level);
    mixing_ = NoiseBound(noise, kApart - kMixes, kLeastNoise, here.depth.highest_level);
    const auto shared = [](float kept) { return (1.0F + kept) / (1.0F - kept); };
    shared_ = {shared(noise.character.kept), shared(noise.character.kept_in_motion)};
    gather(frames, now);
    far_ = {};
    if (count_ > 1)
        far_ = groups_.around(frames, now,
                              NoiseBound(noise, 1.0F, kLeastNoise, here.depth.highest_level));
    evidence_.near_frames = count_;
    evidence_.weights.resize(out.levels.size());
    evidence_.variances.clear();
    const auto columns = static_cast<std::size_t>(out.columns);
    nothing_filled_.assign(columns, 0);
    shifted_.resize((neighbours_.size() + kReachInTime) * columns);
    shifted_filled_.resize(neighbours_.size() * columns);
    find_motion(frames, now, noise);
    if (average_rows(here, out)) follow_parts(here, out);
    if (farthest_shift_ != 0 && shared_[0] != shared_[1]) share_weights(out);
    return out;
}

}  // namespace dibhr
