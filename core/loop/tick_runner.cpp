// The computation of one tick, and its row in a session.
#include "core/loop/tick_runner.hpp"

#include <cstdint>

namespace dibhr {

namespace {

/// The two frames as a session names them.
FramePair frames_of(const DepthBlend& pair) noexcept {
    const Frame& from = *pair.from;
    const Frame& to = *pair.to;
    const CleaningSteps& steps = from.cleaning.steps;
    return {{.media = from.media,
             .fill_holes = steps.fill_holes,
             .remove_spikes = steps.remove_spikes,
             .smooth_steps = steps.smooth_steps,
             .sharpen_silhouettes = steps.sharpen_silhouettes,
             .colour_edges = steps.colour_edges,
             .steady = steps.steady,
             .smooth_noise = steps.smooth_noise,
             .densify = steps.densify,
             .smooth_outlines = steps.smooth_outlines,
             .in_betweens = from.in_betweens != nullptr && &from != &to,
             .motion = from.motion != nullptr && &from != &to,
             .finger_px = from.cleaning.finger.radius_px,
             .finger_relief_px = from.cleaning.finger.relief_px,
             .maps = from.maps ? from.maps->version : 0},
            from.index,
            to.index,
            from.media_s,
            to.media_s,
            to.time_s - from.time_s};
}

/// What lies between two frames means nothing where a frame blends with itself.
SurfaceMark mark_of(const DepthBlend& pair) noexcept {
    const Frame& from = *pair.from;
    SurfaceMark mark{.from = from.depth.get(), .to = pair.to->depth.get()};
    if (pair.from == pair.to) return mark;
    mark.motion = from.motion.get();
    mark.in_betweens = from.in_betweens.get();
    return mark;
}

}  // namespace

const Touch& TickRunner::run(const TickInput& input,
                             const ParameterGlide::Values& target) noexcept {
    const SafetyInput& safety = input.safety;
    const auto& [parameters, limits] =
        glide_.towards(target, safety.dt_s, safety.from_zero || input.at_once);
    const DepthSurface surface = input.pair.surface(parameters.shape, input.bump);
    const MotionField* const field = input.motion_unknown ? nullptr : input.pair.from->motion.get();
    const SurfaceMotion motion = track_.follow_to(input.pair, field, safety.dt_s);
    lacks_motion_ = parameters.carry && motion.field == nullptr;
    if (input.releases_contact && touch_.proxy.contact) renderer_.release_contact();
    const auto begin = std::chrono::steady_clock::now();
    touch_ = renderer_.update(surface, input.goal, parameters, safety, limits, motion);
    update_time_ = std::chrono::steady_clock::now() - begin;
    return touch_;
}

const Touch& TickRunner::pause() noexcept {
    renderer_.pause();
    track_.forget();
    touch_.spring_force_newton = touch_.sent_force_newton = touch_.carried = Vec3{0.0};
    update_time_ = {};
    return touch_;
}

void TickRunner::reset() noexcept {
    renderer_.reset();
    touch_ = {};
}

TickRecord TickRunner::record_of(const TickInput& input) const noexcept {
    return {.dt_s = input.safety.dt_s,
            .frames = frames_of(input.pair),
            .mark = mark_of(input.pair),
            .blend = input.pair.blend,
            .own_newton = input.safety.device_force_newton,
            .device_ready = input.safety.device_ready,
            .from_zero = input.safety.from_zero,
            .releases_contact = input.releases_contact,
            .goal_refused = !is_finite(input.goal),
            .gliding = glide_.under_way(),
            .standstill = input.safety.standstill};
}

void add_result(TickRecord& row, const Touch& touch) noexcept {
    const Proxy& proxy = touch.proxy;
    row.goal = touch.goal;
    row.proxy = proxy.position;
    row.spring_newton = touch.spring_force_newton;
    row.sent_newton = touch.sent_force_newton;
    row.moves = proxy.moves;
    row.i = proxy.active.i;
    row.j = proxy.active.j;
    row.contact = row.surface && proxy.contact;
    row.primitive = static_cast<std::uint8_t>(proxy.active.kind);
    row.cut = static_cast<std::uint8_t>(touch.cut);
    row.catching_up = row.surface && proxy.bound_met;
}

}  // namespace dibhr
