// For how long a quantity had which value.
#include "core/report/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dibhr {

namespace {

constexpr double kMostBins = 200000.0;

/// The narrowest of 1, 2 or 5 times a power of ten bins of which `most` reach to `bins`.
std::size_t round_bins(double bins, int most) {
    for (std::size_t power = 1;; power *= 10) {
        for (const std::size_t factor : {1U, 2U, 5U}) {
            if (std::ceil(bins / static_cast<double>(factor * power)) <= most) {
                return factor * power;
            }
        }
    }
}

}  // namespace

void Distribution::add(double value, double seconds) {
    if (!std::isfinite(value) || value < 0.0) return;
    const auto bin = static_cast<std::size_t>(std::min(value / resolution_, kMostBins));
    if (bin >= bin_s_.size()) bin_s_.resize(bin + 1, 0.0);
    bin_s_[bin] += seconds;
    total_s_ += seconds;
    sum_ += value * seconds;
    peak_ = std::max(peak_, value);
}

double Distribution::mean() const noexcept {
    return total_s_ > 0.0 ? sum_ / total_s_ : 0.0;
}

double Distribution::quantile(double share) const {
    double below_s = 0.0;
    for (std::size_t bin = 0; bin < bin_s_.size(); ++bin) {
        below_s += bin_s_[bin];
        if (below_s >= share * total_s_) {
            return std::min((static_cast<double>(bin) + 0.5) * resolution_, peak_);
        }
    }
    return peak_;
}

Bars Distribution::bars(double upto, int most) const {
    const double wanted_bins = std::clamp(upto / resolution_, 1.0, kMostBins);
    const std::size_t each = round_bins(wanted_bins, std::max(most, 1));
    const double wanted = std::ceil(wanted_bins / static_cast<double>(each));
    Bars bars{resolution_ * static_cast<double>(each), {}, 0.0};
    bars.seconds.resize(static_cast<std::size_t>(wanted), 0.0);
    for (std::size_t bin = 0; bin < bin_s_.size(); ++bin) {
        const std::size_t bar = bin / each;
        (bar < bars.seconds.size() ? bars.seconds[bar] : bars.beyond_s) += bin_s_[bin];
    }
    return bars;
}

}  // namespace dibhr
