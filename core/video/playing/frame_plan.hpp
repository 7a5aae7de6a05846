// Decides which frames of a video are shown, and how fast its clock runs, on a machine that is too
// slow for all of them.
#pragma once

#include <string>

namespace dibhr {

/// Measured times of the steps [s], while all threads run. The decoding thread decodes and
/// converts, the reading thread cleans. Where there are no processors to spare, as beside drawing
/// in software on two, a thread that runs takes its time from the other.
struct FrameCosts {
    double decoding_s{0.0};    ///< of each frame, also of one that is left out
    double conversion_s{0.0};  ///< in addition of a shown frame
    double cleaning_s{0.0};    ///< of a shown frame
    bool side_by_side{false};  ///< the threads do not slow each other down
};

struct FramePlan {
    double every{1.0};  ///< one of so many frames is shown, evenly; 1: all
    double speed{1.0};  ///< of the clock, at most the requested speed
    /// Frames are left out, or the clock is slower than requested: there is no time for motion.
    bool overloaded{false};

    bool operator==(const FramePlan&) const = default;
};

/// If a faster clock costs more than this share of the frames shown per second, the plan slows the
/// clock instead. So those frames never fall by more than this while the requested speed rises.
inline constexpr double kMostLost = 0.05;

/// Time that the slower thread takes for a shown frame, if one of `every` frames is shown [s].
[[nodiscard]] double frame_time_s(const FrameCosts& costs, double every) noexcept;

/// The fastest clock, up to the requested `speed`, at which at most kMostLost fewer frames are
/// shown per second than at any slower clock. `interval_s`: from frame to frame of the video; 0:
/// not known, and all frames are shown. The result is `last` where that still nearly holds.
[[nodiscard]] FramePlan plan_of(const FrameCosts& costs, double interval_s, double speed,
                                const FramePlan& last = {}) noexcept;

/// The mean with the newest value, which counts as twice the mean at most: a single slow frame
/// changes the mean by a fifth. 0: no value yet.
[[nodiscard]] double steady_mean(double mean, double newest) noexcept;

/// What the plan drops and why, as a sentence: "Shown 15 of 30 frames a second: cleaning takes
/// 40 ms a frame." Empty: nothing is dropped. `frames_per_s`: of the video; `speed`: as requested.
[[nodiscard]] std::string in_words(const FramePlan& plan, const FrameCosts& costs,
                                   double frames_per_s, double speed);

/// The media time from which the frame after the one at `media_s` is shown: one frame of each
/// `spacing_s` of the media is, so frames are even also where `spacing_s` is no multiple of their
/// interval. `spacing_s` <= 0: all are shown.
[[nodiscard]] double next_shown_s(double media_s, double spacing_s) noexcept;

}  // namespace dibhr
