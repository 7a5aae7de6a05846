// Levels that no surface has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/patches.hpp"

namespace dibhr {

/// Takes away what stands out of all around it. NaN is no data.
class SpikeRemover {
  public:
    /// A pixel beyond all its neighbours with data by more than a threshold takes their median, and
    /// then maybe one beside it; one that has no such neighbour is no data. So is data alone in a
    /// hole, on fewer pixels than a square of an eightieth of the image's width: what sensors make
    /// up at outlines. At least 2 x 2 pixels.
    void remove(DepthImage& image);

    /// Nothing was removed of the next image.
    void forget() noexcept { refused_.clear(); }
    /// The pixels that lost their data.
    [[nodiscard]] std::span<const std::size_t> refused() const noexcept { return refused_; }

  private:
    struct Spike {
        int column, row;
        float level;  ///< that it takes
    };

    void remove_spikes(DepthImage& image);
    void find_spikes(const DepthImage& image);
    void look_for_spike(const DepthImage& image, int i, int j);
    void look_around(const DepthImage& image, const Spike& spike, std::uint8_t round);
    void remove_islands(DepthImage& image);

    std::vector<std::size_t> refused_{};
    Patches patches_{};
    std::vector<Spike> spikes_{}, removed_{};
    std::vector<std::uint8_t> looked_at_{};    ///< of every pixel, in which round
    std::vector<std::uint8_t> outlying_{};     ///< of a row
    std::vector<float> highest_{}, lowest_{};  ///< of the rows above and below, by column
};

}  // namespace dibhr
