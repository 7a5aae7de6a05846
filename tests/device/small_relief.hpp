// Small reliefs for the devices' tests, an elevation in pixels for every vertex.
#pragma once

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr::test {

/// A still relief whose vertex (i, j) lies at elevation(i, j) pixels.
class SmallRelief {
  public:
    template <typename Elevation>
    SmallRelief(int columns, int rows, Elevation elevation) {
        image_.columns = columns;
        image_.rows = rows;
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                image_.levels.push_back(static_cast<float>(elevation(i, j)));
            }
        }
    }

    [[nodiscard]] DepthSurface surface() const { return {image_, image_, 0.0, shape_}; }

  private:
    DepthImage image_{};
    SurfaceShape shape_{};
};

inline SmallRelief flat(double elevation_px = 20.0) {
    return {400, 300, [=](int, int) { return elevation_px; }};
}

/// So wide that a hand takes a while to cross it; a step of 255 px every 500 columns.
inline SmallRelief wide() {
    return {3000, 20, [](int i, int) { return i / 500 % 2 == 0 ? 0.0 : 255.0; }};
}

/// `low` left of column 200, `high` from there on.
inline SmallRelief cliff(double low_px, double high_px) {
    return {400, 300, [=](int i, int) { return i < 200 ? low_px : high_px; }};
}

}  // namespace dibhr::test
