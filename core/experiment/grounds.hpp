// Grounds: the test surfaces on which algorithms are timed, from bit-flat to a moving person, with
// paths like a hand's and with jumps of the goal.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/haptics/vec.hpp"
#include "core/video/playing/depth_timeline.hpp"

namespace dibhr {

/// A goal that goes from one place to another between two updates, and back.
struct Jump {
    std::string name{};
    Vec3 from{0.0};  ///< grid space
    Vec3 to{0.0};
};

/// One surface, still or moving, with its paths and jumps. A still one is two equal images, so that
/// an elevation costs as much as while a video plays.
struct Ground {
    std::string name{};
    DepthClip clip;
    /// Linear and, but over the crease, circle, ready for run_algorithms: 4961 px/s, each goal 20
    /// px below the surface of its moment.
    std::vector<PathRun> paths{};
    std::vector<Jump> jumps{};
};

/// One at a time: a large ground takes a quarter of a gigabyte.
using MakeGround = Ground (*)();

/// - bit-flat: every level the same, 720x486 (the paper's) and 7680x4320; jumps across the latter
/// - near-flat: with one level of 16-bit noise: hardly two TRIANGLEs lie in one plane
/// - bumpy: 16-bit waves of a few pixels
/// - bump map: a flat image under 2 px of white noise
/// - crease: rows by turns one 16-bit level higher, 7680x4320; the goal over a row that is a crease
[[nodiscard]] std::span<const MakeGround> made_grounds() noexcept;

/// A video; its image must hold the paper's paths.
[[nodiscard]] Ground video_ground(const std::string& name, DepthClip clip);

/// Back and forth over the paper's image not along a direction of the grid, `step_px` an update.
[[nodiscard]] PathRun slanted_path(const DepthClip& plane, double step_px);

}  // namespace dibhr
