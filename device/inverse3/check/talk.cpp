// One message and its answer at a time.
#include "device/inverse3/check/talk.hpp"

#include <algorithm>
#include <thread>

#include "device/inverse3/farewell.hpp"
#include "device/inverse3/service_version.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr std::chrono::milliseconds kAnswerTakes{1000};
constexpr std::chrono::milliseconds kInventoryTakes{500};
constexpr std::chrono::milliseconds kBeatsEvery{10};  // the guardian is told; it waits for 50 ms
constexpr std::chrono::milliseconds kLooksEvery{5};   // whether the person lets go

}  // namespace

CheckTalk::CheckTalk(const ConnectionOptions& options) {
    const Survey survey = survey_service(options);
    const std::string refusal = why_none(survey, options.device);
    if (!refusal.empty()) throw DeviceError(refusal);
    for (const SurveyedArm& arm : survey.arms) {
        const bool meant = why_none({.stage = Stage::ready, .arms = {arm}}, options.device).empty();
        if (meant && id_.empty()) {
            if (!arm.usable()) throw DeviceError(arm.sentence);
            id_ = arm.id;
        }
    }
    version_ = survey.version;
    const auto version = version_of(version_);
    newer_ = version && version->at_least(3, 5);
    link_.emplace(options.port, Clock::now() + kAnswerTakes);
    if (link_->wait(nullptr, Clock::now() + kInventoryTakes)) {
        inventory_ = link_->read(Clock::now() + kAnswerTakes);
    }
}

CheckTalk::~CheckTalk() {
    let_go();
    link_->close(Clock::now() + std::chrono::milliseconds(100));
}

CheckTalk::Heard CheckTalk::exchange(const std::optional<Vec3>& force_newton,
                                     ForceDialect dialect) {
    pushed_ = pushed_ || force_newton.has_value();
    if (force_newton) guard(dialect);
    const auto took = ask({.arm = DeviceId(id_), .force_newton = force_newton, .dialect = dialect});
    if (!message_.complaint.empty()) {
        throw DeviceError("the service complains: " + std::string(message_.complaint.view()));
    }
    const Arm* const arm = message_.arm(DeviceId(id_));
    if (arm == nullptr) throw DeviceError("the Inverse3 " + id_ + " was unplugged");
    return {*arm, took};
}

std::optional<Arm> CheckTalk::look(ForceDialect dialect) {
    (void)ask({.arm = DeviceId(id_), .dialect = dialect});
    const Arm* const arm = message_.arm(DeviceId(id_));
    return arm == nullptr ? std::nullopt : std::optional(*arm);
}

/// How long the answer took, which is in the message.
std::chrono::nanoseconds CheckTalk::ask(const Order& order) {
    const auto sent = Clock::now();
    link_->send(writer_.write(order), sent + kAnswerTakes);
    if (!hears(sent + kAnswerTakes)) {
        throw DeviceError("the service has been silent for a second: see whether it still runs");
    }
    const std::string_view text = link_->read(sent + kAnswerTakes);
    const auto came = Clock::now();
    if (!reader_.read(text, message_)) {
        throw DeviceError("the service said what is not understood: see the record");
    }
    return came - sent;
}

bool CheckTalk::hears(Clock::time_point until) {
    while (!link_->wait(nullptr, std::min(until, Clock::now() + kBeatsEvery))) {
        guardian_.beat();
        if (Clock::now() >= until) return false;
    }
    guardian_.beat();
    if (guardian_.spoken()) {
        throw LinkError(LinkError::Why::stood_still,
                        "this check stood still and the force was taken off: begin it again");
    }
    return true;
}

bool CheckTalk::keep_silent(std::chrono::milliseconds span, const std::function<bool()>& goes_on) {
    const auto end = Clock::now() + span;
    for (auto now = Clock::now(); now < end; now = Clock::now()) {
        guardian_.beat();
        if (!goes_on()) return false;
        std::this_thread::sleep_until(std::min(end, now + kLooksEvery));
    }
    guardian_.beat();
    return goes_on();
}

void CheckTalk::guard(ForceDialect dialect) noexcept {
    guardian_.beat();
    if (guarded_in_ == dialect) return;
    guardian_.watch(link_->descriptor(), farewell(DeviceId(id_), dialect));
    guarded_in_ = dialect;
}

void CheckTalk::let_go() noexcept {
    if (!pushed_) return;
    constexpr int kZeros = 3;
    const ForceDialect first = guarded_in_.value_or(ForceDialect::vector);
    try {
        for (int k = 0; k < kZeros; ++k) {
            for (const ForceDialect dialect : {first, other(first)}) {
                const auto until = Clock::now() + kAnswerTakes;
                link_->send(
                    writer_.write(
                        {.arm = DeviceId(id_), .force_newton = Vec3{0.0}, .dialect = dialect}),
                    until);
                if (hears(until)) (void)link_->read(until);
            }
        }
    } catch (const LinkError&) {
        pushed_ = false;  // it has gone, and its session with it
    }
    if (guarded_in_) guardian_.dismiss();
    guarded_in_.reset();
}

}  // namespace dibhr::inverse3
