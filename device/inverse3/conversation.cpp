// The exchange over one connection to the service.
#include "device/inverse3/conversation.hpp"

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
constexpr milliseconds kOldestForce{20};
constexpr int kZerosAfterForce = 5;
constexpr milliseconds kNeverSilentFor{10};  // between beats; the guardian's timeout is 50 ms
constexpr seconds kLongestSilence{2};
constexpr milliseconds kMessageTakes{500};  // from its first byte to its last
constexpr milliseconds kGoodbyeTakes{100};
constexpr milliseconds kInventoryTakes{500};
constexpr milliseconds kRatePeriod{500};
constexpr milliseconds kLoopPauses{200};  // without a force from the haptic loop
constexpr milliseconds kReadBackEvery{1000};
constexpr int kPresetsAsked = 3;
constexpr const char* kUsualPreset = "defaults";  // a service may report it by another name

// Pauses between two messages: short enough for young poses, and they leave the processor free.
constexpr microseconds kPause{500};
constexpr microseconds kPauseWithoutLoop{10'000};
constexpr microseconds kPauseWithoutArm{100'000};

bool named(const Arm& arm, const std::string& wish) noexcept {
    if (wish.empty()) return true;
    const Handedness hand = arm.config ? arm.config->handedness : Handedness::unknown;
    if (wish == "left") return hand == Handedness::left;
    if (wish == "right") return hand == Handedness::right;
    return arm.id.view() == wish;
}

bool is_in(const std::array<DeviceId, ServiceMessage::kMost>& ids, const DeviceId& id) noexcept {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

Conversation::Conversation(ServiceLink& link, const ConnectionOptions& options, bool newer,
                           Exchange& exchange, Board& board, Memory& memory, Guardian& guardian)
    : link_(link),
      options_(options),
      newer_(newer),
      exchange_(exchange),
      board_(board),
      memory_(memory),
      guardian_(guardian),
      loop_heard_(Clock::now()),
      rate_from_(memory.exchanges),
      rate_since_(loop_heard_) {
    forget_arm();
}

Conversation::~Conversation() {
    if (guarded_in_ && !settled_) guardian_.part();
    unguard();
    exchange_.poses.publish(TimedPose{});  // so that no tick uses an old pose
    memory_.buttons.release();
}

void Conversation::run(const std::stop_token& stop) {
    const std::stop_callback wake_to_leave(stop, [this] { exchange_.wake.signal(); });
    take_inventory(stop);
    while (!stop.stop_requested()) {
        exchange_once(stop);
        if (stop.stop_requested()) break;
        report(Clock::now());
        pause();
    }
    say_goodbye();
}

/// By the documentation, the service sends the inventory unasked. Where it does not, the first
/// message requests it.
void Conversation::take_inventory(const std::stop_token& stop) {
    if (await(Clock::now() + kInventoryTakes, &stop)) take();
}

void Conversation::exchange_once(const std::stop_token& stop) {
    say(next_order());
    if (!await(sent_at_ + kLongestSilence, &stop)) {
        if (stop.stop_requested()) return;
        throw LinkError(Why::lost, "it has been silent for 2 s");
    }
    if (!sent_whole_) memory_.delay.add(sent_at_, Clock::now());  // a whole state takes longer
    take();
    in_flight_ = false;
    if (sent_drives_) force_answered_ = true;
    ++memory_.exchanges;
}

bool Conversation::closed_on_force() const noexcept {
    return in_flight_ && sent_drives_ && !force_answered_ && !memory_.dialect_confirmed;
}

/// Waits until the haptic loop has a new force, or the next pose is due. Reads unrequested messages
/// meanwhile: an unread one would make every later answer one exchange older.
void Conversation::pause() {
    const bool paused = Clock::now() - loop_heard_ > kLoopPauses;
    const Time until = sent_at_ + (arm_.empty() ? kPauseWithoutArm
                                   : paused     ? kPauseWithoutLoop
                                                : kPause);
    while (!exchange_.forces.fresh()) {
        if (wait(until)) {
            take();
            ++memory_.unasked;
        }
        if (Clock::now() >= until) return;
    }
}

/// True: a message comes. Also ends at the wake, and when the next beat for the guardian is due.
bool Conversation::wait(Time until) {
    const bool comes = link_.wait(&exchange_.wake, std::min(until, Clock::now() + kNeverSilentFor));
    tell_guardian();
    return comes;
}

/// Beats, and ends the link when the guardian died or has sent its packets: after those, answers no
/// longer belong to our messages.
void Conversation::tell_guardian() {
    guardian_.beat();
    if (guarded_in_ && guardian_.died()) throw LinkError(Why::unguarded, "its guardian has ended");
    if (!guardian_.spoken()) return;
    throw LinkError(Why::stood_still, "dibhr itself stood still");
}

bool Conversation::await(Time until, const std::stop_token* stop) {
    while (!wait(until)) {
        if (Clock::now() >= until || (stop != nullptr && stop->stop_requested())) return false;
    }
    return true;
}

void Conversation::say_goodbye() noexcept {
    try {
        const Time until = Clock::now() + kGoodbyeTakes;
        // Reads the pending answer first: there is never more than one message in flight.
        if (in_flight_ && await(until, nullptr)) (void)link_.read(until);
        settled_ = link_.close(until);
    } catch (const LinkError&) {
        settled_ = false;  // the connection was lost before
    }
}

void Conversation::say(const Order& order) {
    sent_drives_ = order.force_newton.has_value();
    sent_whole_ = order.whole_state;
    sent_newton_ = order.force_newton.value_or(Vec3{0.0});
    const Time now = Clock::now();
    if (sent_drives_) {
        memory_.watch.drove(now, sent_newton_ != Vec3{0.0});
        guard(order);
    }
    zeros_owed_ = sent_newton_ != Vec3{0.0} ? kZerosAfterForce : std::max(zeros_owed_ - 1, 0);
    in_flight_ = true;
    link_.send(memory_.writer.write(order), now + kMessageTakes);
    sent_at_ = now;
}

/// Called with every force; starts the guardian at the first one, and again for another dialect.
void Conversation::guard(const Order& order) {
    tell_guardian();
    if (guarded_in_ == order.dialect) return;
    const Farewell last = link_.set_last_words(memory_.writer.write(
        {.arm = order.arm, .force_newton = Vec3{0.0}, .dialect = order.dialect}));
    if (Guardian::alarmed()) return;
    guardian_.watch(link_.descriptor(), last);
    guarded_in_ = order.dialect;
    board_.draft().unguarded = guardian_.fault();
}

void Conversation::unguard() noexcept {
    if (guarded_in_) guardian_.dismiss();
    guarded_in_.reset();
}

Order Conversation::next_order() {
    const Time now = Clock::now();
    const Vec3 force = wanted_force(now);
    Order order{.arm = arm_, .dialect = dialect()};
    const bool first = !introduced_ && !arm_.empty();
    if (first && newer_) {
        order.introduces = true;
        order.preset = options_.preset;
    }
    introduced_ = introduced_ || first;
    order.whole_state = arm_.empty() || first || now >= whole_state_due_;
    if (order.whole_state) whole_state_due_ = now + kReadBackEvery;
    if ((epoch() != kNoEpoch && !arm_.empty()) || zeros_owed_ > 0) order.force_newton = force;
    return order;
}

Vec3 Conversation::wanted_force(Time now) {
    if (exchange_.forces.fresh()) loop_heard_ = now;
    const TimedForce& wanted = exchange_.forces.front();
    const bool may = epoch() != kNoEpoch && wanted.epoch == epoch() &&
                     now < wanted.at + kOldestForce && !Guardian::alarmed();
    return may ? wanted.newton : Vec3{0.0};
}

ForceDialect Conversation::dialect() const noexcept {
    if (options_.dialect) return *options_.dialect;
    return memory_.dialect.value_or(newer_ ? ForceDialect::vector : ForceDialect::values);
}

void Conversation::take() {
    std::string_view text;
    try {
        text = link_.read(Clock::now() + kMessageTakes);
    } catch (const LinkError& error) {
        if (error.why() == Why::too_long) ++memory_.not_understood;
        throw;
    }
    const Time now = Clock::now();
    if (memory_.reader.read(text, message_)) {
        take_message(message_, now);
    } else {
        take_nonsense(Stage::not_understood, {});
    }
}

void Conversation::take_message(const ServiceMessage& message, Time at) {
    if (!message.complaint.empty()) {
        if (sent_drives_ && !memory_.dialect_confirmed) {
            try_other_dialect();
            memory_.watch.miss();
            exchange_.poses.publish(TimedPose{});
            return;
        }
        take_nonsense(Stage::not_understood,
                      "the Haply Inverse Service complains: " + one_line(message.complaint.view()));
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
        miss_arm(message);
    }
}

void Conversation::take_nonsense(Stage why, const std::string& sentence) {
    ++memory_.not_understood;
    memory_.watch.miss();
    exchange_.poses.publish(TimedPose{});
    tell(why, sentence.empty() ? sentence_for(why, board_.draft()) : sentence, true);
}

/// Chooses the first by ID, so that the order of the list does not matter.
void Conversation::choose(const ServiceMessage& message) {
    for (DeviceId& id : left_alone_)
        if (message.arm(id) == nullptr) id = {};  // unplugged: may be chosen when it comes again
    const Arm* chosen = nullptr;
    for (std::size_t k = 0; k < message.arm_count; ++k) {
        const Arm& arm = message.arms[k];
        if (!named(arm, options_.device) || is_in(left_alone_, arm.id)) continue;
        if (chosen == nullptr || arm.id.view() < chosen->id.view()) chosen = &arm;
    }
    if (chosen == nullptr) return;
    arm_ = chosen->id;
    left_alone_ = {};
    introduced_ = false;
    presets_asked_ = 0;
    board_.draft().other_preset = false;
    hearing_.begin();
    memory_.watch.begin();
    board_.draft().id = one_line(arm_.view());
}

/// Another user may hold the other arms: they are ignored until plugged in again.
void Conversation::leave_others(const ServiceMessage& message) {
    for (std::size_t k = 0; k < message.arm_count; ++k) left_alone_[k] = message.arms[k].id;
}

void Conversation::forget_arm() {
    arm_ = {};
    unguard();
    zeros_owed_ = 0;
    told_ = false;
    gone_ = false;
    memory_.watch.miss();
    memory_.watch.begin();
    exchange_.poses.publish(TimedPose{});
    Status& status = board_.draft();
    status.id.clear();
    status.minverse = false;
}

/// No arm is attached, or the chosen one is lost, or no attached one is the requested one.
void Conversation::miss_arm(const ServiceMessage& message) {
    if (gone_ && zeros_owed_ > 0) return;  // first the pending zeros: the arm may still get them
    if (gone_) return forget_arm();
    if (!arm_.empty()) return lose_arm(message);
    const bool any = message.arm_count > 0;
    const bool as_told =
        any ? is_in(left_alone_, message.arms[0].id) : board_.draft().stage == Stage::no_device;
    if (as_told) return;
    tell(Stage::no_device,
         any ? "the Haply Inverse Service has no Inverse3 that is " + options_.device +
                   ", but has " + one_line(message.arms[0].id.view())
             : sentence_for(Stage::no_device, board_.draft()),
         any);
}

void Conversation::lose_arm(const ServiceMessage& message) {
    std::string sentence = "the " + name_of(board_.draft()) + " was unplugged: plug it in again";
    if (options_.device.empty()) {
        leave_others(message);
        if (message.arm_count > 0)
            sentence += "; to use " + one_line(message.arms[0].id.view()) +
                        " instead, unplug it and plug it in again";
    }
    memory_.watch.miss();
    exchange_.poses.publish(TimedPose{});
    gone_ = true;
    tell(Stage::no_device, sentence, true);
}

void Conversation::take_arm(const Arm& arm, Time at) {
    gone_ = false;
    memory_.watch.add(arm, at);
    if (memory_.watch.jumped()) whole_state_due_ = at;
    if (arm.config) read_back(*arm.config);
    learn_dialect(arm, at);
    publish_pose(arm, at);
    tell_stage(stage());
}

/// The Haply Hub may have replaced our preset by its own, or the service may not take ours.
void Conversation::read_back(const ArmConfig& config) {
    Status& status = board_.draft();
    status.minverse = config.minverse;
    status.handedness = config.handedness;
    status.preset = one_line(config.preset.view());
    const bool is_ours =
        !newer_ || !introduced_ || config.preset.empty() || config.preset == options_.preset;
    if (is_ours) {
        presets_asked_ = 0;
        status.other_preset = false;
    } else if (presets_asked_ < kPresetsAsked) {
        ++presets_asked_;
        introduced_ = false;
    } else {
        status.other_preset = true;
    }
}

/// Why the arm cannot touch; `ready`: it can.
Stage Conversation::stage() const noexcept {
    if (deaf()) return Stage::deaf;
    const Stage of_arm = memory_.watch.stage();
    if (of_arm != Stage::ready) return of_arm;
    if (board_.draft().other_preset && options_.preset != ShortWord(kUsualPreset))
        return Stage::other_preset;
    return memory_.delay.within_ms() > kLongestExchange_ms ? Stage::slow : Stage::ready;
}

Epoch Conversation::epoch() const noexcept {
    return stage() == Stage::ready && !gone_ ? memory_.watch.epoch() : kNoEpoch;
}

/// Publishes a new stage; for the same stage no sentence is made.
void Conversation::tell_stage(Stage stage) {
    if (told_ && board_.draft().stage == stage) return;
    const bool trouble = stage == Stage::deaf || stage == Stage::other_frame ||
                         stage == Stage::other_preset || stage == Stage::slow;
    tell(stage, sentence_for(stage, board_.draft()), trouble);
}

void Conversation::take_grip(const ServiceMessage& message, Time at) {
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
    buttons_ = memory_.buttons.add(down, at);
}

void Conversation::learn_dialect(const Arm& arm, Time at) {
    if (!sent_drives_) return;
    hearing_.add(sent_newton_, arm.force_newton, at);
    if (hearing_.hears() == HearingWatch::Hears::yes) memory_.dialect_confirmed = true;
    if (hearing_.hears() == HearingWatch::Hears::no) try_other_dialect();
}

/// The force then rises from zero, because the effect of the other dialect is not known.
void Conversation::try_other_dialect() {
    memory_.dialect_confirmed = false;
    hearing_.begin();
    memory_.watch.miss();
    memory_.dialects_refused = options_.dialect ? 2 : memory_.dialects_refused + 1;
    if (memory_.dialects_refused < 2) memory_.dialect = other(dialect());
}

void Conversation::publish_pose(const Arm& arm, Time at) {
    TimedPose& pose = exchange_.poses.back();
    pose.epoch = epoch();
    pose.exchange_ms = memory_.delay.within_ms();
    pose.position_m = arm.position_m.value_or(Vec3{0.0});
    pose.buttons = buttons_;
    pose.at = at;
    pose.number = memory_.exchanges + 1;
    exchange_.poses.publish();
}

void Conversation::report(Time now) {
    Status& status = board_.draft();
    status.presses = memory_.buttons.presses();
    status.pressed_at = memory_.buttons.pressed_at();
    status.exchanges = memory_.exchanges;
    status.unasked = memory_.unasked;
    status.not_understood = memory_.not_understood;
    status.dialect = dialect();
    status.dialect_confirmed = memory_.dialect_confirmed;
    status.exchange_ms = memory_.delay.mean_ms();
    status.softened = memory_.delay.within_ms() > kPromptExchange_ms;
    if (now - rate_since_ >= kRatePeriod) {
        const std::chrono::duration<double> passed = now - rate_since_;
        status.exchanges_per_s =
            static_cast<double>(memory_.exchanges - rate_from_) / passed.count();
        rate_from_ = memory_.exchanges;
        rate_since_ = now;
    }
    board_.publish_if_due(now);
}

void Conversation::tell(Stage stage, const std::string& sentence, bool trouble) {
    told_ = true;
    const Status& told = board_.draft();
    if (told.stage == stage && told.sentence == sentence) return;
    board_.enter(stage, sentence, trouble);
}

}  // namespace dibhr::inverse3
