// How a finger is carried by motion that was found in pictures: the whole update over what a camera
// saw of a moving thing, held against the same update over the truth.
#pragma once

#include <limits>

#include "tests/core/video/moving_scene.hpp"

namespace dibhr::bench {

/// What was filmed.
struct Filming {
    double frames_per_s{30.0};
    double seconds{1.0};            ///< how long a finger is carried
    double brightness_levels{2.0};  ///< standard deviation of its noise, of 255
    double elevation_px{0.0};       ///< and of the depth's, of 255
    bool coded{true};               ///< the colour, by H.264
    bool found{true};               ///< the motion, in the pictures; else the true one is taken
    bool carry{true};               ///< what is measured is carried at all
};

/// NaN: there is nothing that this could be measured of.
struct CarriedFinger {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    /// How far a finger that holds on, and goes along, is from its material point at the end [px];
    /// the median over fingers on the thing that stay in the picture and go no faster than asked,
    /// and the worst of them.
    double astray_px{kNone};
    double worst_astray_px{kNone};
    /// A finger that rests with friction 0.4, 20 px deep, while the thing goes on below it: the
    /// angle between its force and the one over the truth [deg], medians over its updates, the
    /// median over fingers.
    double turned_deg{kNone};
    /// And its drag, the part of the force along the way that the thing goes, as a share of that
    /// over the truth.
    double drag_share{kNone};
    /// Fingers that were carried to the end.
    int fingers{0};
};

[[nodiscard]] CarriedFinger carried_finger(const test::MovingScene& scene, const Filming& filming);

}  // namespace dibhr::bench
