// The exchange with one Falcon: homing, poses, forces.
#include "device/falcon/exchange_loop.hpp"

#include <algorithm>

namespace dibhr::falcon {

namespace {

using std::chrono::milliseconds;

// README.md, Safety numbers.
constexpr milliseconds kOldestCommand{20};
constexpr milliseconds kLongestSendGap{12};
constexpr int kZerosAfterForce = 5;
constexpr milliseconds kRatePeriod{500};
constexpr milliseconds kLoopIdleAfter{200};  // without a command from the haptic loop

bool any(const Counts& motor) noexcept {
    return std::any_of(motor.begin(), motor.end(), [](auto count) { return count != 0; });
}

}  // namespace

ExchangeLoop::ExchangeLoop(const UsbContext& usb, FtdiPort& port, ThreadBuffers& buffers,
                           StatusBoard& board, DriverState& driver_state, Guardian& guardian)
    : port_(port),
      buffers_(buffers),
      board_(board),
      driver_state_(driver_state),
      guardian_(guardian),
      link_(usb, port, buffers.wake),
      rate_from_(driver_state.replies),
      rate_since_(Link::Clock::now()),
      last_loop_update_(rate_since_) {
    driver_state_.homing.begin(rate_since_);
    board_.enter(Stage::homing, how_to_home(0));
}

ExchangeLoop::~ExchangeLoop() {
    buffers_.replies.publish(TimedReply{});  // so that no tick uses an old pose
    const LinkCounts counts = link_.counts();
    driver_state_.counts.resent += counts.resent;
    driver_state_.counts.line_errors += counts.line_errors;
    driver_state_.counts.bytes_discarded += counts.bytes_discarded;
    driver_state_.buttons.release();
}

std::optional<UsbError> ExchangeLoop::run(const std::stop_token& stop) {
    const std::stop_callback wake_to_leave(stop, [this] { buffers_.wake.signal(); });
    send_if_due(Link::Clock::now());
    while (!stop.stop_requested() && !link_.loss() && !guardian_.died()) {
        link_.wait(next_deadline());
        guardian_.beat();
        const Time now = Link::Clock::now();
        for (const Reply& reply : link_.replies()) take(reply, now);
        pace_chip(now);
        send_if_due(now);
        report(now);
    }
    return link_.loss();
}

ExchangeLoop::Time ExchangeLoop::next_deadline() const noexcept {
    if (link_.idle()) return std::min(last_sent_ + kLongestSendGap, force_ends_);
    return std::min(link_.retry_at(), Link::Clock::now() + kLongestSendGap);
}

void ExchangeLoop::take(const Reply& reply, Time now) {
    driver_state_.homing.add(reply, now);
    ++driver_state_.replies;
    if (!loop_paused_) driver_state_.delay.add(last_sent_, now);
    Reply steady = reply;
    steady.buttons = driver_state_.buttons.add(reply.buttons, now);
    buffers_.replies.publish(TimedReply{steady, now, driver_state_.homing.epoch(),
                                        driver_state_.replies, driver_state_.delay.within_ms()});
    board_.draft().reply = steady;

    const bool ready = driver_state_.homing.ready();
    if (was_ready_ && !ready) zeros_pending_ = kZerosAfterForce;
    was_ready_ = ready;
}

void ExchangeLoop::pace_chip(Time now) {
    if (buffers_.commands.fresh()) last_loop_update_ = now;
    const bool paused = now - last_loop_update_ > kLoopIdleAfter;
    if (paused == loop_paused_) return;
    loop_paused_ = paused;
    port_.request(paused ? kLatencyWhilePaused : kLatencyRunTime);
}

void ExchangeLoop::send_if_due(Time now) {
    if (!link_.can_send(now)) return;
    const bool again = !link_.idle();
    const bool due = again || buffers_.commands.fresh() || zeros_pending_ > 0 ||
                     now >= last_sent_ + kLongestSendGap || now >= force_ends_;
    if (!due) return;
    const Command next = command(now);
    link_.send(encode(next), now);
    force_ends_ = any(next.motor) ? buffers_.commands.front().at + kOldestCommand : Time::max();
    last_sent_ = now;
    zeros_pending_ = std::max(zeros_pending_ - 1, 0);
}

Command ExchangeLoop::command(Time now) {
    const TimedCommand& requested = buffers_.commands.front();
    const bool ready = driver_state_.homing.ready();
    Command command;
    // Nobody knows whether clearing it loses homing (README.md, Homing and lamp).
    command.homing = true;
    if (ready && zeros_pending_ == 0 && requested.epoch == driver_state_.homing.epoch() &&
        now < requested.at + kOldestCommand && !Guardian::alarmed()) {
        command.motor = requested.motor;
    }
    // Red: to be homed; blue: ready; green: force.
    command.led = !ready ? Led::red : any(command.motor) ? Led::green : Led::blue;
    return command;
}

void ExchangeLoop::report(Time now) {
    Status& status = board_.draft();
    const LinkCounts counts = link_.counts();
    status.presses = driver_state_.buttons.presses();
    status.pressed_at = driver_state_.buttons.pressed_at();
    status.replies = driver_state_.replies;
    status.resent = driver_state_.counts.resent + counts.resent;
    status.line_errors = driver_state_.counts.line_errors + counts.line_errors;
    status.bytes_discarded = driver_state_.counts.bytes_discarded + counts.bytes_discarded;
    count_rate(now);
    publish_stage(now);
    board_.publish_if_due(now);
}

void ExchangeLoop::publish_stage(Time now) {
    const bool idle = driver_state_.homing.idle(now);
    const int axes = homed_axes(board_.draft().reply.homed);
    const bool ready = driver_state_.homing.ready();
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

void ExchangeLoop::count_rate(Time now) {
    if (now - rate_since_ < kRatePeriod) return;
    const double seconds = std::chrono::duration<double>(now - rate_since_).count();
    board_.draft().replies_per_s =
        static_cast<double>(driver_state_.replies - rate_from_) / seconds;
    rate_from_ = driver_state_.replies;
    rate_since_ = now;
}

}  // namespace dibhr::falcon
