// Smooths the terraces of 8-bit levels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// Turns terraces of whole levels back into slopes.
class StepSmoother {
  public:
    /// Moves every pixel towards the line between its neighbours at growing and then falling
    /// distances, not across edges, in steps of 1/128 level. Each stays within half a level of its
    /// own, so that rounded levels are the recorded ones. The back wall, level 0, stays. For images
    /// of 8 bits (is_eight_bit).
    void smooth(DepthImage& image);

  private:
    /// Some rows of an image, in 128ths of a level. They may be read beyond both ends.
    struct Rows {
        std::vector<std::uint16_t> levels{};
        std::size_t stride{0};
        int count{0};

        void set_size(std::size_t columns, int rows);
        [[nodiscard]] std::uint16_t* row(int number);  ///< the last `count` numbers are kept
    };
    void set_size(std::size_t columns);

    std::size_t columns_{0};
    Rows given_{};
    Rows limits_{};               ///< a row for each pass: limits of differences along the row
    std::vector<Rows> passes_{};  ///< of each pass the rows that the next one needs
};

[[nodiscard]] inline bool is_eight_bit(const DepthImage& image) noexcept {
    return image.highest_level < 256.0;
}

}  // namespace dibhr
