// Nearest-rank quantiles.
#include "core/metrics/sample_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dibhr {

SampleStatistics statistics_of(std::vector<double> samples) {
    if (samples.empty()) return {};
    std::sort(samples.begin(), samples.end());
    const auto count = static_cast<double>(samples.size());
    const auto at = [&](double q) {
        const double rank = std::ceil(q * count);
        return samples[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
    };
    const double sum = std::accumulate(samples.begin(), samples.end(), 0.0);
    return {samples.size(), sum / count, at(0.5), at(0.99), at(0.999), samples.back()};
}

}  // namespace dibhr
