// Quantiles and histograms of measured values.
#include "device/hand/check/numbers.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostKept = 200'000;
constexpr std::array kUpTo_ms{0.01, 0.02, 0.05, 0.1,  0.2,   0.5,   1.0,   2.0,
                              5.0,  10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0};

}  // namespace

void Sample::add(double value) {
    most_ = std::max(most_, value);
    if (count_++ % stride_ != 0) return;
    values_.push_back(value);
    if (values_.size() < kMostKept) return;
    for (std::size_t k = 0; 2 * k < values_.size(); ++k) values_[k] = values_[2 * k];
    values_.resize((values_.size() + 1) / 2);
    stride_ *= 2;
}

double Sample::quantile(double part) const {
    if (values_.empty()) return 0.0;
    std::vector<double> values = values_;
    const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

std::size_t Sample::different() const {
    std::vector<double> values = values_;
    std::sort(values.begin(), values.end());
    return static_cast<std::size_t>(
        std::distance(values.begin(), std::unique(values.begin(), values.end())));
}

void Histogram::add(double value) {
    counts_.resize(kUpTo_ms.size() + 1);
    const auto* const bin = std::lower_bound(kUpTo_ms.begin(), kUpTo_ms.end(), value);
    ++counts_[static_cast<std::size_t>(bin - kUpTo_ms.begin())];
}

Json Histogram::as_json() const {
    Json bins = Json::array();
    for (std::size_t k = 0; k < counts_.size(); ++k) {
        if (counts_[k] == 0) continue;
        Json bin = Json::object();
        if (k < kUpTo_ms.size()) bin["up_to_ms"] = kUpTo_ms.at(k);
        bin["count"] = counts_[k];
        bins.push_back(bin);
    }
    return bins;
}

std::string rate_in_words(double per_s, const Sample& took_ms) {
    return number_text(per_s, 0) + " a second (half within " +
           number_text(took_ms.quantile(0.5), 2) + " ms, 99 % within " +
           number_text(took_ms.quantile(0.99), 2) + " ms)";
}

}  // namespace dibhr
