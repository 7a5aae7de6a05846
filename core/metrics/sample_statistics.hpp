// Mean and quantiles of a run's measurements.
#pragma once

#include <cstddef>
#include <vector>

namespace dibhr {

struct SampleStatistics {
    std::size_t count{0};
    double mean{0.0};
    double median{0.0};
    double p99{0.0};
    double p999{0.0};
    double highest{0.0};
};

/// Nearest-rank quantiles; all zero for no samples.
[[nodiscard]] SampleStatistics statistics_of(std::vector<double> samples);

}  // namespace dibhr
