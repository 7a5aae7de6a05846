// A hand that explores: where it is over the image and how deep it presses, and the goals that
// makes over a moving surface.
#pragma once

#include <string>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/haptics/vec.hpp"
#include "core/video/depth_in_time.hpp"

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

}  // namespace dibhr
