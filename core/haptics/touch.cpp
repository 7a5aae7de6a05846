// Goal -> proxy -> spring force -> safe force, and the low-pass of the goal's velocity.
#include "core/haptics/touch.hpp"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/god_object.hpp"
#include "core/haptics/neighborhood.hpp"
#include "core/haptics/pga.hpp"

namespace dibhr {

namespace {

/// How much of the newest difference gets through: backward Euler, stable for every tick. Without
/// exp(), so that the bits are the same on every machine.
double share_of_newest(double dt_s, double cutoff_hz) noexcept {
    if (!(dt_s > 0.0)) return 0.0;
    if (!(cutoff_hz > 0.0)) return 1.0;
    return dt_s / (dt_s + 1.0 / (2.0 * std::numbers::pi * cutoff_hz));
}

}  // namespace

Vec3 coupling_force(const Proxy& proxy, Vec3 goal, Vec3 goal_velocity,
                    const Coupling& coupling) noexcept {
    if (!proxy.contact) return Vec3(0.0);
    const double mm = coupling.pixel_pitch_mm;
    return coupling.stiffness_newton_per_mm * mm * (proxy.position - goal) -
           coupling.damping_newton_s_per_m * 1e-3 * mm * goal_velocity;
}

std::unique_ptr<ProxyAlgorithm> make_algorithm(Algorithm algorithm) {
    switch (algorithm) {
        case Algorithm::dibhr:
            break;
        case Algorithm::pga:
            return std::make_unique<Pga>();
        case Algorithm::neighborhood:
            return std::make_unique<Neighborhood>();
        case Algorithm::god_object:
            return std::make_unique<GodObject>();
    }
    return std::make_unique<Dibhr>();
}

TouchRenderer::TouchRenderer() {
    for (const Algorithm algorithm : all_algorithms()) {
        algorithms_.push_back(make_algorithm(algorithm));
    }
}

void TouchRenderer::reset() noexcept {
    for (const auto& algorithm : algorithms_) algorithm->reset();
    running_ = Algorithm::dibhr;
    goal_velocity_ = {};
    safety_ = {};
    last_ = {};
    started_ = false;
}

void TouchRenderer::let_go() noexcept {
    algorithms_[static_cast<std::size_t>(running_)]->reset();
}

void TouchRenderer::pause() noexcept {
    goal_velocity_.forget();
    safety_.drop_to_zero();
}

bool TouchRenderer::run_with(Algorithm algorithm) noexcept {
    if (algorithm == running_) return false;
    const ProxyAlgorithm& left = *algorithms_[static_cast<std::size_t>(running_)];
    running_ = algorithm;
    algorithms_[static_cast<std::size_t>(running_)]->resume(left);
    return true;
}

const Touch& TouchRenderer::update(const DepthSurface& surface, Vec3 hand,
                                   const TouchParameters& parameters, SafetyInput input,
                                   const SafetyLimits& limits) noexcept {
    if (!is_finite(hand)) {
        goal_velocity_.forget();  // the next step takes longer than its tick
        last_.proxy.bound_met = false;
        last_.spring_force_newton = Vec3(0.0);
        last_.sent_force_newton = safety_.limit(Vec3(NAN), input, limits);
        last_.cut = safety_.last_cut();
        return last_;
    }
    const Vec3 goal = surface.clamped_to_reach(hand);
    const Vec3 goal_step = started_ ? goal - last_.goal : Vec3(0.0);
    input.goal_step_mm = glm::length(goal_step) * parameters.coupling.pixel_pitch_mm;
    const bool changed = run_with(parameters.algorithm);
    input.from_zero = input.from_zero || changed || !started_;
    started_ = true;

    last_.goal = goal;
    last_.proxy =
        algorithms_[static_cast<std::size_t>(running_)]->update(surface, goal, parameters.friction);
    if (input.from_zero || goal_jumped(input, limits)) goal_velocity_.forget();
    const Vec3 goal_velocity =
        goal_velocity_.after(goal_step, input.dt_s, parameters.coupling.damping_cutoff_hz);
    last_.spring_force_newton =
        coupling_force(last_.proxy, goal, goal_velocity, parameters.coupling);
    last_.sent_force_newton =
        safety_.limit(last_.spring_force_newton + input.device_force_newton, input, limits);
    last_.cut = safety_.last_cut();
    return last_;
}

Vec3 GoalVelocity::after(Vec3 step, double dt_s, double cutoff_hz) noexcept {
    const Vec3 difference = dt_s > 0.0 ? step / dt_s : Vec3(0.0);
    Vec3 filtered(0.0);
    if (continues_) {
        const Vec3 change = difference - filtered_px_per_s_;
        filtered = filtered_px_per_s_ + share_of_newest(dt_s, cutoff_hz) * change;
    }
    continues_ = is_finite(filtered);
    filtered_px_per_s_ = continues_ ? filtered : Vec3(0.0);
    return cutoff_hz > 0.0 ? filtered_px_per_s_ : difference;
}

}  // namespace dibhr
