// The slopes, and the cubic between two samples.
#include "core/experiment/smooth_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace dibhr {

SmoothCurve::SmoothCurve(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values)) {
    assert(!times_.empty() && times_.size() == values_.size());
    slopes_.assign(times_.size(), 0.0);
    for (std::size_t k = 1; k + 1 < times_.size(); ++k) {
        const double before = times_[k] - times_[k - 1];
        const double after = times_[k + 1] - times_[k];
        const double slope_before = (values_[k] - values_[k - 1]) / before;
        const double slope_after = (values_[k + 1] - values_[k]) / after;
        if (slope_before * slope_after <= 0.0) continue;  // a peak stays one
        const double near = 2.0 * after + before;
        const double far = after + 2.0 * before;
        slopes_[k] = (near + far) / (near / slope_before + far / slope_after);
    }
}

double SmoothCurve::at(double t) const noexcept {
    if (t <= times_.front()) return values_.front();
    if (t >= times_.back()) return values_.back();
    const auto after = std::upper_bound(times_.begin(), times_.end(), t);
    const auto k = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double width = times_[k + 1] - times_[k];
    const double u = (t - times_[k]) / width;
    const double v = 1.0 - u;
    return v * v * ((1.0 + 2.0 * u) * values_[k] + u * width * slopes_[k]) +
           u * u * ((1.0 + 2.0 * v) * values_[k + 1] - v * width * slopes_[k + 1]);
}

}  // namespace dibhr
