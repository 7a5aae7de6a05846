// A stream of goals from a CSV file, one row per update, repeated: scripted runs, `dibhr touch`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/loop/device.hpp"

namespace dibhr {

struct TimedGoal {
    double t_s{0.0};
    Vec3 goal_in_grid{0.0};
};

/// Reads GOALS.csv: header `t,x,y,z` (columns in any order, more are ignored), seconds and
/// grid-space pixels. Throws InputError naming file, line and column for a missing column, a value
/// that is no finite number, a time before the one above it, or a file without rows.
[[nodiscard]] std::vector<TimedGoal> read_goals(const std::filesystem::path& file);

class GoalStream final : public Device {
  public:
    /// `goals` must not be empty.
    GoalStream(std::string name, std::vector<TimedGoal> goals);
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return specification_;
    }
    HandReading read(const HandContext& context) noexcept override;
    void send(Vec3 force_newton) noexcept override;

  private:
    DeviceSpecification specification_{};
    std::vector<TimedGoal> goals_{};
    std::size_t next_{0};
};

}  // namespace dibhr
