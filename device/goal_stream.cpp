// A stream of goals from a CSV file, one row per update, repeated: scripted runs, `dibhr touch`.
#include "device/goal_stream.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/files/csv_table.hpp"

namespace dibhr {

std::vector<TimedGoal> read_goals(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 4> kColumns{"t", "x", "y", "z"};
    CsvTable table(file, "give a CSV file with the columns t,x,y,z");
    std::array<std::size_t, kColumns.size()> columns{};
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        const auto column = table.find({&kColumns[k], 1});
        if (!column) {
            table.refuse("column " + std::string(kColumns[k]) +
                         " is missing; the first line must name the columns t,x,y,z");
        }
        columns[k] = *column;
    }
    std::vector<TimedGoal> goals;
    while (table.next()) {
        std::array<double, kColumns.size()> values{};
        std::transform(columns.begin(), columns.end(), values.begin(),
                       [&](std::size_t column) { return table.number(column); });
        const auto& [t_s, x, y, z] = values;
        if (!goals.empty() && t_s < goals.back().t_s) {
            table.refuse("column t: time falls; sort the rows by time");
        }
        goals.push_back({t_s, {x, y, z}});
    }
    if (goals.empty()) {
        throw InputError(file.string() +
                         ": holds no goals; add at least one row below the header t,x,y,z");
    }
    return goals;
}

GoalStream::GoalStream(std::string name, std::vector<TimedGoal> goals) : goals_(std::move(goals)) {
    assert(!goals_.empty());
    specification_.name = std::move(name);
    specification_.limits = kVirtualHandLimits;
}

HandReading GoalStream::read(const HandContext& /*context*/) noexcept {
    const TimedGoal& goal = goals_[next_];
    next_ = next_ + 1 == goals_.size() ? 0 : next_ + 1;
    return {.goal_in_grid = goal.goal_in_grid};
}

void GoalStream::send(Vec3 /*force_newton*/) noexcept {}

}  // namespace dibhr
