// How a replayed run differs from the recording: gathered update by update, in bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/touch.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

/// Samples without end: beyond a million, every second, fourth, ... one is kept for the quantiles.
class Samples {
  public:
    void add(double value);
    /// Count, mean and highest are of all.
    [[nodiscard]] SampleStatistics statistics() const;
    [[nodiscard]] double sd() const;

  private:
    std::vector<double> kept_{};
    std::size_t stride_{1};
    std::size_t count_{0};
    double mean_{0.0};
    double squares_{0.0};
    double highest_{0.0};
};

/// One run beside the recording. Ticks without a surface count for nothing but the bits and the
/// share of ticks in contact.
class RunComparison {
  public:
    void add(const TickRecord& recorded, const Touch& touch, double update_us);

    /// The update in which the run first gave other bits than recorded.
    struct Difference {
        std::int64_t tick{0};
        double t_s{0.0};
        Vec3 proxy{0.0}, recorded_proxy{0.0};
        Vec3 sent_newton{0.0}, recorded_newton{0.0};
    };
    [[nodiscard]] const std::optional<Difference>& first_difference() const noexcept {
        return first_difference_;
    }
    [[nodiscard]] std::int64_t differing() const noexcept { return differing_; }

    /// A line of the table under `comparison_heading()`.
    [[nodiscard]] std::string table_row(const std::string& name) const;

  private:
    std::int64_t ticks_{0};
    std::int64_t in_contact_{0};
    std::int64_t differing_{0};
    std::optional<Difference> first_difference_{};
    std::optional<Vec3> last_lag_{};  ///< goal to proxy in the update before, if in contact
    Samples time_us_{};
    Samples turn_deg_{};    ///< of the force from update to update, as in the paper
    Samples off_px_{};      ///< proxy from the recorded one
    Samples astray_deg_{};  ///< force from the recorded one, both in contact
};

[[nodiscard]] std::string comparison_heading();

}  // namespace dibhr
