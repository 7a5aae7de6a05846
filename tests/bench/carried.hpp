// How motion that was found in pictures carries a finger: the whole update over a camera's frames
// of a moving object, compared with the same update over the true scene.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "tests/core/video/moving_scene.hpp"

namespace dibhr::bench {

/// What was filmed.
struct Filming {
    double frames_per_s{30.0};
    double seconds{1.0};            ///< how long a finger is carried
    double brightness_levels{2.0};  ///< standard deviation of its noise, of 255
    double elevation_px{0.0};       ///< and of the depth's, of 255
    double exposure{0.0};           ///< how far it swings (CameraNoise)
    bool coded{true};               ///< the colour, by H.264
    bool found{true};               ///< motion is found in the pictures; false: the true one
    bool carry{true};               ///< the finger is carried at all
};

/// NaN: nothing was there to be measured.
struct CarriedFinger {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    /// Distance at the end between a finger that sticks, and moves along, and its material point
    /// [px]: the median and the worst over fingers on the object that stay in the picture and are
    /// not faster than the scene's speed.
    double astray_px{kNone};
    double worst_astray_px{kNone};
    /// A finger that rests with friction 0.4, 20 px deep, while the object moves below it: the
    /// angle between its force and that over the true scene [deg], median over updates, then over
    /// fingers.
    double turned_deg{kNone};
    /// Its drag, the part of the force along the object's motion, as a share of that over the true
    /// scene.
    double drag_share{kNone};
    /// Fingers that were carried to the end.
    int fingers{0};
};

/// How far fingers that stick are from their material points [px], after so long.
struct Astray {
    double after_s{0.0};
    double median_px{CarriedFinger::kNone};
    double worst_px{CarriedFinger::kNone};
    int fingers{0};
};
/// After each of these times, of the fingers that are carried to the last one.
[[nodiscard]] std::vector<Astray> astray_after(const test::MovingScene& scene,
                                               const Filming& filming,
                                               std::span<const double> times_s);

[[nodiscard]] CarriedFinger carried_finger(const test::MovingScene& scene, const Filming& filming);

}  // namespace dibhr::bench
