// Ages of the poses that a haptic loop used.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace dibhr {

/// A histogram of ages in fixed memory. Its counts only grow: the difference of two copies has the
/// ages between them.
class PoseAges {
  public:
    static constexpr std::chrono::microseconds kBin{50};
    static constexpr std::size_t kBins = 401;    ///< the last one: 20 ms and older
    static constexpr double kLongest_ms = 20.0;  ///< a quantile above it means: so old, or older

    /// The age in one tick; below zero counts as zero.
    void add(std::chrono::nanoseconds age) noexcept {
        const auto bin = std::max<std::int64_t>(age / kBin, 0);
        ++bins_[std::min(static_cast<std::size_t>(bin), kBins - 1)];
    }
    /// The ages added after `earlier`, an older copy of this histogram.
    [[nodiscard]] PoseAges since(const PoseAges& earlier) const noexcept {
        PoseAges later;
        for (std::size_t k = 0; k < kBins; ++k) later.bins_[k] = bins_[k] - earlier.bins_[k];
        return later;
    }

    [[nodiscard]] std::uint64_t count() const noexcept {
        std::uint64_t count = 0;
        for (const std::uint32_t bin : bins_) count += bin;
        return count;
    }
    /// The upper end of the bin that holds quantile `part` in [0, 1] [ms]; zero while nothing was
    /// added. 20.05 ms stand for 20 and everything older.
    [[nodiscard]] double quantile_ms(double part) const noexcept {
        const std::uint64_t all = count();
        if (all == 0) return 0.0;
        const auto before = static_cast<std::uint64_t>(part * static_cast<double>(all - 1));
        std::uint64_t passed = 0;
        std::size_t k = 0;
        while (k + 1 < kBins && (passed += bins_[k]) <= before) ++k;
        return std::chrono::duration<double, std::milli>(kBin * (k + 1)).count();
    }

  private:
    std::array<std::uint32_t, kBins> bins_{};
};

}  // namespace dibhr
