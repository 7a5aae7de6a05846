// Colours that say how far: perceptual maps of the field.
#pragma once

#include "core/video/frames/colour_image.hpp"

namespace dibhr {

/// Turbo: Mikhailov, Google AI Blog 2019. Viridis: Smith and van der Walt, Matplotlib 2015; even
/// steps of it look evenly far apart, also to those who do not see red and green.
enum class ColourRamp { turbo, viridis, grey };

/// From the lowest value to the highest: one row of 256 pixels.
[[nodiscard]] ColourImage colours_of(ColourRamp ramp);

}  // namespace dibhr
