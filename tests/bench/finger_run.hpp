// Moves a finger over a recording, and measures what it feels.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/haptics/vec.hpp"
#include "core/video/frames/frame_window.hpp"
#include "tests/bench/lost_contact.hpp"

namespace dibhr::bench {

/// The run of a finger, an entry a millisecond.
struct FingerRun {
    std::vector<Vec3> goals{};  ///< grid space
    std::vector<Vec3> proxies{};
    std::vector<Vec3> forces_newton{};
    std::vector<double> depths_px{};  ///< of the goal below the surface above it; not below 0
    std::vector<char> contact{};
    std::vector<char> near_cliff{};
};

/// Whether a triangle of the surface has a slope above 3, of those in cells whose middle is within
/// 6 px of `place`.
[[nodiscard]] bool is_near_cliff(const DepthSurface& surface, Vec2 place);

/// Where on the image the finger is, after so many milliseconds.
using Path = std::function<Vec2(std::size_t)>;

/// Presses into the frames, blended in time, along `path`, from the first frame on. The hand's
/// position is prescribed; no device yields to the force, which is therefore an upper bound.
[[nodiscard]] FingerRun press(std::span<const Frame> frames, std::size_t milliseconds,
                              double time_constant_s, const Path& path,
                              const TouchParameters& parameters);

/// The numbers of one way to touch a recording.
struct FeelNumbers {
    double buzz_newton{0.0};  ///< RMS of the force from 30 to 500 Hz
    double step_p99{0.0};     ///< of the force's change [N/ms]
    double step_p999{0.0};
    double stuck{0.0};    ///< share of the time in which the proxy stands still
    double contact{0.0};  ///< share of the time
    double seconds{0.0};  ///< that all this is taken over
    LostContact lost{};
};

/// Share of the time with data under the finger: without what was lost where there was none (hole,
/// unseen, gone). 1 where there never was any.
[[nodiscard]] double contact_beside_holes(const FeelNumbers& numbers);

/// Sums the numbers over several fingers.
class FeelSums {
  public:
    /// Without the milliseconds marked in `left_out`; empty: none are.
    void add(const FingerRun& finger_run, std::span<const char> left_out, const LostContact& lost);
    [[nodiscard]] FeelNumbers numbers() const;

  private:
    std::vector<double> steps_{};
    double squares_{0.0};  ///< of the force in the band
    std::size_t milliseconds_{0};
    std::size_t in_contact_{0};
    std::size_t still_{0};
    LostContact lost_{};
};

}  // namespace dibhr::bench
