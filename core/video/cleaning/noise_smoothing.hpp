// Smooths differences within the noise, and keeps those beyond it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/noise_bands.hpp"

namespace dibhr {

/// 1. Each pixel is moved towards the means of pairs of opposite pixels, along four directions, at
///    growing and then falling distances, as far as the differences are within the noise. So a
///    slope is no edge, however steep, and beside an edge only the pairs along it count.
/// 2. Of what that took, shapes are added again that are larger than the noise of their own scale,
///    and as much of the noise as may be left. None of it is taken across an edge.
class NoiseSmoother {
  public:
    /// `noise`: of the clip; `evidence`: what the image's levels are the means of. The image has at
    /// least 2 x 2 pixels. The same image gives the same bits.
    void smooth(DepthImage& image, const DepthNoise& noise, const TimeEvidence& evidence = {});

  private:
    /// The image, or every second pixel of the scale before.
    struct Scale {
        int columns{0}, rows{0};
        std::vector<float> levels{};
        // Of coarser scales only; those of the image are elsewhere or computed when needed:
        std::vector<float> before{};     ///< levels before smoothing
        std::vector<float> per_bound{};  ///< 1 / largest distance of a pair's mean [1 / level]

        [[nodiscard]] std::size_t index(int column, int row) const {
            return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column);
        }
    };

    void find_noise(const DepthImage& image, const DepthNoise& noise, const TimeEvidence& evidence);
    void find_variances(const DepthImage& image, const DepthNoise& noise,
                        const TimeEvidence& evidence);
    void find_roughness(const DepthImage& image, int y);
    void clip_to_twice_the_mean(int columns, int rows, int first_row);
    [[nodiscard]] const float* bounds_of(const Scale& scale, int row);
    void spread_bounds(int row, float* out);
    void smooth_scales(std::size_t number, const float* from);
    void smooth_to_coarser(Scale& fine, const float* from, Scale* coarse);
    void smooth_to_finer(Scale& fine, const Scale* coarse);
    void add_coarse(Scale& fine, const Scale& coarse, int j);
    template <typename Rows>
    void pass(const Scale& scale, const Rows& rows, int j, int reach, float* out);
    void put_back(DepthImage& image);
    void take_medians(DepthImage& image, const DepthNoise& noise);
    void remove_outliers(DepthImage& image);

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

    std::vector<float> medians_{};            ///< of the image
    std::vector<std::uint8_t> few_frames_{};  ///< 1: of tiles of which time tells little
    std::vector<Scale> scales_{};
    int tile_columns_{0}, tile_rows_{0};
    std::vector<float> variances_{};  ///< of tiles, in one frame
    std::vector<float> per_bound_of_tile_{};
    std::vector<float> rough_{}, caps_{};  ///< of a row of tiles: by pixel; by tile
    std::vector<float> lows_{}, highs_{};  ///< by column
    std::vector<float> tiles_{}, row_{};   ///< of a row
    BandNoise left_{};                     ///< in the image
    BandPicture taken_{};
    NoiseBands bands_{};
    Ring first_{};
    Ring bounds_{};  ///< of the finest scale
    int bounds_made_{0};
};

}  // namespace dibhr
