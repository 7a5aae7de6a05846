// Goal -> proxy -> spring force -> safe force, and the low-pass of the goal's velocity.
#include "core/haptics/touch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/god_object.hpp"
#include "core/haptics/neighborhood.hpp"
#include "core/haptics/pga.hpp"

namespace dibhr {

namespace {

/// A rise of the surface under the proxy of the last update [px], or 0.
double rise_of(const Proxy& proxy, double rise_px) noexcept {
    constexpr double kRoundOff_px = 1e-6;  // of a proxy on a still surface
    if (proxy.bound_met) return 0.0;       // the proxy is still catching up
    return std::abs(rise_px) > kRoundOff_px && (proxy.contact || rise_px > 0.0) ? rise_px : 0.0;
}

/// How far the surface has moved under the proxy, or through it from below [px].
double rise_under(const DepthSurface& surface, const Proxy& proxy) noexcept {
    const Vec3& p = proxy.position;
    return rise_of(proxy, surface.elevation_at(p.x, p.y) - p.z);
}

}  // namespace

Vec3 coupling_force(const Proxy& proxy, Vec3 goal, Vec3 goal_velocity,
                    const Coupling& coupling) noexcept {
    if (!proxy.contact) return Vec3(0.0);
    const double mm = coupling.pixel_pitch_mm;
    return coupling.stiffness_newton_per_mm * mm * (proxy.position - goal) -
           coupling.damping_newton_s_per_m * 1e-3 * mm * goal_velocity;
}

Friction local_friction(const DepthSurface& surface, const Proxy& proxy, Vec3 goal,
                        Friction everywhere) noexcept {
    const Vec3& place = proxy.contact ? proxy.position : goal;
    return surface.friction_at(place.x, place.y, everywhere);
}

Coupling local_coupling(const DepthSurface& surface, const Proxy& proxy, Coupling everywhere,
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
    video_motion_ = carried_motion_ = {};
    passivity_ = {};
    safety_ = {};
    last_ = {};
    rendered_share_ = 1.0;
    contact_s_ = 0.0;
    continues_last_ = started_ = false;
}

void TouchRenderer::release_contact() noexcept {
    algorithms_[static_cast<std::size_t>(running_)]->reset();
    continues_last_ = false;
}

void TouchRenderer::pause() noexcept {
    goal_velocity_.forget();
    passivity_.record_sent_force(Vec3(0.0));
    safety_.drop_to_zero();
    continues_last_ = false;
}

bool TouchRenderer::select_algorithm(Algorithm algorithm) noexcept {
    if (algorithm == running_) return false;
    const ProxyAlgorithm& previous = *algorithms_[static_cast<std::size_t>(running_)];
    running_ = algorithm;
    algorithms_[static_cast<std::size_t>(running_)]->resume(previous);
    return true;
}

const Touch& TouchRenderer::update(const DepthSurface& surface, Vec3 hand,
                                   const TouchParameters& parameters, SafetyInput input,
                                   const SafetyLimits& limits,
                                   const SurfaceMotion& given) noexcept {
    if (!is_finite(hand)) {
        continues_last_ = false;
        goal_velocity_.forget();  // the next step takes longer than its tick
        last_.proxy.bound_met = false;
        last_.spring_force_newton = Vec3(0.0);
        last_.carried = Vec3(0.0);
        last_.sent_force_newton = safety_.limit(Vec3(NAN), input, limits);
        passivity_.record_sent_force(Vec3(0.0));
        last_.cut = safety_.last_cut();
        return last_;
    }
    motion_ = motion_of_update(given, parameters, input);
    const Vec3 goal = surface.clamped_to_reach(hand);
    const Vec3 goal_step = started_ ? goal - last_.goal : Vec3(0.0);
    input.goal_step_mm = glm::length(goal_step) * parameters.coupling.pixel_pitch_mm;
    const bool changed = select_algorithm(parameters.algorithm);
    input.from_zero = input.from_zero || changed || !started_;
    started_ = true;

    const Proxy before = last_.proxy;
    ProxyAlgorithm& algorithm = *algorithms_[static_cast<std::size_t>(running_)];
    last_.goal = goal;
    last_.proxy = algorithm.update(
        surface, goal, local_friction(surface, before, goal, parameters.friction), motion_);
    Steps steps{.goal = goal_step, .carries = before.contact && motion_.continues()};
    if (steps.carries)
        steps.rise = rise_of(before, algorithm.carried_px().z);
    else if (limits.watched.moves())
        steps.rise = rise_under(surface, before);
    const Vec2 along = steps.carries ? Vec2(algorithm.carried_px()) : Vec2(0.0);
    last_.carried = steps.carries ? Vec3(along, steps.rise) : Vec3(0.0);
    if (along != Vec2(0.0))
        steps.slid = last_.proxy.position - before.position - algorithm.carried_px();
    if (limits.watched.moves() &&
        is_video_cut(before, steps.rise * parameters.coupling.pixel_pitch_mm, input.dt_s))
        input.from_zero = true;
    fade_unseen(surface, parameters.coupling.unseen_share, input.dt_s);
    if (rendered_share_ == 0.0) last_.proxy.contact = false;
    const Coupling coupling = local_coupling(surface, last_.proxy, parameters.coupling, limits);
    last_.spring_force_newton = rendered_share_ * rendered_force(steps, coupling, input, limits);
    last_.sent_force_newton =
        safety_.limit(last_.spring_force_newton + input.device_force_newton, input, limits);
    passivity_.record_sent_force(last_.sent_force_newton - input.device_force_newton);
    last_.cut = safety_.last_cut();
    last_.energy = passivity_.flow();
    return last_;
}

SurfaceMotion TouchRenderer::motion_of_update(SurfaceMotion motion,
                                              const TouchParameters& parameters,
                                              const SafetyInput& input) noexcept {
    const bool continues = std::exchange(continues_last_, true) && !input.from_zero;
    if (!parameters.carry) return {};
    motion.dt_s = input.dt_s;
    return continues ? motion : motion.restarted();
}

bool TouchRenderer::is_video_cut(const Proxy& before, double rise_mm, double dt_s) noexcept {
    constexpr double kFastest_mm_per_ms = 0.2;
    constexpr double kNewContact_s = 0.1;  // longer than the frames between which a cut is blended
    contact_s_ = before.contact ? contact_s_ + dt_s : 0.0;
    return contact_s_ < kNewContact_s && rise_mm > kFastest_mm_per_ms * 1e3 * dt_s;
}

void TouchRenderer::fade_unseen(const DepthSurface& surface, double unseen_share,
                                double dt_s) noexcept {
    const Vec3& goal = last_.goal;
    const double wanted = surface.seen_at(goal.x, goal.y) ? 1.0 : unseen_share;
    const double step = dt_s > 0.0 ? dt_s / SafetyStage::kFade_s : 0.0;
    rendered_share_ += std::clamp(wanted - rendered_share_, -step, step);
}

Vec3 TouchRenderer::rendered_force(const Steps& steps, const Coupling& coupling,
                                   const SafetyInput& input, const SafetyLimits& limits) noexcept {
    const DeviceDynamics& device = limits.watched;
    const double mm = coupling.pixel_pitch_mm;
    const bool continues = !input.from_zero && !goal_jumped(input, limits);
    if (!continues) {
        goal_velocity_.forget();
        surface_velocity_.forget();
    }
    const double resolution_px = device.moves() ? device.resolution_mm / mm : 0.0;
    const Vec3 velocity =
        goal_velocity_.after(steps.goal, input.dt_s, coupling.damping_cutoff_hz, resolution_px);
    // The hand's velocity relative to the carrying surface; the same bits where nothing carries.
    const auto seen_from = [&](Vec3 carried) {
        return velocity - surface_velocity_.after(carried, input.dt_s, coupling.damping_cutoff_hz);
    };
    if (!device.moves()) {
        video_motion_ = carried_motion_ = {};
        passivity_ = {};
        return coupling_force(last_.proxy, last_.goal, seen_from(last_.carried), coupling);
    }

    const Proxy& proxy = last_.proxy;
    const double depth_px = std::max(0.0, proxy.position.z - last_.goal.z);
    if (!proxy.contact || !continues || !(input.dt_s > 0.0)) {
        // Where the surface is suddenly above the hand, the rendered surface begins at the hand.
        video_motion_.begin(proxy.contact ? depth_px : 0.0);
        carried_motion_ = {};
        passivity_.skip_tick(input.dt_s);
        return coupling_force(proxy, last_.goal, seen_from(last_.carried), coupling);
    }
    const double most_px = passivity_.most_rise_mm(coupling.stiffness_newton_per_mm) / mm;
    const auto felt_step = [&](VideoMotion& motion, double rise_px) {
        const double rise = motion.filtered_rise(rise_px, input.dt_s, most_px);
        if (motion.lag_px() > depth_px) motion.begin(depth_px);  // never pulls the hand down
        return Vec3(last_.carried.x, last_.carried.y, rise);
    };
    const Vec3 video_step = felt_step(video_motion_, steps.rise);
    const Vec3 felt_from = last_.goal + Vec3(0.0, 0.0, video_motion_.lag_px());
    // The rise with which a contact begins acts on the spring alone: nothing carries there.
    const Vec3 felt_velocity = seen_from(felt_step(carried_motion_, last_.carried.z));
    const Vec3 force = coupling_force(proxy, felt_from, felt_velocity, coupling);
    const PassivityControl::Tick tick{.dt_s = input.dt_s,
                                      .goal_step_mm = steps.goal * mm,
                                      .lag_mm = (proxy.position - felt_from) * mm,
                                      .stiffness_newton_per_mm = coupling.stiffness_newton_per_mm,
                                      .max_force_newton = limits.max_force_newton,
                                      .video_step_mm = video_step * mm,
                                      .slid_mm = steps.slid * mm};
    if (!safety_.rising(limits)) return force + passivity_.force_after(tick, device);
    passivity_.skip_tick(tick);
    return force;
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
