// A stream of goals from a CSV file, one row an update, repeated: scripted runs and `dibhr touch`.
#include "device/goal_stream.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/csv_text.hpp"

namespace dibhr {

namespace {

constexpr std::array<std::string_view, 4> kColumns{"t", "x", "y", "z"};
constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

/// Where in the file a value stands, for messages.
struct Place {
    const std::string& file;
    std::size_t line{0};
};

[[noreturn]] void refuse(const Place& place, const std::string& what) {
    throw InputError(place.file + ":" + std::to_string(place.line) + ": " + what);
}

/// Takes the text up to `separator` off the front of `rest`.
std::string_view taken(std::string_view& rest, char separator) {
    const auto end = rest.find(separator);
    const auto part = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return part;
}

using ColumnIndices = std::array<std::size_t, kColumns.size()>;

ColumnIndices read_header(std::string_view header, const Place& place) {
    ColumnIndices indices;
    indices.fill(kAbsent);
    for (std::size_t index = 0; !header.empty(); ++index) {
        const auto name = trimmed(taken(header, ','));
        const auto* column = std::find(kColumns.begin(), kColumns.end(), name);
        if (column == kColumns.end()) continue;
        auto& place_of_column = indices[static_cast<std::size_t>(column - kColumns.begin())];
        if (place_of_column != kAbsent) {
            refuse(place, "column " + std::string(name) + " stands twice; keep one of them");
        }
        place_of_column = index;
    }
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        if (indices[k] != kAbsent) continue;
        refuse(place, "column " + std::string(kColumns[k]) +
                          " is missing; the first line must name the columns t,x,y,z");
    }
    return indices;
}

double read_number(std::string_view text, std::string_view column, const Place& place) {
    const std::string which = "column " + std::string(column) + ": ";
    if (text.empty()) refuse(place, which + "no value; give a number");
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc::result_out_of_range) {
        refuse(place, which + in_quotes(text) + " is out of range; give a smaller number");
    }
    if (error != std::errc() || stop != end || !std::isfinite(value)) {
        refuse(place, which + in_quotes(text) + " is no finite number; give one such as 12.5");
    }
    return value;
}

TimedGoal read_row(std::string_view row, const ColumnIndices& indices, const Place& place) {
    std::array<std::string_view, kColumns.size()> fields{};
    for (std::size_t index = 0; !row.empty(); ++index) {
        const auto field = trimmed(taken(row, ','));
        const auto* column = std::find(indices.begin(), indices.end(), index);
        if (column != indices.end()) {
            fields[static_cast<std::size_t>(column - indices.begin())] = field;
        }
    }
    std::array<double, kColumns.size()> values{};
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        values[k] = read_number(fields[k], kColumns[k], place);
    }
    return {values[0], {values[1], values[2], values[3]}};
}

}  // namespace

std::vector<TimedGoal> read_goals(const std::filesystem::path& file) {
    const std::string text = text_of_file(file, "give a CSV file with the columns t,x,y,z");
    std::string_view rest = without_mark(text);

    const std::string name = file.string();
    Place place{name, 1};
    const ColumnIndices indices = read_header(taken(rest, '\n'), place);
    std::vector<TimedGoal> goals;
    while (!rest.empty()) {
        ++place.line;
        const auto row = taken(rest, '\n');
        if (trimmed(row).empty()) continue;
        const TimedGoal goal = read_row(row, indices, place);
        if (!goals.empty() && goal.t_s < goals.back().t_s) {
            refuse(place, "column t: time falls; sort the rows by time");
        }
        goals.push_back(goal);
    }
    if (goals.empty()) {
        throw InputError(name + ": holds no goals; add at least one row below the header t,x,y,z");
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
