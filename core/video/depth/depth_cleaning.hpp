// Makes recorded depth pleasant and safe to touch: holes, spikes and 8-bit steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/depth/depth_memory.hpp"
#include "core/video/depth/hole_filling.hpp"

namespace dibhr {

struct CleaningOptions {
    bool fill_holes{true};     ///< where there is no data, take what was there, or is around
    bool remove_spikes{true};  ///< single pixels that stand out, and small patches alone in holes
    bool smooth_steps{true};   ///< 8-bit terraces, within half a level of the data

    bool operator==(const CleaningOptions&) const = default;
    [[nodiscard]] bool any() const { return fill_holes || remove_spikes || smooth_steps; }
};

/// A depth image without holes, and where nothing was ever seen (see Frame).
struct CleanedDepth {
    std::shared_ptr<const DepthImage> depth{};
    std::shared_ptr<const std::vector<std::uint8_t>> unseen{};
};

/// Cleans in place: spikes, then holes, then steps. What is off leaves every level as it is, but no
/// data (NaN) becomes level 0, the farthest; the same image gives the same bits. Scratch memory is
/// kept inside and reused from frame to frame.
class DepthCleaner {
  public:
    /// `held`: what pixels without data were before. Gives the mask of what was never seen, columns
    /// x rows, 1 where a level says nothing about the scene; empty when there is no such pixel.
    std::vector<std::uint8_t> clean(DepthImage& image, const CleaningOptions& options,
                                    std::span<const HeldLevel> held = {});

    /// The same, to be published.
    [[nodiscard]] CleanedDepth cleaned(DepthImage image, const CleaningOptions& options,
                                       std::span<const HeldLevel> held = {});

  private:
    struct Spike {
        int column, row;
        float level;  ///< that it takes
    };

    /// A pixel beyond all its neighbours with data by more than a threshold takes their median, and
    /// then maybe one beside it; one that has no such neighbour is no data.
    void remove_spikes(DepthImage& image);
    void find_spikes(const DepthImage& image);
    void look_for_spike(const DepthImage& image, int i, int j);
    void look_around(const DepthImage& image, const Spike& spike, std::uint8_t round);

    /// Data alone in a hole, on fewer pixels than a square of an eightieth of the image's width:
    /// what sensors make up at outlines.
    void remove_islands(DepthImage& image);

    /// 8-bit images only. Every pixel is drawn towards the line between its neighbours at growing
    /// and then falling distances, not across edges, and kept within half a level of where it was:
    /// a slope that was cut into terraces becomes a slope again, and whatever the data says stays
    /// said.
    void smooth_steps(DepthImage& image);

    std::vector<std::size_t> refused_{};  ///< pixels that lost their data to spikes and islands
    Patches patches_{};
    DepthImage seen_{};  ///< without anything filled
    HeldFiller held_{};
    SmallHoleFiller small_holes_{};
    LargeHoleFiller large_holes_{};
    std::vector<Spike> spikes_{}, removed_{};
    std::vector<std::uint8_t> looked_at_{};  ///< of every pixel, in which round
    std::vector<int> outlying_{};
    std::vector<float> highest_{}, lowest_{};      ///< of the rows above and below, by column
    std::vector<float> low_{}, high_{}, other_{};  ///< bounds of every level; the pass's output
};

}  // namespace dibhr
