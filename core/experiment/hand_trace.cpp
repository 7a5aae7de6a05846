// Resampling: equal times, pauses, and the way back.
#include "core/experiment/hand_trace.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace dibhr {

namespace {

constexpr double kUpdate_s = 1e-3;
constexpr double kFullPressure_px = 25.0;
constexpr double kLifted_px = 3.0;
constexpr double kLongestPause_s = 0.5;

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
        for (; end < samples.size() && samples[end].t_s == samples[begin].t_s; ++end) {
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
        if (slope_before * slope_after <= 0.0) continue;  // a peak stays one
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

}  // namespace dibhr
