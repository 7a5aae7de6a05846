// The haptic thread and its tick.
#include "app/haptic_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/haptics/surface.hpp"

namespace dibhr {

namespace {

double seconds(std::chrono::steady_clock::duration span) {
    return std::chrono::duration<double>(span).count();
}

void copy(const Vec3& from, double (&to)[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

}  // namespace

HapticTick::HapticTick(const HapticConnections& connections) : to_(connections) {}

void HapticTick::run(const TickTiming& timing, std::uint64_t late_ticks) noexcept {
    if (state_.ticks == 0) start_ = second_begin_ = timing.begin;
    const FrameWindow& frames = to_.frames.front();
    const HapticSettings& settings = to_.settings.front();
    state_.playback_s = frames.clock.playback_s(timing.begin);
    const DepthBlend pair = frames.at(state_.playback_s);
    restart_ = begins_again(settings, frames) || restart_;
    state_.touchable = pair.makes_surface();
    state_.late_ticks = late_ticks;
    if (state_.touchable) {
        touch_surface(pair, settings, timing);
    } else {
        rest();
        count(timing, 0.0);
    }
    to_.state.publish(state_);
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
    const DepthSurface surface(*pair.from->depth, *pair.to->depth, pair.blend,
                               settings.parameters.shape, settings.bump.get());
    const HandReading hand =
        to_.device.read({timing.dt_s, surface, settings.parameters.coupling.pixel_pitch_mm});
    const SafetyInput input{timing.dt_s, 0.0, settings.force_enabled, hand.ready, restart_};
    if (hand.lifted && state_.touch.proxy.contact) renderer_.let_go();
    const auto begin = std::chrono::steady_clock::now();
    state_.touch =
        renderer_.update(surface, hand.goal_in_grid, settings.parameters, input, settings.limits);
    const double update_us = seconds(std::chrono::steady_clock::now() - begin) * 1e6;
    to_.device.send(state_.touch.sent_force_newton);
    restart_ = false;
    state_.device_ready = hand.ready;
    state_.buttons = hand.buttons;
    state_.blend = pair.blend;
    record(pair, timing, update_us);
    count(timing, update_us);
}

bool HapticTick::begins_again(const HapticSettings& settings, const FrameWindow& frames) noexcept {
    const bool again = settings.version != version_ || frames.discontinuity != discontinuity_;
    version_ = settings.version;
    discontinuity_ = frames.discontinuity;
    return again;
}

void HapticTick::record(const DepthBlend& pair, const TickTiming& timing,
                        double update_us) noexcept {
    const Touch& touch = state_.touch;
    const double t_s = seconds(timing.begin - start_);
    to_.forces.push({t_s, glm::length(touch.sent_force_newton)});
    if (to_.recording == nullptr) return;
    TickRecord row;
    row.tick = static_cast<std::int64_t>(state_.ticks);
    row.t_s = t_s;
    row.playback_s = state_.playback_s;
    row.blend = pair.blend;
    row.frame = pair.from->index;
    copy(touch.goal, row.goal);
    copy(touch.proxy.position, row.proxy);
    copy(touch.spring_force_newton, row.spring_newton);
    copy(touch.sent_force_newton, row.sent_newton);
    row.dt_s = timing.dt_s;
    row.lateness_us = std::chrono::duration<double, std::micro>(timing.lateness).count();
    row.update_us = update_us;
    row.moves = touch.proxy.moves;
    row.i = touch.proxy.active.i;
    row.j = touch.proxy.active.j;
    row.contact = touch.proxy.contact ? 1 : 0;
    row.primitive = static_cast<std::uint8_t>(touch.proxy.active.kind);
    row.buttons = state_.buttons;
    row.cut = static_cast<std::uint8_t>(touch.cut);
    to_.recording->push(row);
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
