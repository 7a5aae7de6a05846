// Makes recorded depth pleasant and safe to touch: holes, spikes and 8-bit steps.
#pragma once

#include <cstddef>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/hole_filling.hpp"

namespace dibhr {

struct CleaningOptions {
    bool fill_holes{true};     ///< level 0 = no data: small holes take the levels around them
    bool remove_spikes{true};  ///< single pixels that stand out of all their neighbours
    bool smooth_steps{true};   ///< 8-bit terraces, within half a level of the data

    bool operator==(const CleaningOptions&) const = default;
    [[nodiscard]] bool any() const { return fill_holes || remove_spikes || smooth_steps; }
};

/// Cleans in place: spikes, then holes, then steps. What is off leaves every bit as it is; the same
/// image gives the same bits. Scratch memory is kept inside and reused from frame to frame.
class DepthCleaner {
  public:
    void clean(DepthImage& image, const CleaningOptions& options);

  private:
    struct Spike {
        std::size_t index;
        float level;
    };

    /// A pixel beyond all its 8 neighbours by more than a threshold takes their median.
    void remove_spikes(DepthImage& image);

    /// 8-bit images only. Every pixel is drawn towards the line between its neighbours at growing
    /// and then falling distances, not across edges, and kept within half a level of where it was:
    /// a slope that was cut into terraces becomes a slope again, and whatever the data says stays
    /// said.
    void smooth_steps(DepthImage& image);

    HoleFiller holes_{};
    std::vector<Spike> spikes_{};
    std::vector<int> outlying_{};
    std::vector<float> highest_{}, lowest_{};      ///< of the rows above and below, by column
    std::vector<float> low_{}, high_{}, other_{};  ///< bounds of every level; the pass's output
};

}  // namespace dibhr
