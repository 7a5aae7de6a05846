// A force on an Inverse3's grip: ramped, held and ended.
#include "device/inverse3/check/push.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

#include "core/files/plain_text.hpp"

namespace dibhr::inverse3 {

namespace {

using Clock = CheckedInverse3::Clock;

}  // namespace

bool reports_weak_force(const Arm& state) {
    constexpr double kToldBack = 0.05;
    return state.force_newton &&
           glm::length(*state.force_newton) >= kToldBack * glm::length(kWeak_newton);
}

Push::Push(CheckContext& context)
    : CheckPush(context.console, [&context] { context.device.release_force(); }),
      context_(context) {}

void Push::hold(Vec3 force_newton, ForceDialect dialect, CheckTimes::Span hold) {
    using Seconds = std::chrono::duration<double>;
    const Seconds ramp = context_.options.times.ramp;
    const auto begin = Clock::now();
    const auto end = begin + context_.options.times.ramp + hold;
    sent_newton_ = force_newton;
    while (Clock::now() < end) {
        if (!may_continue()) throw ForceReleased{};
        const Seconds since = Clock::now() - begin;
        last_ = context_.device.exchange(std::min(1.0, since / ramp) * force_newton, dialect).arm;
        if (!first_) first_ = last_;
        held_s_ = std::max(0.0, (Seconds(Clock::now() - begin) - ramp).count());
        if (!last_->calibrated || !last_->powered) {
            throw DeviceError("the Inverse3 lost its calibration or its power");
        }
    }
}

void Push::pause_sending(CheckTimes::Span span) {
    const auto wait = [this](Time until) { context_.device.pause_sending(until); };
    if (!CheckPush::pause_sending(span, wait)) throw ForceReleased{};
}

void Push::add_to(Json& part) const {
    part["sent_newton"] = along_axes(sent_newton_);
    if (!last_) return;
    if (last_->force_newton) part["told_newton"] = along_axes(*last_->force_newton);
    if (first_->position_m) part["position_begin_mm"] = along_axes(*first_->position_m * kMetre_mm);
    if (last_->position_m) part["position_end_mm"] = along_axes(*last_->position_m * kMetre_mm);
    part["held_s"] = held_s_;
}

void ForceEnd::add(double after_ms, bool acts) {
    if (acts) there_ms_ = std::max(there_ms_.value_or(after_ms), after_ms);
    if (!acts) gone_ms_ = std::min(gone_ms_.value_or(after_ms), after_ms);
}

std::string ForceEnd::in_words() const {
    const auto still = [&] { return "still there after " + number_text(*there_ms_, 1) + " ms"; };
    const auto gone = [&] { return "gone after " + number_text(*gone_ms_, 1) + " ms"; };
    if (!there_ms_ && !gone_ms_) return "not measured";
    if (!gone_ms_) return still() + ", the longest that was tried";
    if (!there_ms_) return gone() + ", the shortest that was tried";
    return (*there_ms_ > *gone_ms_ ? "not always after the same time: " : "") + still() + ", " +
           gone();
}

void ForceEnd::add_to(Json& measured) const {
    measured["still_there_after_ms"] = there_ms_ ? Json(*there_ms_) : Json();
    measured["gone_after_ms"] = gone_ms_ ? Json(*gone_ms_) : Json();
}

}  // namespace dibhr::inverse3
