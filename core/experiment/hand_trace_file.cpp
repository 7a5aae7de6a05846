// The CSV file of a trace.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/experiment/hand_trace.hpp"
#include "core/files/csv_table.hpp"

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

/// Where each of a sample's values stands in a row.
class TraceColumns {
  public:
    explicit TraceColumns(const CsvTable& table)
        : table_(table), pressure_(table.find(kPressures)), pen_down_(table.find(kPenDown)) {
        auto time = table.find(kSeconds);
        if (!time) {
            time = table.find(kMilliseconds);
            per_second_ = 1e3;
        }
        if (!time) table.refuse(std::string("has no column of times; ") + kWanted);
        time_ = *time;
        for (const auto& place : kPlaces) {
            const auto x = table.find(Names(&place[0], 1));
            const auto y = table.find(Names(&place[1], 1));
            if (!x || !y) continue;
            x_ = *x;
            y_ = *y;
            return;
        }
        table.refuse(std::string("has no columns of places; ") + kWanted);
    }

    /// Of the table's row.
    [[nodiscard]] TraceSample sample() const {
        TraceSample sample;
        sample.t_s = table_.number(time_) / per_second_;
        sample.place = {table_.number(x_), table_.number(y_)};
        sample.pressure = pressure_ ? std::clamp(table_.number(*pressure_), 0.0, 1.0) : kNoPressure;
        sample.down = !pen_down_ || table_.number(*pen_down_) != 0.0;
        return sample;
    }

  private:
    const CsvTable& table_;
    std::size_t time_{0}, x_{0}, y_{0};
    std::optional<std::size_t> pressure_, pen_down_;
    double per_second_{1.0};
};

}  // namespace

std::vector<TraceSample> read_trace(const std::filesystem::path& file) {
    CsvTable table(file, kWanted);
    const TraceColumns columns(table);
    std::vector<TraceSample> samples;
    while (table.next()) {
        samples.push_back(columns.sample());
        const bool falls =
            samples.size() > 1 && samples.back().t_s < samples[samples.size() - 2].t_s;
        if (falls) table.refuse("the time falls; sort the rows by time");
    }
    if (samples.size() < 2 || samples.back().t_s == samples.front().t_s) {
        throw InputError(file.string() + ": has fewer than two rows at different times; " +
                         kWanted);
    }
    return samples;
}

}  // namespace dibhr
