// The terraces of levels of 8 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// Makes a slope again of what was cut into terraces of whole levels.
class StepSmoother {
  public:
    /// Every pixel is drawn towards the line between its neighbours at growing and then falling
    /// distances, not across edges, and kept within half a level of where it was, in steps of
    /// 1/128: whatever the data says stays said. The back wall, level 0, stays. Of 8 bits
    /// (is_eight_bit).
    void smooth(DepthImage& image);

  private:
    /// Some rows of an image, in 128ths of a level, from which may be read beyond both ends.
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
    Rows limits_{};               ///< of each pass one, of differences along the row
    std::vector<Rows> passes_{};  ///< of each the rows that the next one needs
};

[[nodiscard]] inline bool is_eight_bit(const DepthImage& image) noexcept {
    return image.highest_level < 256.0;
}

}  // namespace dibhr
