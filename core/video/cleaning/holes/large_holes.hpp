// Fills the large holes of a depth image: the background is continued into them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/holes/level_pyramid.hpp"

namespace dibhr {

/// Fills all remaining holes, so that no finger falls into one: near data with the farthest surface
/// there, between data with the background, and wide open areas with level 0.
class LargeHoleFiller {
  public:
    /// `seen`: the image before any hole was filled. A pixel without data in it gets no lower than
    /// all its data within a fingertip's reach. `unseen` (columns x rows, all 0) becomes 1 where a
    /// hole is wider than a twentieth of the image's width. `rejected`: pixels whose data was
    /// rejected as spikes; the surface does not fall away beside their new levels either.
    void fill(DepthImage& image, const DepthImage& seen, std::span<const std::size_t> rejected,
              std::vector<std::uint8_t>& unseen);

  private:
    [[nodiscard]] bool find_behind(const DepthImage& image);
    void find_wide_and_open(int columns);
    void widen(const DepthImage& seen, int row);
    [[nodiscard]] float* span_of(int row, std::size_t number, std::size_t columns);
    void find_farthest(const DepthImage& seen, int row, const std::uint8_t* chunks);
    void mark_chunks(const DepthImage& image, std::span<const std::size_t> rejected);
    void fill_row(DepthImage& image, int row, std::vector<std::uint8_t>& unseen);
    void lift_row(DepthImage& image, const DepthImage& seen, int row) const;
    void lift_beside(DepthImage& image, const DepthImage& seen,
                     std::span<const std::size_t> rejected);

    LevelPyramid behind_{};
    std::vector<float> wide_{}, open_{};                        ///< of squares: above 0 inside
    std::vector<float> level_row_{}, wide_row_{}, open_row_{};  ///< at the pixels of a row
    DepthImage given_{};                                        ///< with refused pixels' new levels
    std::vector<float> spans_{};             ///< by row and span, for the rows of one disc
    std::vector<float> padded_{}, eight_{};  ///< of a row; lowest of a pixel and the seven after it
    std::vector<float> above_{};             ///< a row of infinity
    std::vector<std::uint8_t> chunks_{};     ///< of rows: 1 where pixels are to be checked
    std::vector<float> farthest_{};  ///< of one row: the lowest level in reach; infinity: none
    int widened_{0};                 ///< rows whose spans are known
};

}  // namespace dibhr
