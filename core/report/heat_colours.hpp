// The colours of a heat map: from little, pale, to much, dark.
#pragma once

#include "core/plot/canvas.hpp"

namespace dibhr {

/// `share` in [0, 1]. Lightness falls all along, so that the order survives colour blindness and a
/// black-and-white print.
[[nodiscard]] Ink heat_ink(double share);

}  // namespace dibhr
