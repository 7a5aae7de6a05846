// A recorded trace: its CSV file, and the motion it becomes at equal times.
#include "core/experiment/hand_motion.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/files/csv_table.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr double kFullPressure_px = 25.0;
constexpr double kLongestPause_s = 0.5;
constexpr double kOneTime_s = 1e-9;     // times that are nearer count as equal
constexpr double kFarthestPlace = 1e9;  // of any unit: beyond all traces, and no sum overflows

double penetration_of(const TraceSample& sample) {
    return sample.down ? kFullPressure_px * sample.pressure : -kLifted_px;
}

/// The columns of a trace, its times rising strictly from 0.
struct Columns {
    std::vector<double> t_s{};
    std::vector<double> x{};
    std::vector<double> y{};
    std::vector<double> penetration_px{};
};

Columns merged(const std::vector<TraceSample>& samples) {
    Columns columns;
    double t_s = 0.0;
    for (std::size_t begin = 0; begin < samples.size();) {
        Vec2 place{0.0};
        double penetration_px = 0.0;
        std::size_t end = begin;
        for (; end < samples.size() && samples[end].t_s - samples[begin].t_s < kOneTime_s; ++end) {
            place += samples[end].place;
            penetration_px += penetration_of(samples[end]);
        }
        if (begin > 0) {
            t_s += std::min(samples[begin].t_s - samples[begin - 1].t_s, kLongestPause_s);
        }
        const auto count = static_cast<double>(end - begin);
        columns.t_s.push_back(t_s);
        columns.x.push_back(place.x / count);
        columns.y.push_back(place.y / count);
        columns.penetration_px.push_back(penetration_px / count);
        begin = end;
    }
    return columns;
}

/// Time in a trace of `duration_s` that is run forth, back, forth, ...
double back_and_forth(double t_s, double duration_s) {
    const double round_s = std::fmod(t_s, 2.0 * duration_s);
    return round_s <= duration_s ? round_s : 2.0 * duration_s - round_s;
}

constexpr double kNoPressure = 0.5;
constexpr const char* kExpectedForm =
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
        if (!time) table.refuse(std::string("has no column of times; ") + kExpectedForm);
        time_ = *time;
        for (const auto& place : kPlaces) {
            const auto x = table.find(Names(&place[0], 1));
            const auto y = table.find(Names(&place[1], 1));
            if (!x || !y) continue;
            x_ = *x;
            y_ = *y;
            return;
        }
        table.refuse(std::string("has no columns of places; ") + kExpectedForm);
    }

    /// Of the table's row.
    [[nodiscard]] TraceSample sample() const {
        TraceSample sample;
        sample.t_s = table_.number(time_) / per_second_;
        sample.place = {place(x_), place(y_)};
        sample.pressure = pressure_ ? std::clamp(table_.number(*pressure_), 0.0, 1.0) : kNoPressure;
        sample.down = !pen_down_ || table_.number(*pen_down_) != 0.0;
        return sample;
    }

  private:
    [[nodiscard]] double place(std::size_t column) const {
        const double value = table_.number(column);
        if (std::abs(value) <= kFarthestPlace) return value;
        table_.refuse("the place " + short_text(value) +
                      " is farther than any hand goes; give it in another unit");
    }

    const CsvTable& table_;
    std::size_t time_{0}, x_{0}, y_{0};
    std::optional<std::size_t> pressure_, pen_down_;
    double per_second_{1.0};
};

}  // namespace

HandMotion motion_of_trace(const std::vector<TraceSample>& samples, const std::string& name,
                           int updates) {
    const Columns columns = merged(samples);
    const double duration_s = columns.t_s.back();
    const SmoothCurve x(columns.t_s, columns.x);
    const SmoothCurve y(columns.t_s, columns.y);
    const SmoothCurve penetration_px(columns.t_s, columns.penetration_px);
    HandMotion motion;
    motion.source = "a person's trace, " + name;
    for (int k = 0; k < updates; ++k) {
        const double t_s = back_and_forth(kUpdate_s * k, duration_s);
        motion.places.emplace_back(x.at(t_s), y.at(t_s));
        motion.penetrations_px.push_back(penetration_px.at(t_s));
    }
    return motion;
}

SmoothCurve::SmoothCurve(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values)) {
    assert(!times_.empty() && times_.size() == values_.size());
    slopes_.assign(times_.size(), 0.0);
    for (std::size_t k = 1; k + 1 < times_.size(); ++k) {
        const double before = times_[k] - times_[k - 1];
        const double after = times_[k + 1] - times_[k];
        const double slope_before = (values_[k] - values_[k - 1]) / before;
        const double slope_after = (values_[k + 1] - values_[k]) / after;
        if (slope_before * slope_after <= 0.0) continue;  // a peak keeps slope 0
        const double near = 2.0 * after + before;
        const double far = after + 2.0 * before;
        slopes_[k] = (near + far) / (near / slope_before + far / slope_after);
    }
}

double SmoothCurve::at(double t) const noexcept {
    if (t <= times_.front()) return values_.front();
    if (t >= times_.back()) return values_.back();
    const auto after = std::upper_bound(times_.begin(), times_.end(), t);
    const auto k = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double width = times_[k + 1] - times_[k];
    const double u = (t - times_[k]) / width;
    const double v = 1.0 - u;
    return v * v * ((1.0 + 2.0 * u) * values_[k] + u * width * slopes_[k]) +
           u * u * ((1.0 + 2.0 * v) * values_[k + 1] - v * width * slopes_[k + 1]);
}

std::vector<TraceSample> read_trace(const std::filesystem::path& file) {
    CsvTable table(file, kExpectedForm);
    const TraceColumns columns(table);
    std::vector<TraceSample> samples;
    while (table.next()) {
        samples.push_back(columns.sample());
        const bool falls =
            samples.size() > 1 && samples.back().t_s < samples[samples.size() - 2].t_s;
        if (falls) table.refuse("the time falls; sort the rows by time");
    }
    if (samples.size() < 2 || samples.back().t_s - samples.front().t_s < kOneTime_s) {
        throw InputError(file.string() + ": has fewer than two rows at different times; " +
                         kExpectedForm);
    }
    return samples;
}

}  // namespace dibhr
