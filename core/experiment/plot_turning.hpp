// One panel: how much an algorithm's force turns from update to update.
#pragma once

#include <cstddef>
#include <string>

#include "core/experiment/experiment.hpp"
#include "core/plot/axes.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

/// From `first` up to, not including, `end`.
struct UpdateSpan {
    std::size_t first{0};
    std::size_t end{0};
};

/// One update is a millisecond.
[[nodiscard]] inline double seconds_of(std::size_t update) noexcept {
    return 1e-3 * static_cast<double>(update);
}

/// Three tenths of a second of a path that repeats itself, after it settled; the whole of an
/// exploration.
[[nodiscard]] UpdateSpan shown_updates(const PathRun& path);

[[nodiscard]] Axis time_axis(UpdateSpan updates, bool numbered);

/// A round number above nearly every turn of every algorithm in the updates shown [deg].
[[nodiscard]] double highest_turn_deg(const PathRun& path);

/// "turns 4.13 deg an update (sd 6.77), sliding 3.90 (sd 2.10)": over all updates, and without
/// those in which the hand reverses.
[[nodiscard]] std::string turning_words(const VariationStatistics& variation);

/// "3.90 (sd 2.10)": the second half of the above.
[[nodiscard]] std::string sliding_words(const VariationStatistics& variation);

struct TurningScale {
    double highest_deg{1.0};
    bool numbered{true};  ///< the time axis
};

void draw_turning(Canvas& canvas, Box area, const PathRun& path, const AlgorithmRun& run,
                  TurningScale scale);

/// Friction, depth and where the goals come from.
[[nodiscard]] std::string settings_of(const PathRun& path);

}  // namespace dibhr
