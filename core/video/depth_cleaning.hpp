// Makes recorded depth pleasant and safe to touch: holes, spikes and 8-bit steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// A hole is a patch of pixels of level 0, joined over edges and corners. One that is no wider and
/// no higher than a twentieth of the image's width is filled: each pixel takes the mean of the
/// nearest levels to its left, right, above and below, weighted by 1 / distance, which continues a
/// plane. Larger ones stay as they are: empty background must not become a surface.
class HoleFiller {
  public:
    void fill(DepthImage& image);

  private:
    /// Pixels [begin, end) of one row, all of level 0.
    struct Run {
        int row, begin, end;
        std::int32_t patch;
    };
    /// The rectangle around a patch, and the patch it was joined to.
    struct Patch {
        int left, right, top, bottom;
        std::int32_t parent;
    };

    void find_runs(const DepthImage& image);
    void join_runs();
    std::int32_t root(std::int32_t patch);
    void join(std::int32_t a, std::int32_t b);
    void keep_small(const DepthImage& image);
    void weigh_rows(const DepthImage& image);
    void weigh_columns(const DepthImage& image, int step);

    std::vector<Run> runs_{};
    std::vector<Patch> patches_{};
    std::vector<float> sum_{}, weight_{};  ///< of the pixels of all runs, one after the other
    std::vector<float> column_level_{};    ///< nearest level above (or below), by column
    std::vector<int> column_row_{};        ///< its row; negative: there is none
};

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
