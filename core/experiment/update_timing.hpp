// How long a proxy algorithm's updates take, one by one.
#pragma once

#include <functional>
#include <vector>

#include "core/haptics/proxy.hpp"
#include "core/metrics/sample_statistics.hpp"

namespace dibhr {

struct UpdateTiming {
    SampleStatistics update_us{};  ///< each includes one reading of the clock
    double moves_per_update{0.0};
    bool bound_met{false};
};

/// What reading the clock itself costs [us]: the median of many.
[[nodiscard]] double clock_cost_us();

/// Runs the goals through the algorithm, from a restart, after one unmeasured pass that warms the
/// caches.
[[nodiscard]] UpdateTiming time_updates(ProxyAlgorithm& algorithm, const DepthSurface& surface,
                                        const std::vector<Vec3>& goals, const Friction& friction);

}  // namespace dibhr
