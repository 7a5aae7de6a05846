// Medians, means and variances of rows over time, as the filter in time takes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/single_frame_depth.hpp"

/// Each loop does the same to every pixel of a row. Levels are those of DepthImage; weights count
/// frames; `per_bound` is 1 over the deviations from kMixes to kApart.
namespace dibhr::in_time {

/// From kMixes deviations on levels mix ever less, and from kApart on not at all.
inline constexpr float kMixes = 2.0F, kApart = 4.0F;
/// Bounds; beyond, a level is another surface and not noise.
inline constexpr float kSurely = 2.0F;
inline constexpr std::uint8_t kSurelyOther = 3;  ///< mark: another surface, and not noise; 1: maybe
inline constexpr float kMostMisfit = 2.5F;  ///< a deviation of kApart - kMixes; outliers are more

using Four = std::array<const float*, 4>;
using FourFilled = std::array<const std::uint8_t*, 4>;
using Near = std::array<const float*, 2 * kNearInTime + 1>;

/// Medians of five frames, or of three.
void medians(const float* a, const float* b, const float* c, const float* d, const float* e,
             float* out, std::size_t count);
void medians(const float* a, const float* b, const float* c, float* out, std::size_t count);

/// Where a neighbour has no level, the reference becomes the frame's own level.
void take_where_missing(const float* levels, const float* here, float* reference,
                        std::size_t count);

/// Marks levels of another surface than the reference: kSurelyOther, or 1. Returns whether there
/// are any.
[[nodiscard]] bool mark_other(const float* levels, const float* reference, const NoiseBound& bound,
                              std::uint8_t* marks, std::size_t count);

/// Removes the marks of filled pixels.
void unmark(const std::uint8_t* filled, std::uint8_t* marks, std::size_t count);

/// 1 over the bound at each level.
void invert(const float* reference, const NoiseBound& bound, float* per_bound, std::size_t count);

/// Four frames at once: sums and weights are read and written a quarter as often. `filled`: 1
/// counts for little.
void add_four(const Four& rows, const float* reference, const float* per_bound, float* sum,
              float* weights, float* squares, std::size_t count);
void add_four(const Four& rows, const FourFilled& filled, const float* reference,
              const float* per_bound, float* sum, float* weights, float* squares,
              std::size_t count);

/// One frame, likewise.
void add_one(const float* levels, const float* reference, const float* per_bound, float* sum,
             float* weights, float* squares, std::size_t count);
void add_one(const float* levels, const std::uint8_t* filled, const float* reference,
             const float* per_bound, float* sum, float* weights, float* squares, std::size_t count);

/// All of the nearest frames at once, to sums of 0: the most common case.
void add_near_frames(const Near& rows, const float* reference, const float* per_bound, float* sum,
                     float* weights, float* squares, std::size_t count);

/// Groups of frames, whose levels have half the deviation, each with its weight.
void add_group(const float* levels, float weight, const float* reference, const float* per_bound,
               float* sum, float* weights, std::size_t count);
void add_four_groups(const Four& rows, const std::array<float, 4>& each, const float* reference,
                     const float* per_bound, float* sum, float* weights, std::size_t count);

/// Sums of how a group differs from the reference, by column.
void add_differences(const float* levels, const float* reference, const float* per_bound,
                     float* off, float* squared, float* counted, std::size_t count);

/// Squares of how far levels are from a reference, in parts of the bound, by column.
void add_misfit(const float* levels, const float* reference, const float* per_bound, float* squared,
                float* counted, std::size_t count);

/// The mean: the reference and the weighted mean of the differences from it.
void divide(const float* reference, const float* sum, const float* weights, float* out,
            std::size_t count);

/// Adds the variances of a row's pixels, by column, and counts those that have one.
void add_variances(const float* sum, const float* weights, const float* squares, float* variances,
                   float* counted, std::size_t count);

}  // namespace dibhr::in_time
