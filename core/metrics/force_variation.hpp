// How smoothly the force turns, angles between forces, and statistics of samples.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "core/haptics/vec.hpp"

namespace dibhr {

inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;

/// How the direction of the force turned from one update to the next, both in contact [deg].
struct VariationStatistics {
    double mean_deg{0.0};
    double sd_deg{0.0};
    /// While the proxy slides: without the updates in which the goal reverses, and without the
    /// path's settling.
    double mean_without_reversals_deg{0.0};
    double sd_without_reversals_deg{0.0};
    std::uint64_t pairs{0};                    ///< number of pairs of updates in the first two
    std::uint64_t pairs_without_reversals{0};  ///< and in the last two
};

/// Angle between two directions [rad], exact for the smallest ones too; 0 when either has no
/// length.
[[nodiscard]] double angle_between_rad(Vec3 a, Vec3 b) noexcept;

/// The updates in which a motion along the image reverses: from the update in which it turns by
/// more than 90 degrees, until the goal is 2 mu depth away, where a proxy that friction holds is
/// dragged again. The motion's start counts as such a turn. `depths_px`: of each goal below the
/// surface.
[[nodiscard]] std::vector<char> reversal_updates(std::span<const Vec3> goals,
                                                 std::span<const double> depths_px, double mu);

/// Variation of the force `proxy - goal` of successive updates, both in contact. The first
/// `settling_updates`, and those marked in `reversal`, count in the first two numbers only.
[[nodiscard]] VariationStatistics force_variation(std::span<const Vec3> goals,
                                                  std::span<const Vec3> proxies,
                                                  std::span<const char> contact,
                                                  std::span<const char> reversal,
                                                  std::size_t settling_updates);

/// Mean and standard deviation, gathered one by one (Welford).
class Spread {
  public:
    void add(double value) noexcept {
        ++count_;
        const double off = value - mean_;
        mean_ += off / static_cast<double>(count_);
        squares_ += off * (value - mean_);
    }
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    [[nodiscard]] double mean() const noexcept { return mean_; }
    [[nodiscard]] double sd() const noexcept {
        return count_ == 0 ? 0.0 : std::sqrt(squares_ / static_cast<double>(count_));
    }

  private:
    std::uint64_t count_{0};
    double mean_{0.0};
    double squares_{0.0};
};

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
