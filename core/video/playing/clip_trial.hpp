// Tries ways of cleaning on a clip's first frames, and measures what a finger would feel of each.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/cleaning_chain.hpp"

namespace dibhr {

/// Collects the middle of a clip's first frames, and measures ground that is smooth and stands
/// still. Relief is the thing's only where it stands out of the noise: then a way is measured by
/// its difference from the mean of all frames. Else all that a finger feels of the ground is noise.
class ClipTrial {
  public:
    /// Not cleaned: NaN is no data. Frames unlike the first one are ignored.
    void add(const DepthImage& frame);

    /// The first of `ways` that feels like the best of all and like no cleaning, or better.
    /// Nothing: there are too few frames, or too little smooth ground that stands still and is
    /// seen.
    [[nodiscard]] std::optional<FeltCleaning> best_of(std::span<const CleaningSteps> ways,
                                                      const DepthNoise& noise) const;

  private:
    std::vector<DepthImage> frames_{};
};

}  // namespace dibhr
