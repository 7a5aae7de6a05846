// Checks the rows of GOALS.csv.
#include "device/goal_stream.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

GoalReader::GoalReader(const std::filesystem::path& file)
    : file_(file.string()), table_(file, "give a CSV file with the columns t,x,y,z") {
    constexpr std::array<std::string_view, 4> kColumns{"t", "x", "y", "z"};
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        const auto column = table_.find({&kColumns[k], 1});
        if (!column) {
            table_.refuse("column " + std::string(kColumns[k]) +
                          " is missing; the first line must name the columns t,x,y,z");
        }
        columns_[k] = *column;
    }
}

bool GoalReader::next(std::size_t most, std::vector<TimedGoal>& goals) {
    goals.clear();
    while (goals.size() < most && table_.next()) {
        std::array<double, 4> values{};
        std::transform(columns_.begin(), columns_.end(), values.begin(),
                       [this](std::size_t column) { return table_.number(column); });
        const auto& [t_s, x, y, z] = values;
        if (last_t_s_ && t_s < *last_t_s_)
            table_.refuse("column t: time falls; sort the rows by time");
        last_t_s_ = t_s;
        goals.push_back({t_s, {x, y, z}});
    }
    if (!last_t_s_)
        throw InputError(file_ + ": holds no goals; add at least one row below the header t,x,y,z");
    return !goals.empty();
}

std::vector<TimedGoal> read_goals(const std::filesystem::path& file) {
    std::vector<TimedGoal> goals;
    GoalReader(file).next(goals.max_size(), goals);
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
