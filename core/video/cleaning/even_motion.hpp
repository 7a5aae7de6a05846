// How a small part of an image moves, found in two frames beside it in time.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_noise.hpp"

namespace dibhr {

/// Pixels a frame.
struct Motion {
    int right{0}, down{0};
};

/// Even motion: what is here was as far to one side in the frame before as it will be to the other
/// in the frame after. Looked for up to a fortieth of the image's width a frame: of a hand at half
/// a metre a second nine of ten samples are found so, of what a RealSense and a Kinect flip in most
/// regions none.
class MotionSearch {
  public:
    struct BesideInTime {
        const float* levels;  ///< of a frame of the same size
        int later;            ///< by so many frames; below 0: before this one
    };
    /// A pixel that may move.
    struct Sample {
        std::ptrdiff_t at;  ///< its index
        int i, j;           ///< its column and row
        float level;
        float alike;  ///< so far off the same surface may be
    };

    /// The frames outlive the search.
    MotionSearch(const DepthImage& here, const BesideInTime& a, const BesideInTime& b);

    void clear() { samples_.clear(); }
    void add(const Sample& sample) { samples_.push_back(sample); }

    /// By which six of ten samples, of which there are some, are found in both frames; of equals
    /// the first one. The first samples are looked for first: let them be from all over.
    [[nodiscard]] std::optional<Motion> found() const;

    /// The median of what a pixel is and was and will be. Nothing where it comes or goes over the
    /// image's border, or no two of them are alike.
    [[nodiscard]] std::optional<float> level_along(const Motion& motion, int i, int j,
                                                   const NoiseBound& bound) const;

  private:
    struct Best {
        Motion motion{};
        std::size_t count{0};
    };

    void try_around(Best& best, const Motion& middle, int reach_px, int step_px) const;
    [[nodiscard]] std::size_t count_found(const Motion& motion, std::size_t least) const;
    [[nodiscard]] std::ptrdiff_t away(const BesideInTime& frame, const Motion& motion) const;
    [[nodiscard]] bool is_inside(const Motion& motion, int i, int j) const;
    [[nodiscard]] float level_in(const BesideInTime& frame, const Motion& motion, int i,
                                 int j) const;

    const DepthImage& here_;
    BesideInTime a_, b_;
    int reach_px_;
    std::vector<Sample> samples_{};
};

}  // namespace dibhr
