// The sides of pixels beside an outline: how many around agree, and the mean level of those.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// The side that a pixel is moved to.
namespace side_of_pixel {
enum SideOfPixel : std::uint8_t {
    kNeither,
    kUndecided,  ///< none, but the pixel may be on a ramp
    kLow,
    kHigh,
    kOutside  ///< of the image
};
}

/// The sides of an image's pixels are followed by so many more, which are read but do not count.
inline constexpr std::size_t kReadBeyond = 16;

/// How many of the pixels around those of a run have a side.
class SideBalances {
  public:
    /// Pixels [begin, end) of one row.
    struct Run {
        int row, begin, end;
    };

    /// `sides`: of the pixels of `image`.
    void find(const std::uint8_t* sides, const DepthImage& image, const Run& run);
    /// Of a column of the run: twice the count of pixels around that have a side, less the
    /// undecided ones.
    [[nodiscard]] int at(int column) const {
        return balances_[static_cast<std::size_t>(column - begin_)];
    }

  private:
    int begin_{0};
    std::vector<std::int16_t> in_column_{};
    std::vector<int> balances_{};
};

/// The mean level of a pixel and of those around it on the same side of an outline, or on neither,
/// with levels like its own. `sides`: of the pixels of `image`.
[[nodiscard]] float mean_of_side(const DepthImage& image, const std::uint8_t* sides,
                                 std::size_t pixel);

}  // namespace dibhr
