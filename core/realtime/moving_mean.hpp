// The exponential moving average of repeated measurements.
#pragma once

namespace dibhr {

/// `mean` with `newest` added, which counts as `weight`, in (0, 1]; in their unit.
[[nodiscard]] constexpr double moving_mean(double mean, double newest,
                                           double weight = 0.1) noexcept {
    return mean + weight * (newest - mean);
}

/// The same, where `mean` is 0 before the first value, which then is the mean.
[[nodiscard]] constexpr double moving_mean_from_first(double mean, double newest,
                                                      double weight = 0.1) noexcept {
    return moving_mean(mean, newest, mean > 0.0 ? weight : 1.0);
}

}  // namespace dibhr
