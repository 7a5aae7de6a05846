// The exchange over one connection to the service.
#include "device/inverse3/exchange_loop.hpp"

#include <algorithm>
#include <utility>

#include "core/files/plain_text.hpp"
#include "device/inverse3/dynamics.hpp"

namespace dibhr::inverse3 {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Why = LinkError::Why;

// README.md, Safety numbers.
constexpr int kZerosAfterForce = 5;
constexpr milliseconds kBeatPeriod{10};  // between beats; the guardian's timeout is 50 ms
constexpr seconds kLongestSilence{2};
constexpr milliseconds kMessageTimeout{500};  // from its first byte to its last
constexpr milliseconds kCloseTimeout{100};
constexpr milliseconds kInventoryTimeout{500};
constexpr milliseconds kLoopIdleAfter{200};  // without a force from the haptic loop
constexpr milliseconds kReadBackEvery{1000};
constexpr int kMostPresetRequests = 3;
constexpr const char* kUsualPreset = "defaults";  // a service may report it by another name

// Pauses between two messages: short enough for young poses, and they leave the processor free.
constexpr microseconds kPause{500};
constexpr microseconds kPauseWithoutLoop{10'000};
constexpr microseconds kPauseWithoutArm{100'000};

bool matches(const Arm& arm, const std::string& requested_name) noexcept {
    if (requested_name.empty()) return true;
    const Handedness hand = arm.config ? arm.config->handedness : Handedness::unknown;
    if (requested_name == "left") return hand == Handedness::left;
    if (requested_name == "right") return hand == Handedness::right;
    return arm.id.view() == requested_name;
}

bool is_in(const std::array<DeviceId, ServiceMessage::kMost>& ids, const DeviceId& id) noexcept {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

ExchangeLoop::ExchangeLoop(ServiceLink& link, const ConnectionOptions& options, bool newer,
                           ArmBuffers& buffers, Board& board, DriverState& driver_state,
                           Guardian& guardian)
    : link_(link),
      options_(options),
      newer_(newer),
      buffers_(buffers),
      board_(board),
      driver_state_(driver_state),
      guardian_(guardian),
      last_loop_update_(Clock::now()) {
    driver_state_.exchanges.begin(last_loop_update_);
    forget_arm();
}

ExchangeLoop::~ExchangeLoop() {
    if (guarded_dialect_ && !close_answered_) guardian_.detach();
    unguard();
    buffers_.poses.publish(TimedPose{});  // so that no tick uses an old pose
    driver_state_.buttons.release();
}

void ExchangeLoop::run(const std::stop_token& stop) {
    const std::stop_callback wake_to_leave(stop, [this] { buffers_.wake.signal(); });
    take_inventory(stop);
    while (!stop.stop_requested()) {
        exchange_once(stop);
        if (stop.stop_requested()) break;
        report(Clock::now());
        pause();
    }
    close_link();
}

/// By the documentation, the service sends the inventory unasked. Where it does not, the first
/// message requests it.
void ExchangeLoop::take_inventory(const std::stop_token& stop) {
    if (wait_for_message(Clock::now() + kInventoryTimeout, &stop)) take();
}

void ExchangeLoop::exchange_once(const std::stop_token& stop) {
    send_request(next_request());
    if (!wait_for_message(sent_at_ + kLongestSilence, &stop)) {
        if (stop.stop_requested()) return;
        throw LinkError(Why::lost, "it has been silent for 2 s");
    }
    if (!sent_whole_)
        driver_state_.exchanges.delay.add(sent_at_, Clock::now());  // a whole state takes longer
    take();
    in_flight_ = false;
    if (sent_drives_) force_answered_ = true;
    ++driver_state_.exchanges.count;
}

bool ExchangeLoop::closed_on_force() const noexcept {
    return in_flight_ && sent_drives_ && !force_answered_ && !driver_state_.dialect_confirmed;
}

/// Waits until the haptic loop has a new force, or the next pose is due. Reads unrequested messages
/// meanwhile: an unread one would make every later answer one exchange older.
void ExchangeLoop::pause() {
    const bool paused = Clock::now() - last_loop_update_ > kLoopIdleAfter;
    const Time until = sent_at_ + (arm_.empty() ? kPauseWithoutArm
                                   : paused     ? kPauseWithoutLoop
                                                : kPause);
    while (!buffers_.forces.fresh()) {
        if (wait(until)) {
            take();
            ++driver_state_.unrequested;
        }
        if (Clock::now() >= until) return;
    }
}

/// True: a message comes. Also ends at the wake, and when the next beat for the guardian is due.
bool ExchangeLoop::wait(Time until) {
    const bool comes = link_.wait(&buffers_.wake, std::min(until, Clock::now() + kBeatPeriod));
    check_guardian();
    return comes;
}

/// Beats, and ends the link when the guardian died or has sent its packets: after those, answers no
/// longer belong to our messages.
void ExchangeLoop::check_guardian() {
    guardian_.beat();
    if (guarded_dialect_ && guardian_.died())
        throw LinkError(Why::unguarded, "its guardian has ended");
    if (!guardian_.has_sent()) return;
    throw LinkError(Why::program_stalled, "dibhr itself stood still");
}

bool ExchangeLoop::wait_for_message(Time until, const std::stop_token* stop) {
    while (!wait(until)) {
        if (Clock::now() >= until || (stop != nullptr && stop->stop_requested())) return false;
    }
    return true;
}

void ExchangeLoop::close_link() noexcept {
    try {
        const Time until = Clock::now() + kCloseTimeout;
        // Reads the pending answer first: there is never more than one message in flight.
        if (in_flight_ && wait_for_message(until, nullptr)) (void)link_.read(until);
        close_answered_ = link_.close(until);
    } catch (const LinkError&) {
        close_answered_ = false;  // the connection was lost before
    }
}

void ExchangeLoop::send_request(const ServiceRequest& request) {
    sent_drives_ = request.force_newton.has_value();
    sent_whole_ = request.whole_state;
    sent_newton_ = request.force_newton.value_or(Vec3{0.0});
    const Time now = Clock::now();
    if (sent_drives_) {
        driver_state_.watch.force_sent(now, sent_newton_ != Vec3{0.0});
        guard(request);
    }
    zeros_pending_ = sent_newton_ != Vec3{0.0} ? kZerosAfterForce : std::max(zeros_pending_ - 1, 0);
    in_flight_ = true;
    link_.send(driver_state_.writer.write(request), now + kMessageTimeout);
    sent_at_ = now;
}

/// Called with every force; starts the guardian at the first one, and again for another dialect.
void ExchangeLoop::guard(const ServiceRequest& request) {
    check_guardian();
    if (guarded_dialect_ == request.dialect) return;
    const StopPacket last = link_.set_stop_packet(driver_state_.writer.write(
        {.arm = request.arm, .force_newton = Vec3{0.0}, .dialect = request.dialect}));
    if (Guardian::alarmed()) return;
    guardian_.watch(link_.descriptor(), last);
    guarded_dialect_ = request.dialect;
    board_.draft().unguarded = guardian_.fault();
}

void ExchangeLoop::unguard() noexcept {
    if (guarded_dialect_) guardian_.dismiss();
    guarded_dialect_.reset();
}

ServiceRequest ExchangeLoop::next_request() {
    const Time now = Clock::now();
    const Vec3 force = current_force(now);
    ServiceRequest request{.arm = arm_, .dialect = dialect()};
    const bool first = !session_named_ && !arm_.empty();
    if (first && newer_) {
        request.sets_session_name = true;
        request.preset = options_.preset;
    }
    session_named_ = session_named_ || first;
    request.whole_state = arm_.empty() || first || now >= whole_state_due_;
    if (request.whole_state) whole_state_due_ = now + kReadBackEvery;
    if ((epoch() != kNoEpoch && !arm_.empty()) || zeros_pending_ > 0) request.force_newton = force;
    return request;
}

Vec3 ExchangeLoop::current_force(Time now) {
    if (buffers_.forces.fresh()) last_loop_update_ = now;
    return buffers_.force_for(epoch(), now);
}

ForceDialect ExchangeLoop::dialect() const noexcept {
    if (options_.dialect) return *options_.dialect;
    return driver_state_.dialect.value_or(newer_ ? ForceDialect::vector : ForceDialect::values);
}

void ExchangeLoop::take() {
    std::string_view text;
    try {
        text = link_.read(Clock::now() + kMessageTimeout);
    } catch (const LinkError& error) {
        if (error.why() == Why::too_long) ++driver_state_.not_understood;
        throw;
    }
    const Time now = Clock::now();
    if (driver_state_.reader.read(text, message_)) {
        take_message(message_, now);
    } else {
        take_invalid(Stage::not_understood, {});
    }
}

void ExchangeLoop::take_message(const ServiceMessage& message, Time at) {
    if (!message.error_text.empty()) {
        if (sent_drives_ && !driver_state_.dialect_confirmed) {
            try_other_dialect();
            driver_state_.watch.add_gap();
            buffers_.poses.publish(TimedPose{});
            return;
        }
        take_invalid(Stage::not_understood,
                     "the Haply Inverse Service complains: " + one_line(message.error_text.view()));
        return;
    }
    // Without a known version, the content of the message shows it.
    newer_ = newer_ || message.has_session;
    take_grip(message, at);
    if (arm_.empty()) choose(message);
    const Arm* const arm = arm_.empty() ? nullptr : message.arm(arm_);
    if (arm != nullptr) {
        take_arm(*arm, at);
    } else {
        handle_no_arm(message);
    }
}

void ExchangeLoop::take_invalid(Stage why, const std::string& sentence) {
    ++driver_state_.not_understood;
    driver_state_.watch.add_gap();
    buffers_.poses.publish(TimedPose{});
    publish_status(why, sentence.empty() ? sentence_for(why, board_.draft()) : sentence, true);
}

/// Chooses the first by ID, so that the order of the list does not matter.
void ExchangeLoop::choose(const ServiceMessage& message) {
    for (DeviceId& id : ignored_arms_)
        if (message.arm(id) == nullptr) id = {};  // unplugged: may be chosen when it comes again
    const Arm* chosen = nullptr;
    for (std::size_t k = 0; k < message.arm_count; ++k) {
        const Arm& arm = message.arms[k];
        if (!matches(arm, options_.device) || is_in(ignored_arms_, arm.id)) continue;
        if (chosen == nullptr || arm.id.view() < chosen->id.view()) chosen = &arm;
    }
    if (chosen == nullptr) return;
    arm_ = chosen->id;
    ignored_arms_ = {};
    session_named_ = false;
    preset_requests_ = 0;
    board_.draft().other_preset = false;
    echo_watch_.begin();
    driver_state_.watch.begin();
    board_.draft().id = one_line(arm_.view());
}

/// Another user may hold the other arms: they are ignored until plugged in again.
void ExchangeLoop::ignore_others(const ServiceMessage& message) {
    for (std::size_t k = 0; k < message.arm_count; ++k) ignored_arms_[k] = message.arms[k].id;
}

void ExchangeLoop::forget_arm() {
    arm_ = {};
    unguard();
    zeros_pending_ = 0;
    stage_published_ = false;
    arm_lost_ = false;
    driver_state_.watch.add_gap();
    driver_state_.watch.begin();
    buffers_.poses.publish(TimedPose{});
    Status& status = board_.draft();
    status.id.clear();
    status.minverse = false;
}

/// No arm is attached, or the chosen one is lost, or no attached one is the requested one.
void ExchangeLoop::handle_no_arm(const ServiceMessage& message) {
    if (arm_lost_ && zeros_pending_ > 0)
        return;  // first the pending zeros: the arm may still get them
    if (arm_lost_) return forget_arm();
    if (!arm_.empty()) return lose_arm(message);
    const bool any = message.arm_count > 0;
    const bool already_published =
        any ? is_in(ignored_arms_, message.arms[0].id) : board_.draft().stage == Stage::no_device;
    if (already_published) return;
    publish_status(Stage::no_device,
                   any ? "the Haply Inverse Service has no Inverse3 that is " + options_.device +
                             ", but has " + one_line(message.arms[0].id.view())
                       : sentence_for(Stage::no_device, board_.draft()),
                   any);
}

void ExchangeLoop::lose_arm(const ServiceMessage& message) {
    std::string sentence = "the " + name_of(board_.draft()) + " was unplugged: plug it in again";
    if (options_.device.empty()) {
        ignore_others(message);
        if (message.arm_count > 0)
            sentence += "; to use " + one_line(message.arms[0].id.view()) +
                        " instead, unplug it and plug it in again";
    }
    driver_state_.watch.add_gap();
    buffers_.poses.publish(TimedPose{});
    arm_lost_ = true;
    publish_status(Stage::no_device, sentence, true);
}

void ExchangeLoop::take_arm(const Arm& arm, Time at) {
    arm_lost_ = false;
    driver_state_.watch.add(arm, at);
    if (driver_state_.watch.jumped()) whole_state_due_ = at;
    if (arm.config) check_preset(*arm.config);
    learn_dialect(arm, at);
    publish_pose(arm, at);
    publish_stage(stage());
}

/// The Haply Hub may have replaced our preset by its own, or the service may not take ours.
void ExchangeLoop::check_preset(const ArmConfig& config) {
    Status& status = board_.draft();
    status.minverse = config.minverse;
    status.handedness = config.handedness;
    status.preset = one_line(config.preset.view());
    const bool is_ours =
        !newer_ || !session_named_ || config.preset.empty() || config.preset == options_.preset;
    if (is_ours) {
        preset_requests_ = 0;
        status.other_preset = false;
    } else if (preset_requests_ < kMostPresetRequests) {
        ++preset_requests_;
        session_named_ = false;
    } else {
        status.other_preset = true;
    }
}

/// Why the arm cannot touch; `ready`: it can.
Stage ExchangeLoop::stage() const noexcept {
    if (force_refused()) return Stage::force_refused;
    const Stage of_arm = driver_state_.watch.stage();
    if (of_arm != Stage::ready) return of_arm;
    if (board_.draft().other_preset && options_.preset != ShortWord(kUsualPreset))
        return Stage::other_preset;
    return driver_state_.exchanges.delay.within_ms() > kLongestExchange_ms ? Stage::slow
                                                                           : Stage::ready;
}

Epoch ExchangeLoop::epoch() const noexcept {
    return stage() == Stage::ready && !arm_lost_ ? driver_state_.watch.epoch() : kNoEpoch;
}

/// Publishes a new stage; for the same stage no sentence is made.
void ExchangeLoop::publish_stage(Stage stage) {
    if (stage_published_ && board_.draft().stage == stage) return;
    const bool trouble = stage == Stage::force_refused || stage == Stage::other_frame ||
                         stage == Stage::other_preset || stage == Stage::slow;
    publish_status(stage, sentence_for(stage, board_.draft()), trouble);
}

void ExchangeLoop::take_grip(const ServiceMessage& message, Time at) {
    std::uint8_t down = 0;
    std::optional<GripStatus>& shown = board_.draft().grip;
    if (message.grip_count == 0) shown.reset();
    for (std::size_t k = 0; k < message.grip_count; ++k) {
        const Grip& grip = message.grips[k];
        down = static_cast<std::uint8_t>(down | grip.buttons);
        if (k > 0) continue;
        if (!shown) shown.emplace();
        if (shown->id != grip.id.view()) shown->id = one_line(grip.id.view());
        shown->wired = grip.wired;
        shown->awake = grip.awake && grip.connected;
        shown->battery = grip.battery;
    }
    buttons_ = driver_state_.buttons.add(down, at);
}

void ExchangeLoop::learn_dialect(const Arm& arm, Time at) {
    if (!sent_drives_) return;
    echo_watch_.add(sent_newton_, arm.force_newton, at);
    if (echo_watch_.obeys() == ForceEchoWatch::Obeys::yes) driver_state_.dialect_confirmed = true;
    if (echo_watch_.obeys() == ForceEchoWatch::Obeys::no) try_other_dialect();
}

/// The force then rises from zero, because the effect of the other dialect is not known.
void ExchangeLoop::try_other_dialect() {
    driver_state_.dialect_confirmed = false;
    echo_watch_.begin();
    driver_state_.watch.add_gap();
    driver_state_.dialects_refused = options_.dialect ? 2 : driver_state_.dialects_refused + 1;
    if (driver_state_.dialects_refused < 2) driver_state_.dialect = other(dialect());
}

void ExchangeLoop::publish_pose(const Arm& arm, Time at) {
    TimedPose& pose = buffers_.poses.back();
    pose.epoch = epoch();
    pose.exchange_ms = driver_state_.exchanges.delay.within_ms();
    pose.position_m = arm.position_m.value_or(Vec3{0.0});
    pose.buttons = buttons_;
    pose.at = at;
    pose.number = driver_state_.exchanges.count + 1;
    buffers_.poses.publish();
}

void ExchangeLoop::report(Time now) {
    Status& status = board_.draft();
    status.presses = driver_state_.buttons.presses();
    status.pressed_at = driver_state_.buttons.pressed_at();
    status.unrequested = driver_state_.unrequested;
    status.not_understood = driver_state_.not_understood;
    status.dialect = dialect();
    status.dialect_confirmed = driver_state_.dialect_confirmed;
    driver_state_.exchanges.report(status, now);
    board_.publish_if_due(now);
}

void ExchangeLoop::publish_status(Stage stage, const std::string& sentence, bool trouble) {
    stage_published_ = true;
    board_.enter_new(stage, sentence, trouble);
}

}  // namespace dibhr::inverse3
