// The motion of a hand that explores: its places over the image, how deep it presses, and its goals
// over a moving surface.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/haptics/vec.hpp"
#include "core/video/playing/depth_timeline.hpp"

namespace dibhr {

/// An upright rectangle of the image [px].
struct ImageArea {
    Vec2 centre{0.0};
    Vec2 half_size{0.0};
};

/// The largest rectangle that stands out from the background all the time: all its vertices are
/// above a quarter of the height at ten moments of the clip. A little of its border is left out.
/// The whole image when nothing stands out.
[[nodiscard]] ImageArea foreground_area(const DepthClip& clip);

/// A lifted hand or pen above the surface.
inline constexpr double kLifted_px = 3.0;

/// One entry a millisecond in both vectors.
struct HandMotion {
    std::vector<Vec2> places{};             ///< length units of its own, any origin
    std::vector<double> penetrations_px{};  ///< below the surface; negative: above it
    std::string source{};                   ///< for the report
};

/// Moves and scales the places, x and y alike, so that their bounding box fills the area as far as
/// it can. Throws InputError when they do not move at all.
void fit_into(HandMotion& motion, const ImageArea& area);

/// The human path: goals at the motion's places, now in the image, as deep below the surface as the
/// motion presses at that time; surveyed.
[[nodiscard]] PathRun human_path(const HandMotion& motion, const DepthClip& clip, double mu);

/// Strokes along arcs of ellipses in the area, one after the other, with pauses between them.
/// - Each stroke starts and ends at rest with a minimum-jerk course (Flash and Hogan 1985).
/// - Along it the speed is a smooth envelope times curvature^(-1/3): the two-thirds power law
///   (Lacquaniti, Terzuolo and Viviani 1983).
/// - Physiological tremor of 8 to 12 Hz rides on it, below a tenth of a millimetre on a Falcon.
/// - It presses 6 to 20 px deep and lifts off during some of the pauses.
/// The same `seed` gives the same motion. Places are in the pixels of `area`.
[[nodiscard]] HandMotion modelled_hand(const ImageArea& area, int updates = kExperimentUpdates,
                                       std::uint64_t seed = 1);

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
/// Throws InputError naming file and line for a column that is missing or there twice, a value that
/// is no finite number, a place beyond 1e9, times that fall, or fewer than two different times.
[[nodiscard]] std::vector<TraceSample> read_trace(const std::filesystem::path& file);

/// The trace at one update a millisecond: rows at one time (to the nanosecond) become their mean, a
/// pause becomes a smooth way of at most half a second, and what is shorter than `updates` is run
/// back and forth. Full pressure is 25 px below the surface, a lifted pen 3 px above it. `samples`
/// as read_trace gives them; `name` is what the report calls it.
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
