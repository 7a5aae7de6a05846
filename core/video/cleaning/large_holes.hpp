// What stands where a depth image has no data far around: what is behind goes on there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/level_pyramid.hpp"

namespace dibhr {

/// Fills all that is left, so that nothing falls into a hole: near data with the farthest surface
/// there, between data with what is behind, and what is open with level 0.
class LargeHoleFiller {
  public:
    /// `seen` is the image before any hole was filled: no pixel that has no data in it stays lower
    /// than all that it has within a fingertip's reach. Puts 1 into `unseen` (columns x rows, all
    /// 0) where a hole is wider than a twentieth of the image's width. `refused` are pixels whose
    /// data was not believed: what stands there instead does not end beside them either.
    void fill(DepthImage& image, const DepthImage& seen, std::span<const std::size_t> refused,
              std::vector<std::uint8_t>& unseen);

  private:
    [[nodiscard]] bool find_behind(const DepthImage& image);
    void find_wide_and_open(int columns);
    void widen(const DepthImage& seen, int row);
    [[nodiscard]] float* span_of(int row, std::size_t number, std::size_t columns);
    void find_farthest(const DepthImage& seen, int row, const std::uint8_t* chunks);
    void mark_chunks(const DepthImage& image, std::span<const std::size_t> refused);
    void fill_row(DepthImage& image, int row, std::vector<std::uint8_t>& unseen);
    void lift_row(DepthImage& image, const DepthImage& seen, int row) const;
    void lift_beside(DepthImage& image, const DepthImage& seen,
                     std::span<const std::size_t> refused);

    LevelPyramid behind_{};
    std::vector<float> wide_{}, open_{};                        ///< of its squares: above 0 inside
    std::vector<float> level_row_{}, wide_row_{}, open_row_{};  ///< at the pixels of a row
    DepthImage given_{};                                        ///< with what refused pixels became
    std::vector<float> spans_{};             ///< by row and span, of as many rows as a disc has
    std::vector<float> padded_{}, eight_{};  ///< of a row; the lowest of eight pixels on
    std::vector<float> above_{};             ///< a row that is infinite
    std::vector<std::uint8_t> chunks_{};     ///< of rows: 1 where something is to be looked at
    std::vector<float> farthest_{};  ///< of one row: the lowest level in reach; infinity: none
    int widened_{0};                 ///< rows whose spans are known
};

}  // namespace dibhr
