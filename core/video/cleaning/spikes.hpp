// Removes spikes and pits: levels that no surface has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/patches.hpp"

namespace dibhr {

/// Removes pixels that stand out from all their neighbours. NaN is no data.
class SpikeRemover {
  public:
    /// A pixel that exceeds all its neighbours with data by more than a threshold takes their
    /// median; its neighbours are then checked again. A pixel without such neighbours loses its
    /// data. So do islands of data in holes with fewer pixels than a square of an eightieth of the
    /// image's width: sensors invent them at outlines. The image has at least 2 x 2 pixels.
    /// `noise`: standard deviation of its noise [levels]. The threshold is 100 levels, or three
    /// deviations where that is more, and at most 8 of 255 of the range (4 for pits).
    void remove(DepthImage& image, float noise = 0.0F);

    /// The next image is not given to remove(): no pixel is refused.
    void forget() noexcept { rejected_.clear(); }
    /// Whether the image that remove() was given last has pixels without data now.
    [[nodiscard]] bool left_holes() const noexcept { return left_holes_; }
    /// The pixels that lost their data.
    [[nodiscard]] std::span<const std::size_t> rejected() const noexcept { return rejected_; }

  private:
    struct Spike {
        int column, row;
        float level;  ///< its new level
    };

    void remove_spikes(DepthImage& image);
    void find_spikes(const DepthImage& image);
    void check_for_spike(const DepthImage& image, int i, int j);
    void check_neighbours(const DepthImage& image, const Spike& spike, std::uint8_t round);
    void remove_islands(DepthImage& image);

    /// How far a spike is above or below all its neighbours, at least.
    struct Threshold {
        float above{0.0F}, below{0.0F};

        /// Whether `level` is a spike; `least`, `most`: of the neighbours. False for NaN.
        [[nodiscard]] bool operator()(float level, float least, float most) const {
            return level > most + above || level < least - below;
        }
    };

    Threshold is_spike_{};
    std::vector<std::size_t> rejected_{};
    bool left_holes_{false};
    Patches patches_{};
    std::vector<Spike> spikes_{}, removed_{};
    std::vector<std::uint8_t> checked_in_round_{};  ///< round in which each pixel was checked
    std::vector<std::uint8_t> outlying_{};          ///< of a row
    std::vector<float> highest_{}, lowest_{};       ///< of the rows above and below, by column
};

}  // namespace dibhr
