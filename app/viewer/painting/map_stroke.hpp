// A brush stroke over touch maps.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/haptics/touch_maps.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// A round brush: full strength in its middle, soft towards its edge.
struct BrushTip {
    double radius_px{16.0};
    double strength{1.0};  ///< greatest share that one stroke lays, 0 .. 1
};

/// What a brush lays on one map: a value at each pixel, or it erases the map.
struct Lay {
    TouchMapKind kind{TouchMapKind::stiffness};
    std::function<double(int i, int j)> value{};  ///< empty: erases
};

/// From a press to its release. Passing over a place twice lays no more than passing once.
class MapStroke {
  public:
    /// Over an image of columns x rows; maps of another size are resized first.
    MapStroke(const TouchMaps& before, std::vector<Lay> lays, BrushTip tip, int columns, int rows);

    /// Moves the brush to `place` in a straight line, painting on the way.
    void go_to(const Vec3& place);

    /// The maps after the stroke so far, with heights resampled to the image.
    [[nodiscard]] const TouchMaps& maps() const noexcept { return maps_; }

  private:
    void dab(double x, double y);
    void lay_pixel(int i, int j, double share);

    TouchMaps before_;
    TouchMaps maps_;
    std::vector<Lay> lays_;
    BrushTip tip_;
    int columns_;
    int rows_;
    std::vector<float> laid_;  // greatest share laid on each pixel so far
    std::optional<Vec3> last_{};
};

/// The map in another resolution, sampled as the tick does; a map without pixels becomes bare.
[[nodiscard]] TouchMap resized(const TouchMap& map, TouchMapKind kind, int columns, int rows);

}  // namespace dibhr
