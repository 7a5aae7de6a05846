// The CSV file of a trace.
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/experiment/hand_trace.hpp"
#include "core/files/csv_text.hpp"

namespace dibhr {

namespace {

constexpr double kNoPressure = 0.5;
constexpr const char* kWanted =
    "give a CSV file with columns like t_s,x_mm,y_mm and, if known, pressure01,pen_down";

using Names = std::span<const std::string_view>;
constexpr std::array<std::string_view, 4> kSeconds{"t_s", "time_s", "t", "time"};
constexpr std::array<std::string_view, 2> kMilliseconds{"t_ms", "time_ms"};
constexpr std::array<std::string_view, 2> kPressures{"pressure01", "pressure"};
constexpr std::array<std::string_view, 1> kPenDown{"pen_down"};
constexpr std::array<std::array<std::string_view, 2>, 3> kPlaces{
    {{"x_mm", "y_mm"}, {"x", "y"}, {"x01", "y01"}}};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
    throw InputError(file.string() + ": " + what + "; " + kWanted);
}

std::vector<std::string_view> split_row(std::string_view row) {
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0; begin <= row.size();) {
        const std::size_t end = std::min(row.find(',', begin), row.size());
        cells.push_back(trimmed(row.substr(begin, end - begin)));
        begin = end + 1;
    }
    return cells;
}

/// Where each of a sample's values stands in a row.
class TraceColumns {
  public:
    TraceColumns(const std::filesystem::path& file, std::string_view header)
        : file_(file), cells_(split_row(header)) {
        time_ = find(kSeconds);
        if (!time_) {
            time_ = find(kMilliseconds);
            per_second_ = 1e3;
        }
        if (!time_) refuse(file, "has no column of times");
        for (const auto& place : kPlaces) {
            x_ = find(Names(&place[0], 1));
            y_ = find(Names(&place[1], 1));
            if (x_ && y_) break;
        }
        if (!x_ || !y_) refuse(file, "has no columns of places");
        pressure_ = find(kPressures);
        pen_down_ = find(kPenDown);
    }

    [[nodiscard]] TraceSample sample(std::string_view row, std::size_t line) const {
        const auto cells = split_row(row);
        TraceSample sample;
        sample.t_s = number(cells, *time_, line) / per_second_;
        sample.place = {number(cells, *x_, line), number(cells, *y_, line)};
        sample.pressure =
            pressure_ ? std::clamp(number(cells, *pressure_, line), 0.0, 1.0) : kNoPressure;
        sample.down = !pen_down_ || number(cells, *pen_down_, line) != 0.0;
        return sample;
    }

  private:
    [[nodiscard]] std::optional<std::size_t> find(Names names) const {
        for (const std::string_view name : names) {
            const auto found = std::find(cells_.begin(), cells_.end(), name);
            if (found != cells_.end()) return static_cast<std::size_t>(found - cells_.begin());
        }
        return std::nullopt;
    }

    [[nodiscard]] double number(const std::vector<std::string_view>& cells, std::size_t column,
                                std::size_t line) const {
        const std::string_view cell = column < cells.size() ? cells[column] : std::string_view{};
        double value = 0.0;
        const char* const end = cell.data() + cell.size();
        const auto [stop, error] = std::from_chars(cell.data(), end, value);
        if (cell.empty() || error != std::errc{} || stop != end || !std::isfinite(value)) {
            refuse(file_, "line " + std::to_string(line) + ": " + in_quotes(cell) + " in column " +
                              in_quotes(cells_[column]) + " is no finite number");
        }
        return value;
    }

    const std::filesystem::path& file_;
    std::vector<std::string_view> cells_;
    std::optional<std::size_t> time_{};
    std::optional<std::size_t> x_{};
    std::optional<std::size_t> y_{};
    std::optional<std::size_t> pressure_{};
    std::optional<std::size_t> pen_down_{};
    double per_second_{1.0};
};

}  // namespace

std::vector<TraceSample> read_trace(const std::filesystem::path& file) {
    const std::string text = text_of_file(file, kWanted);
    std::string_view rest = without_mark(text);
    const auto next_line = [&rest] {
        const auto end = std::min(rest.find('\n'), rest.size());
        const std::string_view row = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        return row;
    };
    const TraceColumns columns(file, next_line());
    std::vector<TraceSample> samples;
    for (std::size_t line = 2; !rest.empty(); ++line) {
        const std::string_view row = next_line();
        if (row.find_first_not_of(" \t\r") == std::string_view::npos) continue;
        samples.push_back(columns.sample(row, line));
        const bool falls =
            samples.size() > 1 && samples.back().t_s < samples[samples.size() - 2].t_s;
        if (falls) refuse(file, "line " + std::to_string(line) + ": the time falls");
    }
    if (samples.size() < 2 || samples.back().t_s == samples.front().t_s) {
        refuse(file, "has fewer than two rows at different times");
    }
    return samples;
}

}  // namespace dibhr
