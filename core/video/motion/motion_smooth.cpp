// Smooths ways: the way of even motion at a part, from the parts around it.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/video/frames/vector_clones.hpp"
#include "core/video/motion/motion_cells.hpp"

namespace dibhr {

namespace {

constexpr int kReach = SimilarParts::kReach;
constexpr std::size_t kAround = std::size_t{2 * kReach + 1} * std::size_t{2 * kReach + 1};
constexpr std::size_t kLanes = 8;
static_assert(kLanes <= SimilarParts::kMargin);

using Lanes [[gnu::vector_size(kLanes * sizeof(float))]] = float;

/// The neighbours of each near part: for every tap similarity and offset; for every part its
/// weight, and its way times that weight.
struct About {
    std::array<const float*, kAround> alike{};
    std::array<std::ptrdiff_t, kAround> away{};
    const float* weight{nullptr};
    const float* right{nullptr};
    const float* down{nullptr};
};

// Always inline: only code inside DIBHR_VECTOR_CLONES functions is compiled for wider vectors.

[[gnu::always_inline]] inline void load(Lanes& lanes, const float* from) {
    std::memcpy(&lanes, from, sizeof(lanes));
}

/// Moments of kLanes parts from `at` on.
[[gnu::always_inline]] inline void sum_moments(const About& about, std::size_t at,
                                               MotionMoments<float>* to) {
    MotionMoments<Lanes> sums;
    std::size_t tap = 0;
    for (int v = -kReach; v <= kReach; ++v)
        for (int u = -kReach; u <= kReach; ++u, ++tap) {
            const std::ptrdiff_t there = static_cast<std::ptrdiff_t>(at) + about.away[tap];
            Lanes alike, weight, right, down;
            load(alike, about.alike[tap] + at);
            load(weight, about.weight + there);
            load(right, about.right + there);
            load(down, about.down + there);
            sums.add(alike * weight, alike * right, alike * down, static_cast<float>(u),
                     static_cast<float>(v));
        }
    for (std::size_t k = 0; k < kLanes; ++k)
        to[k] = {sums.n[k],       sums.x[k],    sums.y[k],      sums.xx[k],
                 sums.xy[k],      sums.yy[k],   sums.right[k],  sums.right_x[k],
                 sums.right_y[k], sums.down[k], sums.down_x[k], sums.down_y[k]};
}

DIBHR_VECTOR_CLONES void sum_all_moments(const About& about, std::size_t count,
                                         MotionMoments<float>* to) {
    for (std::size_t at = 0; at < count; at += kLanes) sum_moments(about, at, to + at);
}

/// The value at the place itself of the plane fitted to all ways around. If they all lie on a line
/// the plane is level across it.
void plane_through(const MotionMoments<float>& moments, float& right, float& down) {
    constexpr float kRidge = 0.3F;  // else ways on one side only would tilt the plane by noise
    const float share = 1.0F / moments.n;
    const float x = moments.x * share;
    const float y = moments.y * share;
    const float xx = moments.xx * share - x * x + kRidge;
    const float xy = moments.xy * share - x * y;
    const float yy = moments.yy * share - y * y + kRidge;
    const float per_det = 1.0F / (xx * yy - xy * xy);
    const auto at_place = [&](float sum, float sum_x, float sum_y) {
        const float mean = sum * share;
        const float by_x = sum_x * share - mean * x;
        const float by_y = sum_y * share - mean * y;
        return mean - per_det * (x * (yy * by_x - xy * by_y) + y * (xx * by_y - xy * by_x));
    };
    right = at_place(moments.right, moments.right_x, moments.right_y);
    down = at_place(moments.down, moments.down_x, moments.down_y);
}

}  // namespace

void SimilarParts::add_near_moments(const MotionLayers& wanted, const MotionWays& ways) {
    const std::size_t margin = kReach * (static_cast<std::size_t>(columns_) + 1);
    for (auto& plane : padded_) plane.assign(count_ + 2 * margin + kMargin, 0.0F);
    for (std::size_t k = 0; k < count_; ++k) {
        const float weight = wanted.of[0].values[k];
        padded_[0][margin + k] = weight;
        padded_[1][margin + k] = weight * ways.right.of[0].values[k];
        padded_[2][margin + k] = weight * ways.down.of[0].values[k];
    }
    About about;
    about.weight = padded_[0].data() + margin;
    about.right = padded_[1].data() + margin;
    about.down = padded_[2].data() + margin;
    std::size_t tap = 0;
    for (int down = -kReach; down <= kReach; ++down)
        for (int right = -kReach; right <= kReach; ++right, ++tap) {
            about.alike[tap] = near_beside(right, down);
            about.away[tap] = std::ptrdiff_t{down} * columns_ + right;
        }
    sum_all_moments(about, count_, moments_[0].data());
}

void SimilarParts::add_far_moments(const MotionLayers& wanted, const MotionWays& ways) {
    for (const std::uint32_t k : split_) moments_[1][k] = {};
    for (const auto& edges : far_)
        for (const Edge& edge : edges) {
            const float weight = edge.alike * wanted.of[edge.from_part].values[edge.from];
            moments_[edge.to_part][edge.to].add(
                weight, weight * ways.right.of[edge.from_part].values[edge.from],
                weight * ways.down.of[edge.from_part].values[edge.from],
                static_cast<float>(edge.right), static_cast<float>(edge.down));
        }
}

void SimilarParts::smooth(const MotionLayers& wanted, const MotionWays& from, MotionWays& to) {
    to = from;
    for (auto& moments : moments_) moments.resize(count_ + kMargin);
    add_near_moments(wanted, from);
    add_far_moments(wanted, from);
    const auto fit = [&](std::size_t part, std::size_t k) {
        if (wanted.of[part].values[k] > 0.0F)
            plane_through(moments_[part][k], to.right.of[part].values[k],
                          to.down.of[part].values[k]);
    };
    for (std::size_t k = 0; k < count_; ++k) fit(0, k);
    for (const std::uint32_t k : split_) fit(1, k);
}

}  // namespace dibhr
