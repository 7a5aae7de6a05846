// A force on a Falcon's grip: ramped, supervised, and ended.
#include "device/falcon/check/push.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "device/falcon/kinematics.hpp"

namespace dibhr::falcon {

namespace {

constexpr double kMostMotion_m = 0.030;
constexpr std::chrono::seconds kLongestHold{3};
constexpr int kLastPackets = 5;                  // ../README.md, Safety numbers
constexpr std::chrono::milliseconds kPeriod{1};  // the haptic loop's
constexpr double kGrams_per_newton = 1000.0 / kStandardGravity;

// The least and the most that sources say of the torque scale (../README.md, Motors).
constexpr double kLowestScale = 3600.0;
constexpr double kHighestScale = 10000.0;

std::optional<Jacobian> jacobian_of(Vec3 encoder_counts, const Geometry& geometry) {
    const auto place = place_of(encoder_counts, geometry);
    return place ? jacobian_at(*place, geometry) : std::nullopt;
}

void send_last_packets(CheckedFalcon& falcon) noexcept {
    for (int k = 0; k < kLastPackets; ++k) {
        try {
            (void)falcon.exchange(no_force(Led::blue));
        } catch (const DeviceError& lost) {
            // The exception that led here, or the next exchange, reports the loss.
            continue;
        }
    }
}

}  // namespace

std::optional<Vec3> place_of(Vec3 encoder_counts, const Geometry& geometry) {
    constexpr Vec3 kMiddle_m{0.0, 0.0, 0.115};  // ../README.md, Workspace
    return position_with(angles_of_counts(encoder_counts, geometry), kMiddle_m, geometry);
}

CountsSample sample_counts(CheckContext& context) {
    CountsSample sample;
    const auto time = context.options.times.sample;
    const auto begin = CheckedFalcon::Clock::now();
    for (auto now = begin; sample.replies == 0 || now < begin + time;
         now = CheckedFalcon::Clock::now()) {
        context.quit_if_interrupted();
        const auto received = context.falcon.exchange(no_force(Led::blue), kPeriod);
        if (!received || received->at < begin + time / 2) continue;
        sample.mean += as_vec(received->reply.encoder);
        ++sample.replies;
    }
    sample.mean /= static_cast<double>(sample.replies);
    return sample;
}

Counts downward(CheckContext& context, Vec3 encoder_counts, int most_counts) {
    const auto jacobian = jacobian_of(encoder_counts, context.options.geometry);
    const auto torques =
        jacobian ? torques_of(Vec3(0.0, -1.0, 0.0), *jacobian) : std::optional<Vec3>();
    if (!torques) {
        context.console.print(
            "By its counts the grip is where it cannot be: unplug the power adapter, "
            "and home the Falcon again.");
        throw StepSkipped{};
    }
    // Far beyond full scale: shortened to it, the direction kept.
    constexpr double kFar = 1e6;
    const Motors all_of_it{.full_scale_counts = static_cast<double>(most_counts)};
    return motor_counts(*torques * kFar, all_of_it);
}

std::optional<double> downward_force(const Counts& motor, Vec3 encoder_counts,
                                     const Geometry& geometry) {
    const auto jacobian = jacobian_of(encoder_counts, geometry);
    if (!jacobian) return std::nullopt;
    double downward = 0.0;  // of J^T torque, where a torque is minus its motor's counts
    for (std::size_t leg = 0; leg < motor.size(); ++leg) {
        downward += (*jacobian)[leg].y * static_cast<double>(motor[leg]);
    }
    return downward;
}

std::string strength_of(const CheckContext& context, const Counts& motor, Vec3 encoder_counts) {
    const double unit =
        downward_force(motor, encoder_counts, context.options.geometry).value_or(0.0);
    const double least = unit / kHighestScale;
    const double most = unit / kLowestScale;
    std::string text = number_text(least, 1) + " to " + number_text(most, 1) + " N (" +
                       number_text(least * kGrams_per_newton, 0) + " to " +
                       number_text(most * kGrams_per_newton, 0) + " g";
    if (context.counts_per_newton_metre) {
        const double measured = unit / *context.counts_per_newton_metre;
        text += ", by your readings " + number_text(measured * kGrams_per_newton, 0) + " g";
    }
    return text + ")";
}

const char* sentence_of(PushEnd end) noexcept {
    constexpr std::array kSentences{"held", "released, because a key was pressed",
                                    "released, because the grip moved more than 30 mm",
                                    "released, because an axis was not homed any more",
                                    "released, because a reply was late"};
    static_assert(kSentences.size() == static_cast<std::size_t>(PushEnd::no_reply) + 1);
    return kSentences[static_cast<std::size_t>(end)];
}

Push::Push(CheckContext& context, const Counts& motor)
    : CheckPush(context.console, [&context] { send_last_packets(context.falcon); }),
      context_(context),
      motor_(motor) {}

PushEnd Push::exchange(double part) {
    Command command{.motor = motor_, .led = Led::green, .homing = true};
    for (auto& count : command.motor) {
        count = static_cast<std::int16_t>(std::lround(part * count));
    }
    const auto received = context_.falcon.exchange(command, kPeriod);
    if (!received) return PushEnd::no_reply;
    reply_ = received->reply;
    if ((reply_.homed & kAllAxes) != kAllAxes) return PushEnd::not_homed;
    const auto place = place_of(as_vec(reply_.encoder), context_.options.geometry);
    if (!place) return PushEnd::moved_away;
    if (!start_m_) start_m_ = place;
    return glm::distance(*place, *start_m_) > kMostMotion_m ? PushEnd::moved_away : PushEnd::held;
}

PushEnd Push::step(double part) {
    const PushEnd end = may_continue() ? exchange(part) : PushEnd::released;
    if (end != PushEnd::held) release();
    return end;
}

PushEnd Push::ramp(double from, double to) {
    // A late packet makes the ramp longer, not steeper.
    constexpr std::chrono::milliseconds kMostStep{5};
    const std::chrono::duration<double> whole = context_.options.times.ramp;
    PushEnd end = step(from);
    auto last = Clock::now();
    for (double done = 0.0; done < 1.0 && end == PushEnd::held;) {
        const auto now = Clock::now();
        const std::chrono::duration<double> passed =
            std::min<Clock::duration>(now - last, kMostStep);
        last = now;
        done = std::min(done + passed / whole, 1.0);
        end = step(from + (to - from) * done);
    }
    return end;
}

PushEnd Push::rise() {
    return ramp(0.0, 1.0);
}

PushEnd Push::hold(std::chrono::milliseconds time) {
    constexpr double kLeastWeight = 0.01;  // of the newest of a reply a millisecond
    const auto end_of_hold = Clock::now() + std::min<std::chrono::milliseconds>(time, kLongestHold);
    held_ = {};
    PushEnd end = PushEnd::held;
    while (end == PushEnd::held && Clock::now() < end_of_hold) {
        end = step(1.0);
        if (end != PushEnd::held) break;
        ++held_.replies;
        const double weight = std::max(1.0 / held_.replies, kLeastWeight);
        held_.mean += (as_vec(reply_.encoder) - held_.mean) * weight;
    }
    return end;
}

PushEnd Push::fall() {
    const PushEnd end = ramp(1.0, 0.0);
    release();
    return end;
}

PushEnd Push::pause_sending(std::chrono::milliseconds time, Reply& reply) {
    const bool lasted = CheckPush::pause_sending(
        time, [this](Time until) { context_.falcon.pause_sending(until); });
    const PushEnd end = lasted ? exchange(0.0) : PushEnd::released;
    reply = reply_;
    release();
    return end;
}

}  // namespace dibhr::falcon
