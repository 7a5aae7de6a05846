// Averages four frames where they differ within the noise.
#include "core/video/cleaning/frame_groups.hpp"

#include <algorithm>
#include <utility>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// Deviations between the lowest and the highest of four levels: noise is beyond it once in 10,000.
constexpr float kMostApart = 6.4F;
constexpr float kMiddle = 0.5F * static_cast<float>(kGroupInTime - 1);

DIBHR_VECTOR_CLONES void average_four(const float* a, const float* b, const float* c,
                                      const float* d, const NoiseBound& deviation,
                                      float* __restrict out, std::size_t count) {
    const NoiseBound of = deviation;
    for (std::size_t i = 0; i < count; ++i) {
        const float least = std::min(std::min(a[i], b[i]), std::min(c[i], d[i]));
        const float most = std::max(std::max(a[i], b[i]), std::max(c[i], d[i]));
        const float mean = 0.25F * ((a[i] + b[i]) + (c[i] + d[i]));
        out[i] = most - least < kMostApart * of(mean) ? mean : FrameGroups::kNoLevel;
    }
}

DIBHR_VECTOR_CLONES void leave_out(const std::uint8_t* filled, float* __restrict levels,
                                   std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        levels[i] = filled[i] != 0 ? FrameGroups::kNoLevel : levels[i];
}

}  // namespace

std::span<const FrameGroup> FrameGroups::around(std::span<const SingleFrameDepth* const> frames,
                                                std::size_t now, const NoiseBound& noise,
                                                std::span<const PictureWay> ways) {
    if (noise != std::exchange(noise_, noise)) groups_.clear();
    const std::size_t first = now - std::min(now, kReachInTime);
    const std::size_t end = std::min(frames.size(), now + kReachInTime + 1);
    const auto group_at = [&](std::size_t k) {
        const std::int64_t number = frames[k]->number;
        return (number < 0 ? static_cast<std::int64_t>(k) : number) /
               static_cast<std::int64_t>(kGroupInTime);
    };
    kept_.clear();
    around_.clear();
    for (std::size_t k = first; k < end;) {
        std::size_t after = k + 1;
        while (after < end && group_at(after) == group_at(k)) ++after;
        const std::size_t begin = std::exchange(k, after);
        const bool near = begin <= now + kNearInTime && now <= after - 1 + kNearInTime;
        if (near || after - begin != kGroupInTime) continue;
        Four four{};
        std::copy_n(frames.begin() + static_cast<std::ptrdiff_t>(begin), kGroupInTime,
                    four.begin());
        const auto is_alike = [&](const SingleFrameDepth* one) {
            return are_alike(one->depth, frames[now]->depth);
        };
        if (!std::all_of(four.begin(), four.end(), is_alike)) continue;
        Shifts shifts{};
        PictureWay mean{};
        for (std::size_t n = 0; !ways.empty() && n < kGroupInTime; ++n) {
            const PictureWay& way = ways[begin + n];
            shifts[n] = rounded({way.right - ways[begin].right, way.down - ways[begin].down});
            mean.right += 0.25F * (way.right - static_cast<float>(shifts[n].right));
            mean.down += 0.25F * (way.down - static_cast<float>(shifts[n].down));
        }
        around_.push_back({group_of(four, shifts, noise),
                           static_cast<float>(begin) - static_cast<float>(now) + kMiddle,
                           static_cast<float>(kGroupInTime), rounded(mean)});
    }
    // Those that are near now are far again soon.
    const auto is_left = [&](const Group& group) {
        return std::any_of(frames.begin() + static_cast<std::ptrdiff_t>(first),
                           frames.begin() + static_cast<std::ptrdiff_t>(end),
                           [&](const SingleFrameDepth* one) { return one->id == group.ids[0]; });
    };
    const auto is_shifted_anew = [&](const Group& group) {
        return std::any_of(kept_.begin(), kept_.end(),
                           [&](const Group& kept) { return kept.ids == group.ids; });
    };
    for (Group& group : groups_)
        if (group.ids[0] != 0 && is_left(group) && !is_shifted_anew(group))
            kept_.push_back(std::move(group));
    groups_.swap(kept_);
    balance();
    return around_;
}

/// Groups begin where their numbers do: where they are farther on one side they weigh less, so that
/// what moves evenly is neither late nor early.
void FrameGroups::balance() {
    float before = 0.0F;
    float after = 0.0F;
    for (const FrameGroup& group : around_) (group.later < 0.0F ? before : after) += group.later;
    if (!(before < 0.0F && after > 0.0F)) return;
    const float mean = 0.5F * (after - before);
    for (FrameGroup& group : around_) group.weight *= (group.later < 0.0F ? after : -before) / mean;
}

const float* FrameGroups::group_of(const Four& frames, const Shifts& shifts,
                                   const NoiseBound& noise) {
    Group made;
    made.shifts = shifts;
    for (std::size_t k = 0; k < kGroupInTime; ++k) made.ids[k] = frames[k]->id;
    const bool is_known = std::find(made.ids.begin(), made.ids.end(), 0U) == made.ids.end();
    const auto found = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
        return is_known && group.ids == made.ids && group.shifts == made.shifts;
    });
    Group& group = found == groups_.end() ? kept_.emplace_back(std::move(made))
                                          : kept_.emplace_back(std::move(*found));
    if (found != groups_.end()) {
        found->ids = {};
        return group.levels.data();
    }
    group.levels.resize(frames[0]->depth.levels.size());
    average(frames, shifts, noise, group.levels.data());
    return group.levels.data();
}

void FrameGroups::average(const Four& frames, const Shifts& shifts, const NoiseBound& noise,
                          float* out) {
    const DepthImage& size = frames[0]->depth;
    const auto columns = static_cast<std::size_t>(size.columns);
    row_.resize(kGroupInTime * columns);
    filled_row_.resize(columns);
    for (int j = 0; j < size.rows; ++j, out += columns) {
        std::array<const float*, kGroupInTime> rows{};
        for (std::size_t k = 0; k < kGroupInTime; ++k)
            rows[k] = shifted_row(frames[k]->depth.levels.data(), size, shifts[k], j, 0, columns,
                                  kNoLevel, row_.data() + k * columns);
        average_four(rows[0], rows[1], rows[2], rows[3], noise, out, columns);
        for (std::size_t k = 0; k < kGroupInTime; ++k)
            if (!frames[k]->filled.empty())
                leave_out(shifted_row<std::uint8_t>(frames[k]->filled.data(), size, shifts[k], j, 0,
                                                    columns, 1, filled_row_.data()),
                          out, columns);
    }
}

}  // namespace dibhr
