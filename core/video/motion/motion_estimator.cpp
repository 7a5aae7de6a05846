// From coarse to fine: a search over all ways in the smallest pictures, then steps downhill (least
// squares) in larger ones, each part with similar parts around it; last, which parts surely move.
#include "core/video/motion/motion_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "core/video/motion/motion_spread.hpp"

namespace dibhr {

namespace {

constexpr float kUnchanged = 0.1F;  // mean square below which nothing has changed [levels^2]
// Mean square of a part that is covered as a whole, if it stays: it has changed.
constexpr float kCoveredSquare = 400.0F;
constexpr std::size_t kSmall = 1;      // number of the picture in which changes are found
constexpr float kNoise = 0.08F;        // share of the rest by which noise alone falls by chance
constexpr float kLeastPixels = 0.02F;  // of a part and those around it, times their trust
constexpr float kStiff = 0.5F;         // squared slope of every pixel that holds a part in place
constexpr float kMostStep = 1.5F;      // downhill, at once [px of the picture]
constexpr float kOwnShare = 0.9F;      // factor on the mean square of a part's own way
constexpr float kApart_px = 0.5F;      // ways that differ by less are not tried
// A part surely moves (kSure), or moves if others do (kLikely), if its mean square falls by this
// share of the rest plus a floor: what codecs change in a still picture.
constexpr float kSure = 0.8F;
constexpr float kSureFloor = 1.5F;
constexpr float kSureWay_px = 0.12F;
constexpr float kSurePixels = 500.0F;
constexpr float kLikely = 0.2F;
constexpr float kLikelyFloor = 0.3F;
constexpr int kMostPlain = 8;  // cells from a part that has changed, or surely moves
constexpr int kJudges = 2;     // cells to each side that are judged together with one
constexpr int kNeighbour = 2;  // cells to the next part whose way is tried

/// Changes the sums to those of a way that is shorter by `way`, linearly by the slopes.
void shift_sums(MotionField::Way way, std::size_t part, std::size_t k, MotionSums& sums) {
    const auto at = [&](MotionSum sum) -> float& { return sums[sum].of[part].values[k]; };
    at(MotionSum::r) -= at(MotionSum::x) * way.right + at(MotionSum::y) * way.down;
    at(MotionSum::xr) -= at(MotionSum::xx) * way.right + at(MotionSum::xy) * way.down;
    at(MotionSum::yr) -= at(MotionSum::xy) * way.right + at(MotionSum::yy) * way.down;
}

/// The way at which the sum of squares is least, linearly by the slopes; near `now` in directions
/// without slope.
MotionField::Way lowest(const MotionSums& sums, std::size_t part, std::size_t k,
                        MotionField::Way now) {
    const auto mean = [&, n = sums[MotionSum::n].of[part].values[k]](MotionSum sum) {
        return sums[sum].of[part].values[k] / n;
    };
    const float x = mean(MotionSum::x);
    const float y = mean(MotionSum::y);
    const float r = mean(MotionSum::r);
    const float xx = mean(MotionSum::xx) - x * x + kStiff;
    const float xy = mean(MotionSum::xy) - x * y;
    const float yy = mean(MotionSum::yy) - y * y + kStiff;
    const float xr = kStiff * now.right - (mean(MotionSum::xr) - x * r);
    const float yr = kStiff * now.down - (mean(MotionSum::yr) - y * r);
    const float det = xx * yy - xy * xy;
    return {(yy * xr - xy * yr) / det, (xx * yr - xy * xr) / det};
}

float stepped(float from, float to) {
    return from + std::clamp(to - from, -kMostStep, kMostStep);
}

}  // namespace

MotionEstimator::Verdict& MotionEstimator::verdict(const MotionPart& part) {
    return verdicts_[part.part][from_.cells.threshold.index(part.i, part.j)];
}

MotionEstimator::Way MotionEstimator::way_of(const MotionPart& part) const {
    return {ways_.right.of[part.part].row(part.j)[part.i],
            ways_.down.of[part.part].row(part.j)[part.i]};
}

void MotionEstimator::set_way(const MotionPart& part, Way way) {
    ways_.right.of[part.part].row(part.j)[part.i] = way.right;
    ways_.down.of[part.part].row(part.j)[part.i] = way.down;
}

/// The rows that have wanted parts.
void MotionEstimator::find_rows() {
    rows_ = {};
    from_.cells.each_part([this](const MotionPart& part, std::size_t k) {
        if (!(wanted_.of[part.part].values[k] > 0.0F)) return;
        rows_.begin = rows_.end == 0 ? part.j : std::min(rows_.begin, part.j);
        rows_.end = std::max(rows_.end, part.j + 1);
    });
}

void MotionEstimator::sum(std::size_t size, const MotionLayers& wanted, const MotionWays& ways,
                          MotionMeasure measure) {
    sum_differences({from_, to_, gain_}, size, wanted, plain_.layers(), ways, measure, sums_);
}

void MotionEstimator::gather(int reach, MotionMeasure measure) {
    similar_.gather(rows_, reach, measure, sums_, gathered_);
}

/// Finds parts in or around which anything has changed. False: there are none.
bool MotionEstimator::find_changed() {
    wanted_.fill(0.0F);
    from_.cells.each_part(
        [this](const MotionPart& part, std::size_t k) { wanted_.of[part.part].values[k] = 1.0F; });
    ways_.fill(0.0F);
    sums_.fill(0.0F);
    rows_ = {0, from_.cells.rows};
    plain_.clear(from_.cells);
    sum(kSmall, wanted_, ways_, MotionMeasure::difference);
    gather(kJudges, MotionMeasure::difference);
    bool any = false;
    from_.cells.each_part([this, &any](const MotionPart& part, std::size_t k) {
        const auto gathered = [&](MotionSum which) {
            return gathered_[which].of[part.part].values[k];
        };
        const bool known = gathered_.is_known(part.part, k);
        still_.of[part.part].values[k] =
            known ? gathered_.mean_square(part.part, k) : kCoveredSquare;
        const bool changed =
            !known || gathered(MotionSum::rr) > kUnchanged * gathered(MotionSum::n);
        float& wanted = wanted_.of[part.part].values[k];
        if (!changed) wanted = 0.0F;
        any = any || wanted > 0.0F;
    });
    if (!any) return false;
    sum_structure(from_, kSmall, sums_);
    gather(1, MotionMeasure::slopes);
    plain_.find(from_.cells, wanted_, gathered_, kMostPlain);
    sums_.fill(0.0F);
    find_rows();
    return true;
}

/// Drops parts that only noise has changed: with their way they fit no better than without.
void MotionEstimator::drop_noise() {
    sum(kSmall, wanted_, ways_, MotionMeasure::difference);
    gather(kJudges, MotionMeasure::difference);
    from_.cells.each_part([this](const MotionPart& part, std::size_t k) {
        const std::size_t of = part.part;
        if (plain_.has(of, k) || !gathered_.is_known(of, k)) return;
        const float left = gathered_.mean_square(of, k);
        if (still_.of[of].values[k] - left > kNoise * (left + kUnchanged)) return;
        wanted_.of[of].values[k] = 0.0F;
        set_way(part, {});
    });
    sums_.fill(0.0F);
    find_rows();
}

/// A part that fits badly gets little weight for those around it.
void MotionEstimator::find_trust() {
    trust_ = wanted_;
    from_.cells.each_part([this](const MotionPart& part, std::size_t k) {
        float& trust = trust_.of[part.part].values[k];
        if (!(trust > 0.0F)) return;
        trust = sums_.is_known(part.part, k) ? motion_trust(sums_.mean_square(part.part, k))
                                             : kLeastMotionTrust;
    });
}

void MotionEstimator::weigh_by_trust() {
    for (MotionLayers& layers : sums_.of)
        for (std::size_t part = 0; part < layers.of.size(); ++part) {
            std::vector<float>& values = layers.of[part].values;
            const std::vector<float>& trust = trust_.of[part].values;
            for (std::size_t k = 0; k < values.size(); ++k) values[k] *= trust[k];
        }
}

/// One step of least squares. Similar parts turn and grow together, so they share one correction to
/// even motion. Plain parts settle all at once.
void MotionEstimator::go_downhill(std::size_t size) {
    const float scale = 1.0F / static_cast<float>(1 << size);
    const float farthest = static_cast<float>(kFarthestMotion) *
                           static_cast<float>(kMotionCell_px * from_.cells.columns);
    sum(size, wanted_, ways_, MotionMeasure::slopes);
    find_trust();
    plain_.settle(sums_, wanted_, trust_, ways_, scale);
    weigh_by_trust();
    similar_.smooth(trust_, ways_, even_);
    const auto even_way = [&](const MotionPart& part, std::size_t k) {
        return Way{even_.right.of[part.part].values[k], even_.down.of[part.part].values[k]};
    };
    const auto beyond = [&](Way way, Way even) {
        return Way{scale * (way.right - even.right), scale * (way.down - even.down)};
    };
    const auto goes = [&](const MotionPart& part, std::size_t k) {
        return wanted_.of[part.part].values[k] > 0.0F && !plain_.has(part.part, k);
    };
    from_.cells.each_part([&](const MotionPart& part, std::size_t k) {
        if (goes(part, k)) shift_sums(beyond(way_of(part), even_way(part, k)), part.part, k, sums_);
    });
    gather(1, MotionMeasure::slopes);
    from_.cells.each_part([&](const MotionPart& part, std::size_t k) {
        const float pixels = gathered_[MotionSum::n].of[part.part].values[k];
        if (!goes(part, k) || !(pixels > kLeastPixels)) return;
        const Way even = even_way(part, k);
        const Way now = beyond(way_of(part), even);
        const Way there = lowest(gathered_, part.part, k, now);
        const auto to = [&](float even_px, float from, float onto) {
            return std::clamp(even_px + stepped(from, onto) / scale, -farthest, farthest);
        };
        set_way(part,
                {to(even.right, now.right, there.right), to(even.down, now.down, there.down)});
    });
    plain_.take(kMostStep / scale, farthest, ways_);
}

/// Tries for each part the way of the most similar part this many cells away.
void MotionEstimator::propose(int right, int down) {
    from_.cells.each_part([&](const MotionPart& part, std::size_t k) {
        const int x = std::clamp(part.i + right, 0, from_.cells.columns - 1);
        const int y = std::clamp(part.j + down, 0, from_.cells.rows - 1);
        const bool far = from_.cells.has(1, x, y) &&
                         from_.cells.gap(part, {x, y, 1}) < from_.cells.gap(part, {x, y, 0});
        const Way way = way_of({x, y, far ? std::size_t{1} : std::size_t{0}});
        tried_.right.of[part.part].values[k] = way.right;
        tried_.down.of[part.part].values[k] = way.down;
    });
}

/// Takes the tried ways where they fit better.
void MotionEstimator::take_better(float share) {
    gather(1, MotionMeasure::difference);
    from_.cells.each_part([&](const MotionPart& part, std::size_t k) {
        if (plain_.has(part.part, k) || !gathered_.is_known(part.part, k)) return;
        const float off = share * gathered_.mean_square(part.part, k);
        if (!(off < best_.of[part.part].values[k])) return;
        best_.of[part.part].values[k] = off;
        chosen_.right.of[part.part].values[k] = tried_.right.of[part.part].values[k];
        chosen_.down.of[part.part].values[k] = tried_.down.of[part.part].values[k];
    });
}

/// Computes sums for parts whose tried way differs; others keep theirs.
void MotionEstimator::attempt(std::size_t size) {
    const auto apart = [](float a, float b) { return std::fabs(a - b) > kApart_px; };
    bool any = false;
    from_.cells.each_part([&](const MotionPart& part, std::size_t k) {
        const std::size_t of = part.part;
        const bool differs = wanted_.of[of].values[k] > 0.0F && !plain_.has(of, k) &&
                             (apart(tried_.right.of[of].values[k], ways_.right.of[of].values[k]) ||
                              apart(tried_.down.of[of].values[k], ways_.down.of[of].values[k]));
        differs_.of[of].values[k] = differs ? 1.0F : 0.0F;
        any = any || differs;
    });
    if (!any) return;
    for (std::size_t k = 0; k < static_cast<std::size_t>(MotionMeasure::difference); ++k)
        sums_.of[k] = own_.of[k];
    sum(size, differs_, tried_, MotionMeasure::difference);
    take_better(1.0F);
}

/// Chooses for each part its own way, a neighbour's or none: search and steps may fail. Plain parts
/// keep theirs, which is not of their own pixels.
void MotionEstimator::choose(std::size_t size) {
    best_.resize(from_.cells.columns, from_.cells.rows);
    best_.fill(std::numeric_limits<float>::infinity());
    differs_.resize(from_.cells.columns, from_.cells.rows);
    tried_ = ways_;
    chosen_ = ways_;
    sum(size, wanted_, ways_, MotionMeasure::difference);
    own_ = sums_;
    take_better(kOwnShare);
    tried_.fill(0.0F);
    attempt(size);
    for (const auto& [right, down] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        propose(kNeighbour * right, kNeighbour * down);
        attempt(size);
    }
    std::swap(ways_, chosen_);
}

/// Judges by how much better a part, with those around it, fits with its way than without.
void MotionEstimator::judge() {
    tried_.fill(0.0F);
    sum(0, wanted_, tried_, MotionMeasure::difference);
    gather(kJudges, MotionMeasure::difference);
    from_.cells.each_part([this](const MotionPart& part, std::size_t k) {
        still_.of[part.part].values[k] =
            gathered_.is_known(part.part, k) ? gathered_.mean_square(part.part, k) : kCoveredSquare;
    });
    sum(0, wanted_, ways_, MotionMeasure::difference);
    gather(kJudges, MotionMeasure::difference);
    for (auto& verdicts : verdicts_)
        verdicts.assign(from_.cells.threshold.values.size(), Verdict::stays);
    from_.cells.each_part([this](const MotionPart& part, std::size_t k) {
        if (!(wanted_.of[part.part].values[k] > 0.0F) || !gathered_.is_known(part.part, k)) return;
        const float left = gathered_.mean_square(part.part, k);
        const float better = still_.of[part.part].values[k] - left;
        const Way way = way_of(part);
        const bool enough = gathered_[MotionSum::n].of[part.part].values[k] > kSurePixels;
        if (enough && better > kSure * (left + kSureFloor) &&
            std::hypot(way.right, way.down) > kSureWay_px)
            verdict(part) = Verdict::goes;
        else if (better > kLikely * (left + kLikelyFloor))
            verdict(part) = Verdict::may_go;
    });
}

/// From parts that surely move on: a similar neighbour that may move does, and plain ones, up to
/// kMostPlain cells away.
void MotionEstimator::confirm_neighbours() {
    std::deque<Confirmed> sure;
    from_.cells.each_part([this, &sure](const MotionPart& part, std::size_t) {
        if (verdict(part) == Verdict::goes) sure.push_back({part, 0});
    });
    for (; !sure.empty(); sure.pop_front()) {
        const Confirmed at = sure.front();
        from_.cells.each_alike(at.part, [&](const MotionPart& part, std::size_t k, float) {
            if (verdict(part) == Verdict::goes) return;
            const bool may_go = verdict(part) == Verdict::may_go;
            if (!may_go && (at.plain >= kMostPlain || !plain_.has(part.part, k))) return;
            verdict(part) = Verdict::goes;
            sure.push_back({part, may_go ? 0 : at.plain + 1});
        });
    }
}

/// Parts that do not surely move stay.
void MotionEstimator::stop_unconfirmed() {
    from_.cells.each_part([this](const MotionPart& part, std::size_t) {
        if (verdict(part) != Verdict::goes) set_way(part, {});
    });
}

std::shared_ptr<const MotionField> MotionEstimator::estimate(const Frame& from, const Frame& to) {
    const auto has_colour = [](const Frame& frame) {
        return frame.colour_of_view && frame.has_colour();
    };
    const bool by_depth = !has_colour(from) || !has_colour(to);
    const auto take = [this, by_depth](const Frame& frame, MotionSide& side) {
        maker_.make(frame, by_depth, side.pictures);
        split_into_cells(side);
    };
    if (from.drawn() == last_depth_ && from.colour_object() == last_colour_ &&
        by_depth == by_depth_)
        std::swap(from_, to_);
    else
        take(from, from_);
    take(to, to_);
    by_depth_ = by_depth;
    last_depth_ = to.drawn();
    last_colour_ = to.colour_object();
    similar_.find(from_.cells);
    gain_ = by_depth ? 1.0F : motion_gain(from_.pictures, to_.pictures);
    wanted_.resize(from_.cells.columns, from_.cells.rows);
    still_.resize(from_.cells.columns, from_.cells.rows);
    ways_.resize(from_.cells.columns, from_.cells.rows);
    even_.resize(from_.cells.columns, from_.cells.rows);
    sums_.resize(from_.cells.columns, from_.cells.rows);
    if (!find_changed()) return nullptr;
    const int reach =
        std::max(1, static_cast<int>(kFarthestMotion * static_cast<double>(from_.cells.columns)));
    searcher_.search(from_, to_, gain_, similar_, plain_, rows_, reach, ways_);
    from_.cells.each_part([this](const MotionPart& part, std::size_t k) {
        if (!(wanted_.of[part.part].values[k] > 0.0F) && !plain_.has(part.part, k))
            set_way(part, {});
    });
    go_downhill(2);
    go_downhill(2);
    go_downhill(kSmall);
    choose(kSmall);
    drop_noise();
    go_downhill(kSmall);
    go_downhill(0);
    judge();
    confirm_neighbours();
    stop_unconfirmed();
    return spread_motion(*from.drawn(), from_.cells, from_.pictures.step, ways_, fields_);
}

}  // namespace dibhr
