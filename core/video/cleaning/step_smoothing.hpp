// Smooths the terraces of levels in steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_noise.hpp"

namespace dibhr {

/// Turns terraces of levels in steps back into slopes.
class StepSmoother {
  public:
    /// Moves every pixel towards the line between its neighbours at growing and then falling
    /// distances, not across edges, in steps of 1/128 level. Each stays within half a level of its
    /// own, so that rounded levels are the recorded ones. The back wall, level 0, stays. For images
    /// of 8 bits (is_eight_bit).
    void smooth(DepthImage& image);

    /// The same for levels of any coding (hue, disparity, 8 bits in 16): within half a step of the
    /// clip's measured levels, across differences of one step only. Levels whose noise reaches a
    /// tenth of a step, and steps that are not felt, stay.
    void smooth_measured(DepthImage& image, const DepthNoise& noise);

  private:
    /// Some rows of an image, in parts of a step. They may be read beyond both ends.
    struct Rows {
        std::vector<std::uint16_t> levels{};
        std::size_t stride{0};
        int count{0};

        void set_size(std::size_t columns, int rows);
        [[nodiscard]] std::uint16_t* row(int number);  ///< the last `count` numbers are kept
    };
    /// `parts`: of a step; `most_edge`: a larger difference is an edge [step / 128].
    void set_size(std::size_t columns, int parts, int most_edge);
    template <typename Count, typename Take>
    void smooth_rows(DepthImage& image, const Count& count, const Take& take);

    std::size_t columns_{0};
    int parts_{0}, most_edge_{0};
    std::vector<int> edges_{};  ///< of each pass [parts of a step]
    Rows given_{};
    Rows limits_{};               ///< a row for each pass: limits of differences along the row
    std::vector<Rows> passes_{};  ///< of each pass the rows that the next one needs
};

[[nodiscard]] inline bool is_eight_bit(const DepthImage& image) noexcept {
    return image.highest_level < 256.0;
}

}  // namespace dibhr
