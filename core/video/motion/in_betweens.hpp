// Frames between two frames, in which what moves is on its way.
#pragma once

#include <memory>
#include <vector>

#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// How far what is seen moves from one to the next, where there are enough of them [px].
inline constexpr double kBetween_px = 2.0;
/// Where nothing goes as far as this there are none [px].
inline constexpr double kWorthIt_px = 1.5;
/// So many parts, at most, the time between two frames falls into; of many pixels that move, fewer.
inline constexpr int kMostParts = 8;
inline constexpr int kMostPixelsBetween = 800'000;

/// Makes them, each from memory that was used before.
class InBetweenMaker {
  public:
    InBetweenMaker();
    ~InBetweenMaker();
    InBetweenMaker(InBetweenMaker&&) noexcept;
    InBetweenMaker& operator=(InBetweenMaker&&) noexcept;

    /// Equally spaced in time, as `from.motion` says; null where it says nothing, or nothing goes
    /// as far as kWorthIt_px. Both frames are of one size and scale. What is covered on the way
    /// comes from the first and what is uncovered from the second; the nearer covers the farther;
    /// what does not move blends from the one to the other. The same frames give the same bits.
    [[nodiscard]] std::shared_ptr<const std::vector<Frame>> between(const Frame& from,
                                                                    const Frame& to);

  private:
    class Mover;
    std::unique_ptr<Mover> mover_;
};

}  // namespace dibhr
