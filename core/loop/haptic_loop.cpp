// The haptic thread and its tick.
#include "core/loop/haptic_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/haptics/surface.hpp"

namespace dibhr {

namespace {

double microseconds(std::chrono::steady_clock::duration span) {
    return std::chrono::duration<double, std::micro>(span).count();
}

double seconds(std::chrono::steady_clock::duration span) {
    return std::chrono::duration<double>(span).count();
}

FramePair frames_of(const DepthBlend& pair) {
    const Frame& from = *pair.from;
    const Frame& to = *pair.to;
    const CleaningOptions& cleaning = from.cleaning;
    return {{from.media, cleaning.fill_holes, cleaning.remove_spikes, cleaning.smooth_steps},
            from.index,
            to.index,
            from.media_s,
            to.media_s,
            to.time_s - from.time_s};
}

void copy(const Vec3& from, double (&to)[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

}  // namespace

HapticTick::HapticTick(const HapticConnections& connections)
    : to_(connections), limits_(usable(connections.device.specification().limits)) {}

void HapticTick::run(const TickTiming& timing, std::uint64_t late_ticks) noexcept {
    if (state_.ticks == 0) start_ = second_begin_ = timing.begin;
    const FrameWindow& frames = to_.frames.front();
    const HapticSettings& settings = to_.settings.front();
    state_.playback_s = frames.clock.playback_s(timing.begin);
    const DepthBlend pair = frames.at(state_.playback_s);
    restart_ = begins_again(settings, frames) || restart_;
    begin_recording(settings);
    state_.touchable = pair.makes_surface();
    state_.late_ticks = late_ticks;
    if (state_.touchable) {
        touch_surface(pair, settings, timing);
    } else {
        touch_nothing(settings, timing);
    }
    to_.state.publish(state_);
}

void HapticTick::begin_recording(const HapticSettings& settings) noexcept {
    if (settings.recording && !recording_) {
        renderer_.restart();
        state_.touch = {};
        restart_ = true;
    }
    recording_ = settings.recording;
}

void HapticTick::touch_nothing(const HapticSettings& settings, const TickTiming& timing) noexcept {
    rest();
    if (settings.recording) record({.settings = settings.version, .surface = false}, timing, 0.0);
    count(timing, 0.0);
}

void HapticTick::rest() noexcept {
    to_.device.send(Vec3{0.0});
    renderer_.rest();
    state_.touch.spring_force_newton = Vec3{0.0};
    state_.touch.sent_force_newton = Vec3{0.0};
    restart_ = true;
}

void HapticTick::touch_surface(const DepthBlend& pair, const HapticSettings& settings,
                               const TickTiming& timing) noexcept {
    const DepthSurface surface = pair.surface(settings.parameters.shape, settings.bump.get());
    const HandReading hand =
        to_.device.read({timing.dt_s, surface, settings.parameters.coupling.pixel_pitch_mm});
    const SafetyInput input{.dt_s = timing.dt_s,
                            .force_enabled = settings.force_enabled,
                            .device_ready = hand.ready && !taken_off(hand, settings),
                            .device_force_newton = hand.own_force_newton,
                            .restart = restart_ || hand.taken_over};
    limits_ = usable(hand.limits.value_or(to_.device.specification().limits));
    TouchParameters held = settings.parameters;
    held.coupling = held_coupling(held.coupling, limits_);
    const bool lets_go = hand.lifted || hand.taken_over;
    if (lets_go && state_.touch.proxy.contact) renderer_.let_go();
    const auto begin = std::chrono::steady_clock::now();
    state_.touch = renderer_.update(surface, hand.goal_in_grid, held, input,
                                    held_limits(settings.limits, limits_));
    const double update_us = microseconds(std::chrono::steady_clock::now() - begin);
    to_.device.send(state_.touch.sent_force_newton);
    restart_ = false;
    state_.hand = hand;
    state_.blend = pair.blend;
    to_.forces.push({seconds(timing.begin - start_), glm::length(state_.touch.sent_force_newton)});
    if (settings.recording) {
        record({.settings = settings.version,
                .frames = frames_of(pair),
                .blend = pair.blend,
                .own_newton = {hand.own_force_newton.x, hand.own_force_newton.y,
                               hand.own_force_newton.z},
                .buttons = hand.buttons,
                .device_ready = input.device_ready,
                .stand_in = hand.stand_in,
                .restart = input.restart,
                .lets_go = lets_go,
                .goal_refused = !is_finite(hand.goal_in_grid)},
               timing, update_us);
    }
    count(timing, update_us);
}

/// The hand's button acts in this very tick, and until the window has switched the force off.
bool HapticTick::taken_off(const HandReading& hand, const HapticSettings& settings) noexcept {
    const bool pressed = hand.force_off && !force_off_pressed_;
    force_off_pressed_ = hand.force_off;
    taken_off_ = (taken_off_ || pressed) && settings.force_enabled;
    return taken_off_;
}

bool HapticTick::begins_again(const HapticSettings& settings, const FrameWindow& frames) noexcept {
    const bool again = settings.version != version_ || frames.discontinuity != discontinuity_;
    version_ = settings.version;
    discontinuity_ = frames.discontinuity;
    return again;
}

void HapticTick::record(const TickRecord& inputs, const TickTiming& timing,
                        double update_us) noexcept {
    const Touch& touch = state_.touch;
    TickRecord row = inputs;
    row.limits = limits_;
    row.tick = static_cast<std::int64_t>(state_.ticks);
    row.t_s = seconds(timing.begin - start_);
    row.zero_ns = std::chrono::nanoseconds(start_.time_since_epoch()).count();
    row.dt_s = timing.dt_s;
    row.lateness_us = microseconds(timing.lateness);
    row.update_us = update_us;
    copy(touch.goal, row.goal);
    copy(touch.proxy.position, row.proxy);
    copy(touch.spring_force_newton, row.spring_newton);
    copy(touch.sent_force_newton, row.sent_newton);
    row.moves = touch.proxy.moves;
    row.i = touch.proxy.active.i;
    row.j = touch.proxy.active.j;
    row.contact = inputs.surface && touch.proxy.contact;
    row.primitive = static_cast<std::uint8_t>(touch.proxy.active.kind);
    row.cut = static_cast<std::uint8_t>(touch.cut);
    to_.ticks.push(row);
}

void HapticTick::count(const TickTiming& timing, double update_us) noexcept {
    ++state_.ticks;
    ++second_ticks_;
    const double lateness_ms = std::chrono::duration<double, std::milli>(timing.lateness).count();
    sums_.worst_lateness_ms = std::max(sums_.worst_lateness_ms, lateness_ms);
    if (state_.touchable) {
        ++second_updates_;
        sums_.update_us += update_us;
        sums_.worst_update_us = std::max(sums_.worst_update_us, update_us);
        sums_.moves += state_.touch.proxy.moves;
        if (state_.touch.proxy.bound_met) ++state_.bounds_met;
    }
    const double age_s = seconds(timing.begin - second_begin_);
    if (age_s < 1.0) return;
    const double updates = static_cast<double>(std::max<std::uint64_t>(second_updates_, 1));
    state_.second = {static_cast<double>(second_ticks_) / age_s, sums_.worst_lateness_ms,
                     sums_.update_us / updates, sums_.worst_update_us, sums_.moves / updates};
    sums_ = {};
    second_ticks_ = second_updates_ = 0;
    second_begin_ = timing.begin;
}

HapticLoop::HapticLoop(const HapticConnections& connections) : tick_(connections) {
    thread_ = std::thread([this] { run(); });
}

void HapticLoop::stop() noexcept {
    stopping_.store(true, std::memory_order_relaxed);
    if (thread_.joinable()) thread_.join();
}

std::optional<RealtimeGrants> HapticLoop::grants() const {
    if (!granted_.load(std::memory_order_acquire)) return {};
    return grants_;
}

void HapticLoop::run() {
    grants_ = become_realtime("dibhr haptic");
    granted_.store(true, std::memory_order_release);
    while (!stopping_.load(std::memory_order_relaxed)) {
        const TickTiming timing = timer_.wait();
        tick_.run(timing, timer_.late_ticks());
    }
    tick_.rest();
}

}  // namespace dibhr
