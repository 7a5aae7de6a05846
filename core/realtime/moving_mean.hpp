// What something takes of late: a mean in which the newest counts most.
#pragma once

namespace dibhr {

/// `mean` moved towards `newest`; about the last 1 / `weight` count.
[[nodiscard]] constexpr double moving_mean(double mean, double newest,
                                           double weight = 0.1) noexcept {
    return mean + weight * (newest - mean);
}

/// The same of a mean that is 0 before the first.
[[nodiscard]] constexpr double moving_mean_from_first(double mean, double newest,
                                                      double weight = 0.1) noexcept {
    return moving_mean(mean, newest, mean > 0.0 ? weight : 1.0);
}

}  // namespace dibhr
