// The three standard curves from 0 to 1 of psychometric functions.
#pragma once

#include "core/psychophysics/psychometric.hpp"

namespace dibhr {

struct CurvePoint {
    double share{0.0};
    double density{0.0};  ///< its derivative
};

[[nodiscard]] CurvePoint standard_curve(Curve curve, double u) noexcept;

/// The place at which the curve is `share`, in (0, 1).
[[nodiscard]] double standard_quantile(Curve curve, double share);

/// From x to the curve's axis, which is x or ln x, and back.
[[nodiscard]] double to_axis(Curve curve, double x) noexcept;
[[nodiscard]] double from_axis(Curve curve, double place) noexcept;

}  // namespace dibhr
