// What a brush does to touch maps.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/haptics/touch_maps.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// A round brush, whole in its middle and soft towards its edge.
struct BrushTip {
    double radius_px{16.0};
    double strength{1.0};  ///< how much of it a stroke lays at most, 0 .. 1
};

/// What is laid on a map: its value at a pixel; nothing: the map is taken away.
struct Lay {
    TouchMapKind kind{TouchMapKind::stiffness};
    std::function<double(int i, int j)> value{};  ///< empty: takes away
};

/// From a press to its release. Passing over a place twice lays no more than passing once.
class MapStroke {
  public:
    /// Over an image of columns x rows; maps of another size are brought to that first.
    MapStroke(const TouchMaps& before, std::vector<Lay> lays, BrushTip tip, int columns, int rows);

    /// The brush goes on to there, touching all between.
    void go_to(const Vec3& place);

    /// The maps as they are now; heights laid over the image.
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
    std::vector<float> laid_;  // the most share of each pixel so far
    std::optional<Vec3> last_{};
};

/// The map in another resolution, sampled as it is felt; one without pixels becomes bare.
[[nodiscard]] TouchMap resized(const TouchMap& map, TouchMapKind kind, int columns, int rows);

}  // namespace dibhr
