// Where a video was touched, and for how long: time per pixel and time per frame.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "core/haptics/vec.hpp"

namespace dibhr {

/// Pixels from `left` and `top` up to, not including, `right` and `bottom`.
struct PixelBounds {
    int left{0}, top{0}, right{0}, bottom{0};
};

/// One value a pixel, row-major.
struct PixelValues {
    int columns{0};
    int rows{0};
    std::vector<float> values{};

    [[nodiscard]] float at(int column, int row) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }
};

class TouchedPlaces {
  public:
    /// The contact was at this place of the depth image [px] and in the frame shown at `media_s`,
    /// for so long. A place outside every image only counts for its frame.
    void add(Vec2 place_px, double media_s, double seconds);

    [[nodiscard]] double total_s() const noexcept { return total_s_; }
    /// The frame that was touched longest, the earliest of several: its presentation time.
    [[nodiscard]] double longest_frame_s() const;
    /// Around every touched pixel; empty for none.
    [[nodiscard]] PixelBounds bounds() const;
    /// Whether a pixel of an image of this size was touched.
    [[nodiscard]] bool touches(int columns, int rows) const;
    /// Seconds per pixel over an image of this size, spread by a Gaussian of `sigma_px`.
    [[nodiscard]] PixelValues smoothed(int columns, int rows, double sigma_px) const;

  private:
    std::unordered_map<std::uint64_t, double> pixel_s_{};  ///< by row and column
    std::map<double, double> frame_s_{};
    double total_s_{0.0};
};

}  // namespace dibhr
