// Studio light on a relief: a soft key light from the upper left, its shadows, the open sky.
#pragma once

#include <vector>

#include "assets/sample/paint.hpp"
#include "assets/sample/relief.hpp"

namespace dibhr::sample {

/// How much of the two lights reaches a place, 0..1.
struct Reach {
    float key{};
    float sky{};
};

/// Shadows and sky of a whole relief at half its resolution.
class LightMap {
  public:
    explicit LightMap(const Relief& relief);
    /// At a place of the full picture, on the surface at this level.
    [[nodiscard]] Reach at(float column, float row, float level) const noexcept;

  private:
    int columns_{};
    int rows_{};
    std::vector<float> heights_{};
    std::vector<float> key_{};
    std::vector<float> sky_{};
};

/// Linear RGB towards the viewer.
[[nodiscard]] Vec3 shade(const Paint& paint, Vec3 normal, Reach reach) noexcept;

/// Linear RGB to the 0..1 of an sRGB file, with a soft shoulder for highlights.
[[nodiscard]] Vec3 developed(Vec3 linear) noexcept;

}  // namespace dibhr::sample
