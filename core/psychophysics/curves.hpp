// The three curves from 0 to 1 that psychometric functions are stretched from.
#pragma once

#include "core/psychophysics/psychometric.hpp"

namespace dibhr {

struct CurvePoint {
    double share{0.0};
    double density{0.0};  ///< its derivative
};

[[nodiscard]] CurvePoint standard_curve(Curve curve, double u) noexcept;

/// Where the curve is `share`, in (0, 1).
[[nodiscard]] double standard_quantile(Curve curve, double share);

/// The axis the curve is stretched along: x, or ln x.
[[nodiscard]] double on_axis(Curve curve, double x) noexcept;
[[nodiscard]] double off_axis(Curve curve, double place) noexcept;

}  // namespace dibhr
