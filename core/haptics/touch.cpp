// Goal -> proxy -> spring force -> safe force, and the low-pass of the goal's velocity.
#include "core/haptics/touch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/god_object.hpp"
#include "core/haptics/neighborhood.hpp"
#include "core/haptics/pga.hpp"

namespace dibhr {

Vec3 coupling_force(const Proxy& proxy, Vec3 goal, Vec3 goal_velocity,
                    const Coupling& coupling) noexcept {
    if (!proxy.contact) return Vec3(0.0);
    const double mm = coupling.pixel_pitch_mm;
    return coupling.stiffness_newton_per_mm * mm * (proxy.position - goal) -
           coupling.damping_newton_s_per_m * 1e-3 * mm * goal_velocity;
}

Friction felt_friction(const DepthSurface& surface, const Proxy& proxy, Vec3 goal,
                       Friction everywhere) noexcept {
    const Vec3& place = proxy.contact ? proxy.position : goal;
    return surface.friction_at(place.x, place.y, everywhere);
}

Coupling felt_coupling(const DepthSurface& surface, const Proxy& proxy, Coupling everywhere,
                       const SafetyLimits& limits) noexcept {
    const double k = surface.stiffness_at(proxy.position.x, proxy.position.y,
                                          everywhere.stiffness_newton_per_mm);
    if (k == everywhere.stiffness_newton_per_mm) return everywhere;
    Coupling here = everywhere;
    here.stiffness_newton_per_mm = std::max(0.0, std::min(k, limits.max_stiffness_newton_per_mm));
    here.damping_newton_s_per_m = std::max(
        here.damping_newton_s_per_m, needed_damping(here.stiffness_newton_per_mm, limits.watched));
    return here;
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
    video_motion_ = {};
    passivity_ = {};
    safety_ = {};
    last_ = {};
    felt_share_ = 1.0;
    started_ = false;
}

void TouchRenderer::let_go() noexcept {
    algorithms_[static_cast<std::size_t>(running_)]->reset();
}

void TouchRenderer::pause() noexcept {
    goal_velocity_.forget();
    passivity_.sent(Vec3(0.0));
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
        passivity_.sent(Vec3(0.0));
        last_.cut = safety_.last_cut();
        return last_;
    }
    const Vec3 goal = surface.clamped_to_reach(hand);
    const Vec3 goal_step = started_ ? goal - last_.goal : Vec3(0.0);
    input.goal_step_mm = glm::length(goal_step) * parameters.coupling.pixel_pitch_mm;
    const bool changed = run_with(parameters.algorithm);
    input.from_zero = input.from_zero || changed || !started_;
    started_ = true;

    const double rise_px = limits.watched.moves() ? rise_under_proxy(surface) : 0.0;
    last_.goal = goal;
    last_.proxy = algorithms_[static_cast<std::size_t>(running_)]->update(
        surface, goal, felt_friction(surface, last_.proxy, goal, parameters.friction));
    fade_unseen(surface, parameters.coupling.unseen_share, input.dt_s);
    if (felt_share_ == 0.0) last_.proxy.contact = false;
    const Coupling coupling = felt_coupling(surface, last_.proxy, parameters.coupling, limits);
    last_.spring_force_newton =
        felt_share_ * rendered_force(goal_step, rise_px, coupling, input, limits);
    last_.sent_force_newton =
        safety_.limit(last_.spring_force_newton + input.device_force_newton, input, limits);
    passivity_.sent(last_.sent_force_newton - input.device_force_newton);
    last_.cut = safety_.last_cut();
    last_.energy = passivity_.flow();
    return last_;
}

void TouchRenderer::fade_unseen(const DepthSurface& surface, double unseen_share,
                                double dt_s) noexcept {
    const Vec3& goal = last_.goal;
    const double wanted = surface.seen_at(goal.x, goal.y) ? 1.0 : unseen_share;
    const double step = dt_s > 0.0 ? dt_s / SafetyStage::kFade_s : 0.0;
    felt_share_ += std::clamp(wanted - felt_share_, -step, step);
}

double TouchRenderer::rise_under_proxy(const DepthSurface& surface) const noexcept {
    constexpr double kRoundOff_px = 1e-6;  // of a proxy on a still surface
    const Proxy& proxy = last_.proxy;
    if (proxy.bound_met) return 0.0;  // it is still on its way
    const double rise = surface.elevation_at(proxy.position.x, proxy.position.y) - proxy.position.z;
    const bool moved = std::abs(rise) > kRoundOff_px && (proxy.contact || rise > 0.0);
    return moved ? rise : 0.0;
}

Vec3 TouchRenderer::rendered_force(Vec3 goal_step, double rise_px, const Coupling& coupling,
                                   const SafetyInput& input, const SafetyLimits& limits) noexcept {
    const DeviceDynamics& device = limits.watched;
    const double mm = coupling.pixel_pitch_mm;
    const bool goes_on = !input.from_zero && !goal_jumped(input, limits);
    if (!goes_on) goal_velocity_.forget();
    const double resolution_px = device.moves() ? device.resolution_mm / mm : 0.0;
    const Vec3 velocity =
        goal_velocity_.after(goal_step, input.dt_s, coupling.damping_cutoff_hz, resolution_px);
    if (!device.moves()) {
        video_motion_.forget();
        passivity_ = {};
        return coupling_force(last_.proxy, last_.goal, velocity, coupling);
    }

    const Proxy& proxy = last_.proxy;
    if (!proxy.contact || !goes_on || !(input.dt_s > 0.0)) {
        video_motion_.forget();
        passivity_.pass(input.dt_s);
        return coupling_force(proxy, last_.goal, velocity, coupling);
    }
    const double felt_rise_px = video_motion_.followed(rise_px, input.dt_s);
    const Vec3 felt_from = last_.goal + Vec3(0.0, 0.0, video_motion_.lag_px());
    const Vec3 force = coupling_force(proxy, felt_from, velocity, coupling);
    if (safety_.rising(limits)) {
        passivity_.pass(input.dt_s);
        return force;
    }
    const PassivityControl::Tick tick{.dt_s = input.dt_s,
                                      .goal_step_mm = goal_step * mm,
                                      .lag_mm = (proxy.position - felt_from) * mm,
                                      .stiffness_newton_per_mm = coupling.stiffness_newton_per_mm,
                                      .max_force_newton = limits.max_force_newton,
                                      .video_rise_mm = felt_rise_px * mm};
    return force + passivity_.force_after(tick, device);
}

Vec3 GoalVelocity::difference(Vec3 step, double dt_s, double resolution) noexcept {
    if (!(dt_s > 0.0)) return Vec3(0.0);
    if (!(resolution > 0.0)) return step / dt_s;
    return continues_ ? window_.after(step, dt_s, resolution) : Vec3(0.0);
}

Vec3 GoalVelocity::after(Vec3 step, double dt_s, double cutoff_hz, double resolution) noexcept {
    const Vec3 difference = this->difference(step, dt_s, resolution);
    Vec3 filtered(0.0);
    if (continues_) {
        const Vec3 change = difference - filtered_px_per_s_;
        filtered = filtered_px_per_s_ + share_of_newest(dt_s, time_constant_of(cutoff_hz)) * change;
    }
    continues_ = is_finite(filtered);
    filtered_px_per_s_ = continues_ ? filtered : Vec3(0.0);
    return cutoff_hz > 0.0 ? filtered_px_per_s_ : difference;
}

}  // namespace dibhr
