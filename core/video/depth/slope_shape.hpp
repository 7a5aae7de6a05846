// How slopes bend in a picture: over planes a distance is convex, and one over it is straight.
#pragma once

#include <cstddef>
#include <vector>

namespace dibhr {

/// Shares of the slopes of a picture; each slope is three levels in a row, a, b and d, at equal
/// distances in pixels, over a smooth surface that rises or falls.
///
/// A camera sees one over the distance of a plane as a linear function of the pixel, so b is the
/// harmonic mean of a and d where levels are distances, the mean where they are disparities, and
/// above the mean where they fall with the distance. Convex objects bend alike.
struct SlopeShape {
    std::size_t slopes{0};
    double convex{0.5};  ///< share whose b is below the mean
    /// Shares of the slopes, each weighted by the bend of distances: those that bend by less than
    /// 0.3 of that, and those that bend as much, within 0.3 of that.
    double straight{0.0}, proportional{0.0};
    double perspective{0.0};  ///< median of |d - a| / |a + d|
};

/// Adds up the slopes of pictures.
class SlopeMeter {
  public:
    /// Levels row by row, NaN: no data.
    void add(int columns, int rows, const std::vector<float>& levels);

    [[nodiscard]] SlopeShape shape() const;

  private:
    struct Slope {
        float bend;         ///< a + d - 2 b
        float of_distance;  ///< the same if b were the harmonic mean
        float perspective;  ///< |d - a| / |a + d|
    };
    std::vector<Slope> slopes_{};
};

}  // namespace dibhr
