// Colour ramps for depth: perceptual colour maps.
#pragma once

#include "core/video/frames/colour_image.hpp"

namespace dibhr {

/// Turbo: Mikhailov, Google AI Blog 2019. Viridis: Smith and van der Walt, Matplotlib 2015; equal
/// steps look equally far apart, also to people who do not tell red from green.
enum class ColourRamp { turbo, viridis, grey };

/// From the lowest value to the highest: one row of 256 pixels.
[[nodiscard]] ColourImage colours_of(ColourRamp ramp);

}  // namespace dibhr
