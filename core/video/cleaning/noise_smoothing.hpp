// Smooths what is within the noise, and keeps what is beyond it.
#pragma once

#include <cstddef>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_noise.hpp"

namespace dibhr {

/// First each pixel takes the median of those around it, unless it is farther off than noise could
/// be: an outlier would be an edge to what follows. Then each pixel is drawn towards the
/// middles of pairs of pixels opposite each other around it, along four directions, at growing
/// distances and back, as far as they differ no more than noise does. So a slope is no edge,
/// however steep, and beside an edge only the pairs along it count. What was taken away with it all
/// and is more than noise over a few pixels is put back: small true shapes.
class NoiseSmoother {
  public:
    /// `noise` is the clip's; from pixel to pixel the image may be rougher, and then that counts.
    /// At least 2 x 2 pixels. Same image, same bits.
    void smooth(DepthImage& image, const DepthNoise& noise);

  private:
    /// Of the image, or of every second pixel of the scale before.
    struct Scale {
        int columns{0}, rows{0};
        std::vector<float> levels{};
        // Not of the image, whose own are elsewhere or made as they are needed:
        std::vector<float> before{};     ///< it was smoothed
        std::vector<float> per_bound{};  ///< 1 / how far the middle of a pair may be off
        float noise_part{0.0F};          ///< of the bound: what is beyond it is put back

        [[nodiscard]] std::size_t index(int column, int row) const {
            return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column);
        }
    };

    void measure_tiles(const DepthImage& image, const DepthNoise& noise);
    void clip_to_twice_the_mean(int columns, int rows, int first_row);
    [[nodiscard]] const float* bounds_of(const Scale& scale, int row);
    void spread_bounds(int row, float* out);
    void take_medians(DepthImage& image, const DepthNoise& noise);
    void go_through(std::size_t number, const float* from, const float* before);
    void go_down(Scale& fine, const float* from, Scale* coarse);
    void go_up(Scale& fine, const float* before, const Scale* coarse);
    void add_coarse(Scale& fine, const Scale& coarse, int j);
    template <typename Rows>
    void pass(const Scale& scale, const Rows& rows, int j, int reach, float* out);
    void put_back(const Scale& scale, int j, float* out);

    /// The last rows of what one pass hands to the next.
    class Ring {
      public:
        void resize(int columns) {
            columns_ = static_cast<std::size_t>(columns);
            levels_.resize(kRows * columns_);
        }
        [[nodiscard]] float* row(int number) {
            return levels_.data() + static_cast<std::size_t>(number) % kRows * columns_;
        }

      private:
        static constexpr std::size_t kRows = 8;
        std::vector<float> levels_{};
        std::size_t columns_{0};
    };

    std::vector<float> medians_{}, before_{};  ///< of the image; it with its outliers
    std::vector<Scale> scales_{};
    int tile_columns_{0}, tile_rows_{0};
    std::vector<float> per_bound_of_tile_{};
    std::vector<float> rough_{}, caps_{};  ///< of a row of tiles, by pixel and by tile
    std::vector<float> lows_{}, highs_{};  ///< by column
    std::vector<float> tiles_{}, row_{}, across_{}, both_{};  ///< of a row
    Ring first_{}, second_{}, taken_{};
    Ring bounds_{};  ///< of the finest scale
    int bounds_made_{0};
};

}  // namespace dibhr
