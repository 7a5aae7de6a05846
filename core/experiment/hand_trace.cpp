// Resampling: equal times, pauses, and the way back.
#include "core/experiment/hand_trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/experiment/smooth_curve.hpp"

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

}  // namespace dibhr
