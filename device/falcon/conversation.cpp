// The exchange with one Falcon: homing, poses, forces.
#include "device/falcon/conversation.hpp"

#include <algorithm>

namespace dibhr::falcon {

namespace {

using std::chrono::milliseconds;

// README.md, Safety numbers.
constexpr milliseconds kOldestCommand{20};
constexpr milliseconds kNeverSilentFor{12};
constexpr int kZerosAfterForce = 5;
constexpr milliseconds kRatePeriod{500};
constexpr milliseconds kLoopPauses{200};  // without a command from the haptic loop

bool any(const Counts& motor) noexcept {
    return std::any_of(motor.begin(), motor.end(), [](auto count) { return count != 0; });
}

}  // namespace

Conversation::Conversation(const UsbContext& usb, FtdiPort& port, Exchange& exchange,
                           StatusBoard& board, Memory& memory, Guardian& guardian)
    : port_(port),
      exchange_(exchange),
      board_(board),
      memory_(memory),
      guardian_(guardian),
      link_(usb, port, exchange.wake),
      rate_from_(memory.replies),
      rate_since_(Link::Clock::now()),
      loop_heard_(rate_since_) {
    memory_.homing.begin(rate_since_);
    board_.enter(Stage::homing, how_to_home(0));
}

Conversation::~Conversation() {
    exchange_.replies.publish(TimedReply{});  // so that no tick uses an old pose
    const LinkCounts counts = link_.counts();
    memory_.counts.resent += counts.resent;
    memory_.counts.line_errors += counts.line_errors;
    memory_.counts.bytes_discarded += counts.bytes_discarded;
    memory_.buttons.release();
}

std::optional<UsbError> Conversation::run(const std::stop_token& stop) {
    const std::stop_callback wake_to_leave(stop, [this] { exchange_.wake.signal(); });
    speak(Link::Clock::now());
    while (!stop.stop_requested() && !link_.loss() && !guardian_.died()) {
        link_.wait(next_look());
        guardian_.beat();
        const Time now = Link::Clock::now();
        for (const Reply& reply : link_.replies()) take(reply, now);
        pace_chip(now);
        speak(now);
        report(now);
    }
    return link_.loss();
}

Conversation::Time Conversation::next_look() const noexcept {
    if (link_.idle()) return std::min(spoke_ + kNeverSilentFor, force_ends_);
    return std::min(link_.patience_ends(), Link::Clock::now() + kNeverSilentFor);
}

void Conversation::take(const Reply& reply, Time now) {
    memory_.homing.add(reply, now);
    ++memory_.replies;
    if (!loop_paused_) memory_.delay.add(spoke_, now);
    Reply steady = reply;
    steady.buttons = memory_.buttons.add(reply.buttons, now);
    exchange_.replies.publish(TimedReply{steady, now, memory_.homing.epoch(), memory_.replies,
                                         memory_.delay.within_ms()});
    board_.draft().reply = steady;

    const bool ready = memory_.homing.ready();
    if (was_ready_ && !ready) zeros_owed_ = kZerosAfterForce;
    was_ready_ = ready;
}

void Conversation::pace_chip(Time now) {
    if (exchange_.commands.fresh()) loop_heard_ = now;
    const bool paused = now - loop_heard_ > kLoopPauses;
    if (paused == loop_paused_) return;
    loop_paused_ = paused;
    port_.request(paused ? kLatencyWhilePaused : kLatencyRunTime);
}

void Conversation::speak(Time now) {
    if (!link_.takes_command(now)) return;
    const bool again = !link_.idle();
    const bool due = again || exchange_.commands.fresh() || zeros_owed_ > 0 ||
                     now >= spoke_ + kNeverSilentFor || now >= force_ends_;
    if (!due) return;
    const Command next = command(now);
    link_.send(encode(next), now);
    force_ends_ = any(next.motor) ? exchange_.commands.front().at + kOldestCommand : Time::max();
    spoke_ = now;
    zeros_owed_ = std::max(zeros_owed_ - 1, 0);
}

Command Conversation::command(Time now) {
    const TimedCommand& wanted = exchange_.commands.front();
    const bool ready = memory_.homing.ready();
    Command command;
    // Nobody knows whether clearing it loses homing (README.md, Homing and lamp).
    command.homing = true;
    if (ready && zeros_owed_ == 0 && wanted.epoch == memory_.homing.epoch() &&
        now < wanted.at + kOldestCommand && !Guardian::alarmed()) {
        command.motor = wanted.motor;
    }
    // Red: to be homed; blue: ready; green: force.
    command.led = !ready ? Led::red : any(command.motor) ? Led::green : Led::blue;
    return command;
}

void Conversation::report(Time now) {
    Status& status = board_.draft();
    const LinkCounts counts = link_.counts();
    status.presses = memory_.buttons.presses();
    status.pressed_at = memory_.buttons.pressed_at();
    status.replies = memory_.replies;
    status.resent = memory_.counts.resent + counts.resent;
    status.line_errors = memory_.counts.line_errors + counts.line_errors;
    status.bytes_discarded = memory_.counts.bytes_discarded + counts.bytes_discarded;
    count_rate(now);
    tell_stage(now);
    board_.publish_if_due(now);
}

void Conversation::tell_stage(Time now) {
    const bool idle = memory_.homing.idle(now);
    const int axes = homed_axes(board_.draft().reply.homed);
    const bool ready = memory_.homing.ready();
    const Stage stage = ready ? Stage::ready : Stage::homing;
    if (stage == board_.draft().stage && idle == was_idle_ && axes == axes_) return;
    was_idle_ = idle;
    axes_ = axes;
    if (ready) {
        board_.enter(Stage::ready, "ready to touch");
    } else if (idle) {
        board_.enter(
            Stage::homing,
            "no motion and no homing for 20 s: check the power adapter; then " + how_to_home(axes),
            true);
    } else {
        board_.enter(Stage::homing, how_to_home(axes));
    }
}

void Conversation::count_rate(Time now) {
    if (now - rate_since_ < kRatePeriod) return;
    const double seconds = std::chrono::duration<double>(now - rate_since_).count();
    board_.draft().replies_per_s = static_cast<double>(memory_.replies - rate_from_) / seconds;
    rate_from_ = memory_.replies;
    rate_since_ = now;
}

}  // namespace dibhr::falcon
