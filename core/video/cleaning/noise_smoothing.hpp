// Smooths differences within the noise, and keeps those beyond it.
#pragma once

#include <cstddef>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_noise.hpp"

namespace dibhr {

/// 1. Each pixel takes the median of those around it, unless it differs by more than noise could: a
///    remaining outlier would be an edge for the next step.
/// 2. Each pixel is moved towards the means of pairs of opposite pixels, along four directions, at
///    growing and then falling distances, as far as the differences are within the noise. So a
///    slope is no edge, however steep, and beside an edge only the pairs along it count.
/// 3. Removed shapes of a few pixels that are larger than noise are added again.
class NoiseSmoother {
  public:
    /// `noise`: of the clip; where the image itself is rougher its roughness counts. The image has
    /// at least 2 x 2 pixels. The same image gives the same bits.
    void smooth(DepthImage& image, const DepthNoise& noise);

  private:
    /// The image, or every second pixel of the scale before.
    struct Scale {
        int columns{0}, rows{0};
        std::vector<float> levels{};
        // Of coarser scales only; those of the image are elsewhere or computed when needed:
        std::vector<float> before{};     ///< levels before smoothing
        std::vector<float> per_bound{};  ///< 1 / largest distance of a pair's mean [1 / level]
        float noise_part{0.0F};          ///< part of the bound: larger shapes are added again

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
    void smooth_scales(std::size_t number, const float* from, const float* before);
    void smooth_to_coarser(Scale& fine, const float* from, Scale* coarse);
    void smooth_to_finer(Scale& fine, const float* before, const Scale* coarse);
    void add_coarse(Scale& fine, const Scale& coarse, int j);
    template <typename Rows>
    void pass(const Scale& scale, const Rows& rows, int j, int reach, float* out);
    void put_back(const Scale& scale, int j, float* out);

    /// The last rows that one pass leaves for the next.
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

    std::vector<float> medians_{}, before_{};  ///< of the image; the image with its outliers
    std::vector<Scale> scales_{};
    int tile_columns_{0}, tile_rows_{0};
    std::vector<float> per_bound_of_tile_{};
    std::vector<float> rough_{}, caps_{};  ///< of a row of tiles: by pixel; by tile
    std::vector<float> lows_{}, highs_{};  ///< by column
    std::vector<float> tiles_{}, row_{}, across_{}, both_{};  ///< of a row
    Ring first_{}, second_{}, taken_{};
    Ring bounds_{};  ///< of the finest scale
    int bounds_made_{0};
};

}  // namespace dibhr
