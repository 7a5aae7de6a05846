// Decides how often the window draws while frames are late.
#pragma once

#include <string>

#include "core/video/playing/frame_plan.hpp"

namespace dibhr {

/// What drawing takes, as the window measures it.
struct DrawingCost {
    double picture_s{0.0};  ///< processor time of a picture, of all threads that draw; 0: not known
    double share{0.0};      ///< of the time of all processors, in [0, 1]
};

/// Where frames take longer than the video has for each, and drawing takes a fifth of the
/// processors or more, the window draws less often, and coarsely. It draws as before once the time
/// of a frame then, as it was measured, fits with a reserve.
class DrawingRate {
  public:
    static constexpr double kFewest_per_s = 10.0;
    static constexpr double kMostOfFew_per_s = 15.0;

    /// Coarse pictures a second that the window draws at most; 0: as many as it likes.
    [[nodiscard]] double most_per_s() const noexcept { return most_per_s_; }
    /// After each frame that was read while playing, of whose cleaning no more can be left out.
    /// `interval_s` from frame to frame of the video, 0: not known; `speed` as requested.
    void update(const DrawingCost& drawing, const FrameCosts& costs, double interval_s,
                double speed) noexcept;
    /// As a sentence; empty: the window draws as often as it likes.
    [[nodiscard]] std::string in_words() const;

  private:
    double most_per_s_{0.0};
    int frames_{0};              ///< since the last change, or for which another one was due
    double before_s_{0.0};       ///< the time of a frame before the last change; 0: it was compared
    double times_as_long_{1.0};  ///< the time of a frame while the window draws, to that now
};

}  // namespace dibhr
