// One haptic tick, and the thread that runs them.
#include "core/loop/haptic_tick.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace dibhr {

namespace {

/// As long as a force rises, and longer than parameters glide.
constexpr double kRestsAfter_s = 0.5;

double microseconds(std::chrono::steady_clock::duration span) {
    return std::chrono::duration<double, std::micro>(span).count();
}

double seconds(std::chrono::steady_clock::duration span) {
    return std::chrono::duration<double>(span).count();
}

}  // namespace

HapticTick::HapticTick(const HapticConnections& connections) : connections_(connections) {
    state_.hand = connections_.device.reading_without_surface();
}

void HapticTick::run(const TickTiming& timing, std::uint64_t late_ticks) noexcept {
    if (state_.ticks == 0) start_ = second_begin_ = timing.begin;
    const HapticSettings& settings = connections_.settings.front();
    // After the settings: a recording begins once the window has the first frame, so its first tick
    // has that frame, too.
    const FrameWindow& frames = connections_.frames.front();
    state_.late_ticks = late_ticks;
    notice_changes(settings, frames);
    const bool touched = state_.touchable && state_.touch.proxy.contact;
    standstill_ = watch_.poll(timing.begin, touched, state_.hand.harmless) || frames.silent;
    state_.standstill = watch_.last();
    const DepthBlend pair = frames.at(frames.clock.playback_s(timing.begin));
    state_.touchable = pair.makes_surface();
    const Touch before = state_.touch;
    TickRecord row{.dt_s = timing.dt_s, .surface = false};
    if (state_.touchable)
        row = touch_surface(pair, settings, timing);
    else
        send_zero_force();
    row.settings = settings.version;
    if (settings.recording) record(row, timing);
    // A goal of another hand or context is not a motion.
    const double moved_s = row.from_zero || row.releases_contact ? 0.0 : timing.dt_s;
    TickStrip strip =
        strip_of(before, state_.touch, moved_s, microseconds(timing.lateness), context_.pitch_mm);
    if (!row.surface) strip.penetration_mm = 0.0F;  // of the last surface
    carried_px_ += state_.touch.carried;
    // One value a period, also where ticks are farther apart.
    for (int period = 0; period < timing.periods; ++period) {
        connections_.strips.push(strip);
        strip.work_millijoule = 0.0F;
        push_sound(settings);
    }
    push_walked_tick(pair, settings, row);
    state_.rests = update_rest(frames, pair, settings, row);
    count(timing, row.update_us);
    connections_.state.publish(state_);
}

void HapticTick::notice_changes(const HapticSettings& settings,
                                const FrameWindow& frames) noexcept {
    const bool recording_begins = settings.recording && !recording_;
    reset_ = recording_begins;
    if (recording_begins) {
        runner_.reset();
        state_.touch = {};
    }
    const ForceContext context{.pitch_mm = settings.parameters.coupling.pixel_pitch_mm,
                               .bump = settings.bump.get(),
                               .bump_size_px = settings.parameters.shape.bump_size_px,
                               .maps = frames.count > 0 ? frames.frames[0].maps.get() : nullptr,
                               .discontinuity = frames.discontinuity};
    if (recording_begins || context != context_) from_zero_ = true;
    context_ = context;
    recording_ = settings.recording;
}

void HapticTick::send_zero_force() noexcept {
    connections_.device.send(Vec3{0.0});
    state_.touch = runner_.pause();
    from_zero_ = true;
}

TickRecord HapticTick::touch_surface(const DepthBlend& pair, const HapticSettings& settings,
                                     const TickTiming& timing) noexcept {
    // The hand's limits come with its reading, and the parameters glide only after that: the hand
    // is read over the last shape.
    const SurfaceShape& last_shape =
        from_zero_ ? settings.parameters.shape : runner_.effective_values().parameters.shape;
    const Proxy& proxy = state_.touch.proxy;
    const HandReading hand = connections_.device.read(
        {timing.dt_s, pair.surface(last_shape, settings.bump.get()), context_.pitch_mm,
         proxy.contact ? std::optional(proxy.position) : std::nullopt});
    const DeviceLimits limits_now =
        usable(hand.limits.value_or(connections_.device.specification().limits));
    const bool other_limits = limits_ != limits_now;  // which hold at once, without gliding
    limits_ = limits_now;
    ParameterGlide::Values wanted{settings.parameters, held_limits(settings.limits, *limits_)};
    wanted.parameters.coupling = held_coupling(settings.parameters.coupling, *limits_);
    const TickInput input{
        .pair = pair,
        .bump = settings.bump.get(),
        .goal = hand.goal_in_grid,
        .safety = {.dt_s = timing.dt_s,
                   .force_enabled = settings.force_enabled,
                   .device_ready = hand.ready && !update_force_off(hand, settings),
                   .device_force_newton = hand.own_force_newton,
                   .from_zero = from_zero_ || hand.hand_changed || other_limits,
                   .standstill = standstill_},
        .releases_contact = hand.lifted || hand.hand_changed};
    state_.touch = runner_.run(input, wanted);
    connections_.device.send(state_.touch.sent_force_newton);
    state_.shape = runner_.effective_values().parameters.shape;
    state_.hand = hand;
    from_zero_ = false;
    TickRecord row = runner_.record_of(input);
    row.update_us = microseconds(runner_.update_time());
    row.buttons = hand.buttons;
    row.mouse_fallback = hand.mouse_fallback;
    row.motion_unknown = runner_.lacks_motion();
    return row;
}

bool HapticTick::update_force_off(const HandReading& hand,
                                  const HapticSettings& settings) noexcept {
    const bool pressed = hand.force_off && !force_off_pressed_;
    force_off_pressed_ = hand.force_off;
    force_off_by_button_ = (force_off_by_button_ || pressed) && settings.force_enabled;
    return force_off_by_button_ || (connections_.without_force != nullptr &&
                                    connections_.without_force->load(std::memory_order_relaxed));
}

void HapticTick::record(TickRecord& row, const TickTiming& timing) noexcept {
    row.tick = static_cast<std::int64_t>(state_.ticks);
    row.t_s = seconds(timing.begin - start_);
    row.zero_ns = std::chrono::nanoseconds(start_.time_since_epoch()).count();
    row.lateness_us = microseconds(timing.lateness);
    row.limits = limits_;
    add_result(row, state_.touch);
    connections_.ticks.push(row);
}

void HapticTick::push_sound(const HapticSettings& settings) noexcept {
    if (connections_.sound == nullptr) return;
    const Touch& touch = state_.touch;
    const bool may_act = settings.limits.max_force_newton > 0.0 && touch.cut == SafetyCut::none;
    connections_.sound->push({.proxy_mm = context_.pitch_mm * (touch.proxy.position - carried_px_),
                              .force_newton = glm::length(touch.sent_force_newton),
                              .contact = touch.proxy.contact,
                              .force_on = state_.touchable && may_act});
}

bool HapticTick::update_rest(const FrameWindow& frames, const DepthBlend& pair,
                             const HapticSettings& settings, const TickRecord& row) noexcept {
    const bool stands = !(frames.clock.speed > 0.0) || pair.from == pair.to;
    const bool calm = row.surface && stands && connections_.device.rests() &&
                      !state_.touch.proxy.contact && !row.from_zero && !settings.recording &&
                      settings.version == last_version_;
    last_version_ = settings.version;
    calm_s_ = calm ? calm_s_ + row.dt_s : 0.0;
    return calm_s_ >= kRestsAfter_s;
}

void HapticTick::push_walked_tick(const DepthBlend& pair, const HapticSettings& settings,
                                  const TickRecord& row) noexcept {
    if (connections_.walked == nullptr || !settings.compare_algorithms) return;
    WalkedTick walked{.tick = state_.ticks,
                      .updates = row.surface && !row.goal_refused,
                      .begins = reset_,
                      .releases_contact = row.releases_contact,
                      .parameters = runner_.effective_values().parameters,
                      .proxy = state_.touch.proxy,
                      .goal = state_.touch.goal,
                      .blend = pair.blend,
                      .motion = runner_.renderer().motion(),
                      .material = runner_.renderer().material(),
                      .bump = settings.bump.get()};
    if (row.surface) {
        walked.from = mark_of(*pair.from);
        walked.to = mark_of(*pair.to);
    }
    connections_.walked->push(walked);
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
        if (state_.catching_up()) ++state_.bounds_met;
    }
    const double age_s = seconds(timing.begin - second_begin_);
    if (age_s < 1.0) return;
    const double updates = static_cast<double>(std::max<std::uint64_t>(second_updates_, 1));
    state_.second = {static_cast<double>(second_ticks_) / age_s,
                     sums_.worst_lateness_ms,
                     sums_.update_us / updates,
                     sums_.worst_update_us,
                     sums_.moves / updates,
                     state_.ticks,
                     state_.late_ticks};
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
        const TickTiming timing = timer_.wait(tick_.rests() ? kRestingPeriods : 1);
        tick_.run(timing, timer_.schedule().late_ticks());
    }
    tick_.send_zero_force();
}

}  // namespace dibhr
