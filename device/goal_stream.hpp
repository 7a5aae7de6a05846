// A stream of goals from a CSV file, one row per update: repeated for scripted runs, once for
// `dibhr touch`.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/csv_table.hpp"
#include "core/loop/device.hpp"

namespace dibhr {

struct TimedGoal {
    double t_s{0.0};
    Vec3 goal_in_grid{0.0};
};

/// Reads GOALS.csv row by row: header `t,x,y,z` (columns in any order, more are ignored), seconds
/// and grid-space pixels. Each function throws InputError naming file, line and column for a
/// missing column, a value that is no finite number, a time before the one above it, or a file
/// without rows.
class GoalReader {
  public:
    explicit GoalReader(const std::filesystem::path& file);

    /// At most `most` goals, which take the place of those in `goals`. False: there are no more.
    bool next(std::size_t most, std::vector<TimedGoal>& goals);

    /// As CsvTable::share_read().
    [[nodiscard]] double share_read() const noexcept { return table_.share_read(); }

  private:
    std::string file_;
    CsvTable table_;
    std::array<std::size_t, 4> columns_{};  ///< of t, x, y and z
    std::optional<double> last_t_s_{};
};

/// All goals of a file, at least one. Throws as GoalReader.
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
