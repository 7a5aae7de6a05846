// A stream of goals from a CSV file, one row an update, repeated: scripted runs and `dibhr touch`.
#include "device/goal_stream.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr std::array<std::string_view, 4> kColumns{"t", "x", "y", "z"};
constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);
constexpr std::size_t kLongestQuote = 40;

/// Where in the file a value stands, for messages.
struct Place {
    const std::string& file;
    std::size_t line{0};
};

[[noreturn]] void refuse(const Place& place, const std::string& what) {
    throw InputError(place.file + ":" + std::to_string(place.line) + ": " + what);
}

// Whatever the file holds, the message stays one short line.
std::string quoted(std::string_view text) {
    std::string result = "'" + std::string(text.substr(0, kLongestQuote));
    std::replace_if(
        result.begin(), result.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
    return result + (text.size() > kLongestQuote ? "...'" : "'");
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r";
    const auto first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// Takes the text up to `separator` off the front of `rest`.
std::string_view taken(std::string_view& rest, char separator) {
    const auto end = rest.find(separator);
    const auto part = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return part;
}

std::string whole_text(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        throw InputError(file.string() + ": is a folder; give a CSV file with the columns t,x,y,z");
    }
    if (std::filesystem::is_character_file(file, ignored)) {
        throw InputError(file.string() + ": is a device; give a CSV file with the columns t,x,y,z");
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw InputError(file.string() + ": cannot be opened (" + std::strerror(errno) +
                         "); give a CSV file with the columns t,x,y,z");
    }
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream.bad()) throw InputError(file.string() + ": cannot be read; check the disk");
    return text;
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
        refuse(place, which + quoted(text) + " is out of range; give a smaller number");
    }
    if (error != std::errc() || stop != end || !std::isfinite(value)) {
        refuse(place, which + quoted(text) + " is no finite number; give one such as 12.5");
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
    const std::string text = whole_text(file);
    std::string_view rest = text;
    if (rest.starts_with("\xEF\xBB\xBF"))
        rest.remove_prefix(3);  // the mark some editors write first

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
}

HandReading GoalStream::read(const HandContext& /*context*/) noexcept {
    const TimedGoal& goal = goals_[next_];
    next_ = next_ + 1 == goals_.size() ? 0 : next_ + 1;
    return {.goal_in_grid = goal.goal_in_grid};
}

void GoalStream::send(Vec3 /*force_newton*/) noexcept {}

}  // namespace dibhr
