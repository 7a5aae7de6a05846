// Frames between two frames, in which what moves is on its way.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/video/frame_window.hpp"

namespace dibhr {

/// How far what is seen moves from one to the next, where there are enough of them [px].
inline constexpr double kBetween_px = 2.0;
/// So many parts, at most, the time between two frames falls into; of many pixels that move, fewer.
inline constexpr int kMostParts = 8;
inline constexpr std::size_t kMostPixelsBetween = 800'000;

/// Equally spaced in time, as `from.motion` says; null where it says nothing, or nothing goes as
/// far as kBetween_px. Both frames are of one size and scale. What is covered on the way comes from
/// the first and what is uncovered from the second; the nearer covers the farther; what does not
/// move blends from the one to the other. The same frames give the same bits.
[[nodiscard]] std::shared_ptr<const std::vector<Frame>> in_betweens_of(const Frame& from,
                                                                       const Frame& to);

}  // namespace dibhr
