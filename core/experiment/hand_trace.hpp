// A recorded trace of a person's pen or mouse, and the hand motion it becomes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/experiment/hand_motion.hpp"

namespace dibhr {

/// One row of a trace.
struct TraceSample {
    double t_s{0.0};
    Vec2 place{0.0};       ///< any unit of length, the same for both
    double pressure{0.0};  ///< 0 to 1; half where the trace has none
    bool down{true};
};

/// Reads a CSV file with a header. Columns by name, in any order, more are ignored:
/// - time: t, t_s, time, time_s [s], or t_ms, time_ms [ms]; may repeat, must not fall
/// - place: x_mm and y_mm, or x and y, or x01 and y01
/// - optional: pressure or pressure01 (0 to 1, held in it), pen_down (0 or 1)
/// Throws InputError naming file and line for a missing column, a value that is no finite number,
/// times that fall, or fewer than two different times.
[[nodiscard]] std::vector<TraceSample> read_trace(const std::filesystem::path& file);

/// The trace at one update a millisecond: rows at one time become their mean, a pause becomes a
/// smooth way of at most half a second, and what is shorter than `updates` is run back and forth.
/// Full pressure is 25 px below the surface, a lifted pen 3 px above it. `samples` as read_trace
/// gives them; `name` is what the report calls it.
[[nodiscard]] HandMotion motion_of_trace(const std::vector<TraceSample>& samples,
                                         const std::string& name, int updates = kExperimentUpdates);

/// Monotone piecewise cubic through (t, value): continuous in value and slope, between two samples
/// never outside their values (Fritsch and Butland 1984). Held at both ends.
class SmoothCurve {
  public:
    /// `times` rise strictly; as many values, at least one.
    SmoothCurve(std::vector<double> times, std::vector<double> values);

    [[nodiscard]] double at(double t) const noexcept;

  private:
    std::vector<double> times_;
    std::vector<double> values_;
    std::vector<double> slopes_{};
};

}  // namespace dibhr
