// Ways of plain parts: they are spread within a surface from its outlines.
#include "core/video/motion/motion_plain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>

namespace dibhr {

namespace {

constexpr float kPlain = 4.0F;  // squared slope in every direction below which a part is plain
constexpr float kLeastPixels = 16.0F;  // else a part's colour is not known
constexpr float kGrain = 3.0F;         // squared slope that noise and codecs make
constexpr float kEven = 300.0F;        // weight of a neighbour's way, against squared slopes
constexpr float kHold = 0.1F;          // and of the present way
constexpr float kOver = 1.6F;          // over-relaxation
constexpr int kSweeps = 2;             // forth and back
constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

enum class Colour : std::uint8_t { unknown, plain, textured };

Colour colour_of(const MotionSums& structure, std::size_t part, std::size_t k) {
    const float n = structure[MotionSum::n].of[part].values[k];
    if (!(n > kLeastPixels)) return Colour::unknown;
    const auto mean = [&](MotionSum sum) { return structure[sum].of[part].values[k] / n; };
    const float x = mean(MotionSum::x);
    const float y = mean(MotionSum::y);
    const float xx = mean(MotionSum::xx) - x * x;
    const float xy = mean(MotionSum::xy) - x * y;
    const float yy = mean(MotionSum::yy) - y * y;
    const float least = 0.5F * (xx + yy) - std::sqrt(0.25F * (xx - yy) * (xx - yy) + xy * xy);
    return least < kPlain ? Colour::plain : Colour::textured;
}

}  // namespace

void PlainParts::Equation::hold_at(const Way& way, float weight) {
    xx += weight;
    yy += weight;
    right += weight * way.right;
    down += weight * way.down;
}

PlainParts::Equation PlainParts::Equation::solved() const {
    const float per_det = 1.0F / (xx * yy - xy * xy);
    return {.xx = per_det * yy,
            .xy = -per_det * xy,
            .yy = per_det * xx,
            .right = per_det * (yy * right - xy * down),
            .down = per_det * (xx * down - xy * right)};
}

void PlainParts::clear(const MotionCells& cells) {
    is_plain_.resize(cells.columns, cells.rows);
    is_plain_.fill(0.0F);
    parts_.clear();
    others_.clear();
    edges_.clear();
    groups_ = 0;
}

void PlainParts::find(const MotionCells& cells, const MotionLayers& changed,
                      const MotionSums& structure, int reach) {
    clear(cells);
    struct Reached {
        MotionPart part;
        int steps;
    };
    std::deque<Reached> reached;
    const auto add = [&](const MotionPart& part, std::size_t k) {
        is_plain_.of[part.part].values[k] = 1.0F;
        parts_.push_back({.part = part.part,
                          .k = k,
                          .has_outline = part.part == 0 && cells.has(1, part.i, part.j)});
    };
    const auto has_changed = [&](std::size_t part, std::size_t k) {
        return changed.of[part].values[k] > 0.0F;
    };
    std::vector<MotionPart> beside;  // plain ones that have not changed
    cells.each_part([&](const MotionPart& part, std::size_t k) {
        if (colour_of(structure, part.part, k) != Colour::plain) return;
        if (!has_changed(part.part, k)) return beside.push_back(part);
        add(part, k);
        reached.push_back({part, 0});
    });
    for (const MotionPart& part : beside) {
        bool is_beside = false;
        cells.each_alike(part, [&](const MotionPart& other, std::size_t k, float) {
            is_beside = is_beside || has_changed(other.part, k);
        });
        if (!is_beside) continue;
        add(part, cells.threshold.index(part.i, part.j));
        reached.push_back({part, 1});
    }
    for (; !reached.empty(); reached.pop_front()) {
        const Reached at = reached.front();
        cells.each_alike(at.part, [&](const MotionPart& part, std::size_t k, float) {
            if (has(part.part, k) || colour_of(structure, part.part, k) == Colour::textured) return;
            const int steps = has_changed(part.part, k) ? 0 : at.steps + 1;
            if (steps > reach) return;
            add(part, k);
            reached.push_back({part, steps});
        });
    }
    connect(cells);
    find_groups();
}

/// Finds the neighbours of each plain part.
void PlainParts::connect(const MotionCells& cells) {
    std::array<std::vector<std::uint32_t>, 2> numbers;
    for (auto& of_layer : numbers) of_layer.assign(cells.threshold.values.size(), kNone);
    for (std::size_t p = 0; p < parts_.size(); ++p)
        numbers[parts_[p].part][parts_[p].k] = static_cast<std::uint32_t>(p);
    for (Part& part : parts_) {
        part.begin = edges_.size();
        cells.each_alike(cells.part_at(part.part, part.k), [&](const MotionPart& beside,
                                                               std::size_t k, float alike) {
            std::uint32_t& number = numbers[beside.part][k];
            if (number == kNone) {
                number = static_cast<std::uint32_t>(parts_.size() + others_.size());
                others_.push_back({beside.part, k});
            }
            edges_.push_back({number, alike, 0.0F});
        });
        part.end = edges_.size();
    }
}

void PlainParts::find_groups() {
    std::vector<bool> known(parts_.size(), false);
    std::vector<std::size_t> open;
    for (std::size_t first = 0; first < parts_.size(); ++first) {
        if (known[first]) continue;
        known[first] = true;
        open.push_back(first);
        while (!open.empty()) {
            Part& part = parts_[open.back()];
            open.pop_back();
            part.group = groups_;
            for (std::size_t e = part.begin; e < part.end; ++e) {
                const std::size_t beside = edges_[e].place;
                if (beside >= parts_.size() || known[beside]) continue;
                known[beside] = true;
                open.push_back(beside);
            }
        }
        ++groups_;
    }
}

/// Mean squares at which the outlines of a group get little weight: where all fit badly, as they
/// do at first, they still count against the plain inside.
void PlainParts::find_fits(const MotionSums& sums, const MotionLayers& changed) {
    fits_.assign(groups_, 0.0F);
    std::vector<float> counts(groups_, 0.0F);
    for (const Part& part : parts_) {
        if (!part.has_outline || !(changed.of[part.part].values[part.k] > 0.0F) ||
            !sums.is_known(part.part, part.k))
            continue;
        fits_[part.group] += sums.mean_square(part.part, part.k);
        counts[part.group] += 1.0F;
    }
    for (std::size_t group = 0; group < groups_; ++group)
        fits_[group] = std::max(kMotionFits, fits_[group] / std::max(counts[group], 1.0F));
}

/// By the part's own pixels. Slopes of a colour that are no steeper than noise count as none.
PlainParts::Equation PlainParts::equation_of(const Part& part, const MotionSums& sums,
                                             const Way& now, float scale) const {
    const auto sum = [&](MotionSum which) { return sums[which].of[part.part].values[part.k]; };
    const float n = sum(MotionSum::n);
    const float x = sum(MotionSum::x) / n;
    const float y = sum(MotionSum::y) / n;
    const float xx = sum(MotionSum::xx) - x * sum(MotionSum::x);
    const float yy = sum(MotionSum::yy) - y * sum(MotionSum::y);
    float weight = motion_trust(sums.mean_square(part.part, part.k), fits_[part.group]);
    if (!part.has_outline) weight *= std::max(1.0F - kGrain * n / (xx + yy), 0.0F);
    if (!(weight > 0.0F)) return {};
    const float squared = weight * scale * scale;
    Equation own{.xx = squared * xx,
                 .xy = squared * (sum(MotionSum::xy) - x * sum(MotionSum::y)),
                 .yy = squared * yy};
    own.right = own.xx * now.right + own.xy * now.down -
                weight * scale * (sum(MotionSum::xr) - x * sum(MotionSum::r));
    own.down = own.xy * now.right + own.yy * now.down -
               weight * scale * (sum(MotionSum::yr) - y * sum(MotionSum::r));
    return own;
}

/// Moves each group as a whole to where it fits best.
void PlainParts::move_groups() {
    of_groups_.assign(groups_, {});
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const Part& part = parts_[p];
        const Equation& own = own_[p];
        const Way& way = ways_[p];
        Equation& group = of_groups_[part.group];
        group.xx += own.xx;
        group.xy += own.xy;
        group.yy += own.yy;
        group.right += own.right - own.xx * way.right - own.xy * way.down;
        group.down += own.down - own.xy * way.right - own.yy * way.down;
        for (std::size_t e = part.begin; e < part.end; ++e) {
            const std::size_t place = edges_[e].place;
            if (place < parts_.size()) continue;
            const Way& other = ways_[place];
            group.hold_at({other.right - way.right, other.down - way.down}, edges_[e].weight);
        }
    }
    for (Equation& group : of_groups_) {
        group.hold_at({}, kHold);
        group = group.solved();
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        ways_[p].right += of_groups_[parts_[p].group].right;
        ways_[p].down += of_groups_[parts_[p].group].down;
    }
}

/// Moves a part to where it fits best with its neighbours, and on.
void PlainParts::even_out(std::size_t number) {
    const Equation& fits = solved_[number];
    float right = 0.0F;
    float down = 0.0F;
    for (std::size_t e = parts_[number].begin; e < parts_[number].end; ++e) {
        const Way& beside = ways_[edges_[e].place];
        right += edges_[e].weight * beside.right;
        down += edges_[e].weight * beside.down;
    }
    Way& way = ways_[number];
    way.right += kOver * (fits.right + fits.xx * right + fits.xy * down - way.right);
    way.down += kOver * (fits.down + fits.xy * right + fits.yy * down - way.down);
}

void PlainParts::settle(const MotionSums& sums, const MotionLayers& changed,
                        const MotionLayers& trust, const MotionWays& ways, float scale) {
    const std::size_t count = parts_.size();
    ways_.resize(count + others_.size());
    std::vector<float> weights(count + others_.size(), kEven);
    const auto way_at = [&](std::size_t part, std::size_t k) {
        return Way{ways.right.of[part].values[k], ways.down.of[part].values[k]};
    };
    for (std::size_t p = 0; p < count; ++p) ways_[p] = way_at(parts_[p].part, parts_[p].k);
    for (std::size_t p = 0; p < others_.size(); ++p) {
        const auto& [part, k] = others_[p];
        ways_[count + p] = way_at(part, k);
        if (changed.of[part].values[k] > 0.0F) weights[count + p] *= trust.of[part].values[k];
    }
    find_fits(sums, changed);
    own_.assign(count, {});
    solved_.resize(count);
    for (std::size_t p = 0; p < count; ++p) {
        const Part& part = parts_[p];
        if (changed.of[part.part].values[part.k] > 0.0F && sums.is_known(part.part, part.k))
            own_[p] = equation_of(part, sums, ways_[p], scale);
        Equation all = own_[p];
        all.hold_at(ways_[p], kHold);
        for (std::size_t e = part.begin; e < part.end; ++e) {
            edges_[e].weight = edges_[e].alike * weights[edges_[e].place];
            all.xx += edges_[e].weight;
            all.yy += edges_[e].weight;
        }
        solved_[p] = all.solved();
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        move_groups();
        for (std::size_t p = 0; p < count; ++p) even_out(p);
        for (std::size_t p = count; p-- > 0;) even_out(p);
    }
}

void PlainParts::take(float most, float farthest, MotionWays& ways) const {
    const auto moved = [&](float& way, float to) {
        way = std::clamp(way + std::clamp(to - way, -most, most), -farthest, farthest);
    };
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        moved(ways.right.of[parts_[p].part].values[parts_[p].k], ways_[p].right);
        moved(ways.down.of[parts_[p].part].values[parts_[p].k], ways_[p].down);
    }
}

}  // namespace dibhr
