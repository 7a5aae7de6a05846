// Decides how many steps of the cleaning are left out on a machine that is too slow for all frames.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "core/video/frames/cleaning_options.hpp"
#include "core/video/playing/frame_plan.hpp"

namespace dibhr {

/// What the cleaning leaves out at each level, in addition to the levels before: nothing, the
/// filter in time, silhouettes, and what smooths noise, outlines and depth steps.
inline constexpr std::size_t kDegradationLevels = 6;

/// The steps that are left of `steps` at that level, 0 to kDegradationLevels - 1.
[[nodiscard]] CleaningSteps degraded(CleaningSteps steps, std::size_t level) noexcept;

/// What is left out at that level, as a sentence; empty: nothing.
[[nodiscard]] std::string left_out_in_words(const CleaningSteps& steps, std::size_t level);

/// Raises the level while frames take longer than the video has for each. Lowers the level once the
/// time of a frame at the lower one, as it was measured, fits with a reserve for a while: twice as
/// long after each time that it did not fit then, for every change is felt.
class CleaningDegradation {
  public:
    [[nodiscard]] std::size_t level() const noexcept { return level_; }
    /// Whether no step is left that could be left out.
    [[nodiscard]] bool leaves_out_all(const CleaningSteps& steps) const noexcept {
        return next_above(steps) == level_;
    }
    /// After each frame that was read while playing. `steps`: of the cleaning with nothing left
    /// out; `interval_s` from frame to frame of the video, 0: not known; `speed` as requested. True
    /// when the level has changed: the costs begin anew.
    bool update(const CleaningSteps& steps, const FrameCosts& costs, double interval_s,
                double speed) noexcept;

  private:
    static constexpr int kPatience = 16;

    void change_to(std::size_t level) noexcept;
    [[nodiscard]] std::size_t next_above(const CleaningSteps& steps) const noexcept;
    [[nodiscard]] std::size_t next_below(const CleaningSteps& steps) const noexcept;

    std::size_t level_{0};
    int frames_{0};            ///< since the last change
    int fitting_{0};           ///< the last frames for which the lower level would have fitted
    int patience_{kPatience};  ///< so many must fit
    bool returned_{false};     ///< the last change lowered the level
    /// The time of a frame at a level, to that at the level after; 0: not measured.
    std::array<double, kDegradationLevels> times_as_long_{};
    std::size_t raised_from_{0};
    double before_s_{0.0};  ///< the time of a frame before the level was raised; 0: it was not
};

}  // namespace dibhr
