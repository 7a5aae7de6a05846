// Runs the finger on the program's own algorithm, and sums its numbers.
#include "tests/bench/finger_run.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "core/haptics/touch.hpp"
#include "core/metrics/force_variation.hpp"
#include "tests/support/pressing_finger.hpp"

namespace dibhr::bench {

namespace {

using test::kFingerTick_s;

constexpr double kBandFrom_hz = 30.0;  // to 500 Hz, which is all there is at 1 kHz
constexpr double kStandsStill_px = 1e-3;
constexpr double kCliffSlope = 3.0;
constexpr double kNearCliff_px = 6.0;

/// The part of a force above kBandFrom_hz: a second-order Butterworth high-pass by the bilinear
/// transform. It begins as if the first value had always been there.
class Band {
  public:
    explicit Band(Vec3 first) : in1_(first), in2_(first) {
        const double w = 2.0 * std::numbers::pi * kBandFrom_hz * kFingerTick_s;
        const double alpha = std::sin(w) / std::numbers::sqrt2;
        const double scale = 1.0 / (1.0 + alpha);
        in_ = (1.0 + std::cos(w)) / 2.0 * scale;
        back1_ = 2.0 * std::cos(w) * scale;
        back2_ = -(1.0 - alpha) * scale;
    }
    Vec3 next(Vec3 value) {
        const Vec3 out = in_ * (value - 2.0 * in1_ + in2_) + back1_ * out1_ + back2_ * out2_;
        in2_ = in1_;
        in1_ = value;
        out2_ = out1_;
        out1_ = out;
        return out;
    }

  private:
    double in_{0.0}, back1_{0.0}, back2_{0.0};
    Vec3 in1_, in2_;
    Vec3 out1_{0.0}, out2_{0.0};
};

bool stands_still(Vec3 before, Vec3 now) {
    return glm::length(Vec2(now.x - before.x, now.y - before.y)) < kStandsStill_px;
}

/// Of the steeper triangle of cell (i, j).
double slope_of_cell(const DepthSurface& surface, int i, int j) {
    const double here = surface.elevation(i, j);
    const double right = surface.elevation(i + 1, j);
    const double below = surface.elevation(i, j + 1);
    const double across = surface.elevation(i + 1, j + 1);
    return std::max(std::hypot(right - here, below - here),
                    std::hypot(across - below, across - right));
}

}  // namespace

bool is_near_cliff(const DepthSurface& surface, Vec2 place) {
    const auto first = [](double at) {
        return std::max(0, static_cast<int>(std::floor(at - kNearCliff_px)));
    };
    const auto last = [](double at, int vertices) {
        return std::min(vertices - 2, static_cast<int>(std::ceil(at + kNearCliff_px)));
    };
    for (int j = first(place.y); j <= last(place.y, surface.rows()); ++j)
        for (int i = first(place.x); i <= last(place.x, surface.columns()); ++i)
            if (std::hypot(i + 0.5 - place.x, j + 0.5 - place.y) <= kNearCliff_px &&
                slope_of_cell(surface, i, j) > kCliffSlope)
                return true;
    return false;
}

FingerRun press(std::span<const Frame> frames, std::size_t milliseconds, double time_constant_s,
                const Path& path, const TouchParameters& parameters) {
    const auto surface_at = [&](std::size_t k) {
        const double time_s = frames.front().time_s + static_cast<double>(k) * kFingerTick_s;
        return depth_at(frames, time_s).surface(parameters.shape);
    };
    const std::unique_ptr<ProxyAlgorithm> algorithm = make_algorithm(parameters.algorithm);
    const Vec2 begin = path(0);
    test::PressingFinger finger(surface_at(0).elevation_at(begin.x, begin.y), time_constant_s);
    FingerRun finger_run;
    for (std::size_t k = 0; k < milliseconds; ++k) {
        const DepthSurface surface = surface_at(k);
        const Vec2 place = path(k);
        const double elevation_px = surface.elevation_at(place.x, place.y);
        const Vec3 goal(place, finger.follow(elevation_px));
        const Proxy& proxy = algorithm->update(surface, goal, parameters.friction);
        finger_run.goals.push_back(goal);
        finger_run.proxies.push_back(proxy.position);
        finger_run.forces_newton.push_back(
            coupling_force(proxy, goal, Vec3(0.0), parameters.coupling));
        finger_run.depths_px.push_back(std::max(elevation_px - goal.z, 0.0));
        finger_run.contact.push_back(proxy.contact ? 1 : 0);
        const Vec2 over(proxy.position.x, proxy.position.y);
        finger_run.near_cliff.push_back(is_near_cliff(surface, over) ? 1 : 0);
    }
    return finger_run;
}

double contact_beside_holes(const FeelNumbers& numbers) {
    std::size_t milliseconds = 0;
    for (const Cause cause : {Cause::hole, Cause::unseen, Cause::gone})
        milliseconds += numbers.lost[cause];
    const double with_data_s = numbers.seconds - kFingerTick_s * static_cast<double>(milliseconds);
    if (with_data_s < kFingerTick_s) return 1.0;
    return std::min(1.0, numbers.contact * numbers.seconds / with_data_s);
}

void FeelSums::add(const FingerRun& finger_run, std::span<const char> left_out,
                   const LostContact& lost) {
    if (finger_run.goals.empty()) return;
    Band band(finger_run.forces_newton.front());
    for (std::size_t k = 1; k < finger_run.goals.size(); ++k) {
        const Vec3 in_band = band.next(finger_run.forces_newton[k]);
        if (!left_out.empty() && left_out[k] != 0) continue;
        ++milliseconds_;
        squares_ += glm::dot(in_band, in_band);
        steps_.push_back(
            glm::length(finger_run.forces_newton[k] - finger_run.forces_newton[k - 1]));
        in_contact_ += finger_run.contact[k] != 0 ? 1 : 0;
        still_ += stands_still(finger_run.proxies[k - 1], finger_run.proxies[k]) ? 1 : 0;
    }
    lost_ += lost;
}

FeelNumbers FeelSums::numbers() const {
    FeelNumbers numbers;
    numbers.lost = lost_;
    if (milliseconds_ == 0) return numbers;
    const auto count = static_cast<double>(milliseconds_);
    const SampleStatistics steps = statistics_of(steps_);
    numbers.buzz_newton = std::sqrt(squares_ / count);
    numbers.step_p99 = steps.p99;
    numbers.step_p999 = steps.p999;
    numbers.stuck = static_cast<double>(still_) / count;
    numbers.contact = static_cast<double>(in_contact_) / count;
    numbers.seconds = count * kFingerTick_s;
    return numbers;
}

}  // namespace dibhr::bench
