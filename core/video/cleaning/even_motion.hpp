// Finds how a small part of an image moves, from two neighbouring frames.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_noise.hpp"

namespace dibhr {

/// Motion from frame to frame [px].
struct EvenMotion {
    int right{0}, down{0};
};

/// Searches even motion: a part was as far to one side in the frame before as it is to the other in
/// the frame after. Up to a fortieth of the image's width a frame. Nine of ten samples of a hand at
/// 0.5 m/s are found, and in most regions none of the pixels that a RealSense or a Kinect flips.
class EvenMotionSearch {
  public:
    struct NeighbourFrame {
        const float* levels;  ///< of a frame of the same size
        int later;            ///< frames after this one; below 0: before it
    };
    /// A pixel that may move.
    struct Sample {
        std::ptrdiff_t at;  ///< its index
        int i, j;           ///< its column and row
        float level;
        float alike;  ///< largest difference of level on the same surface
    };

    /// The frames outlive the search.
    EvenMotionSearch(const DepthImage& here, const NeighbourFrame& a, const NeighbourFrame& b);

    void clear() { samples_.clear(); }
    void add(const Sample& sample) { samples_.push_back(sample); }

    /// The motion by which most samples, at least six of ten, are found in both frames; of equals
    /// the first one. There must be samples, and the first ones should be from the whole region.
    [[nodiscard]] std::optional<EvenMotion> found() const;

    /// The median of a pixel's level in the three frames along the motion. Nothing where the motion
    /// crosses the image's border, or no two levels are alike.
    [[nodiscard]] std::optional<float> level_along(const EvenMotion& motion, int i, int j,
                                                   const NoiseBound& bound) const;

  private:
    struct Best {
        EvenMotion motion{};
        std::size_t count{0};
    };

    void try_around(Best& best, const EvenMotion& middle, int reach_px, int step_px) const;
    [[nodiscard]] std::size_t count_found(const EvenMotion& motion, std::size_t least) const;
    [[nodiscard]] std::ptrdiff_t away(const NeighbourFrame& frame, const EvenMotion& motion) const;
    [[nodiscard]] bool is_inside(const EvenMotion& motion, int i, int j) const;
    [[nodiscard]] float level_in(const NeighbourFrame& frame, const EvenMotion& motion, int i,
                                 int j) const;

    const DepthImage& here_;
    NeighbourFrame a_, b_;
    int reach_px_;
    std::vector<Sample> samples_{};
};

}  // namespace dibhr
