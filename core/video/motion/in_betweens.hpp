// Makes frames between two frames, in which moving parts are on their way.
#pragma once

#include <memory>
#include <vector>

#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Motion between neighbouring in-betweens, where their number is not limited [px].
inline constexpr double kInBetweenStep_px = 2.0;
/// If no pixel moves as far as this there are no in-betweens [px].
inline constexpr double kLeastMotion_px = 1.5;
/// Most parts of the time between two frames, and most moving pixels of all in-betweens together.
inline constexpr int kMostParts = 8;
inline constexpr int kMostPixelsBetween = 800'000;

/// Makes in-betweens in reused memory.
class InBetweenMaker {
  public:
    InBetweenMaker();
    ~InBetweenMaker();
    InBetweenMaker(InBetweenMaker&&) noexcept;
    InBetweenMaker& operator=(InBetweenMaker&&) noexcept;

    /// In-betweens along `from.motion`, equally spaced in time; null without motion, or if nothing
    /// moves as far as kLeastMotion_px. Both frames have one size and scale. Pixels covered on the
    /// way come from the first frame, uncovered ones from the second; nearer pixels cover farther
    /// ones; pixels that do not move blend. The same frames give the same bits.
    [[nodiscard]] std::shared_ptr<const std::vector<Frame>> make(const Frame& from,
                                                                 const Frame& to);

  private:
    class Warper;
    std::unique_ptr<Warper> warper_;
};

}  // namespace dibhr
