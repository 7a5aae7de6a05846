// The Inverse3 under check: one message and its answer at a time.
#include "device/inverse3/check/talk.hpp"

#include <algorithm>
#include <thread>

#include "core/files/plain_text.hpp"
#include "device/inverse3/service_version.hpp"
#include "device/inverse3/simulated/name.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr std::chrono::milliseconds kAnswerTakes{1000};
constexpr std::chrono::milliseconds kInventoryTakes{500};
constexpr std::chrono::milliseconds kVersionTakes{300};
constexpr std::chrono::milliseconds kBeatsEvery{10};  // the guardian's timeout is 50 ms

/// Text that is no JSON stays text.
Json as_told(std::string_view text) {
    Json told = parsed_json(text);
    return told.is_discarded() ? Json(text) : told;
}

/// Null: /version answers on no port.
Json version_told(const ConnectionOptions& options) {
    for (const std::uint16_t port : {options.port, options.older_port}) {
        try {
            return as_told(http_get(port, "/version", CheckTalk::Clock::now() + kVersionTakes));
        } catch (const LinkError&) {
            continue;
        }
    }
    return {};
}

}  // namespace

Json config_in(const Json& whole_state, const std::string& id) {
    if (!whole_state.is_object()) return Json::object();
    for (const Json& entry : whole_state.value("inverse3", Json::array())) {
        if (entry.is_object() && entry.value("device_id", Json()) == Json(id)) {
            return entry.value("config", Json::object());
        }
    }
    return Json::object();
}

CheckTalk::CheckTalk(const ConnectionOptions& options) : options_(options) {
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
    version_answer_ = version_told(options);
    const auto version = version_of(survey.version);
    newer_ = version && version->at_least(3, 5);
    inventory_unasked_ = connect();
    inventory_ = as_told(text_);
    introduce();
    (void)ask({.arm = DeviceId(id_), .whole_state = true});  // reads the settings back
    introduced_ = as_told(text_);
}

CheckTalk::~CheckTalk() {
    let_go();
    if (link_) link_->close(Clock::now() + std::chrono::milliseconds(100));
}

bool CheckTalk::connect() {
    link_.emplace(options_.port, Clock::now() + kAnswerTakes);
    if (!link_->wait(nullptr, Clock::now() + kInventoryTakes)) {
        (void)ask({.arm = DeviceId(id_), .whole_state = true});
        return false;
    }
    text_ = link_->read(Clock::now() + kAnswerTakes);
    (void)reader_.read(text_, message_);
    return true;
}

void CheckTalk::introduce() {
    if (!newer_) return;
    (void)ask({.arm = DeviceId(id_), .introduces = true, .preset = options_.preset});
    complaint_ = message_.complaint.view();
}

void CheckTalk::break_off() noexcept {
    if (guarded_in_) guardian_.dismiss();
    guarded_in_.reset();
    if (link_) (void)link_->set_last_words({});
    link_.reset();
}

void CheckTalk::begin_again() {
    (void)connect();
    introduce();
}

CheckTalk::Found CheckTalk::connect_again() {
    const bool unasked = connect();
    const Arm* const arm = message_.arm(DeviceId(id_));
    if (arm == nullptr) throw DeviceError("the Inverse3 " + id_ + " was unplugged");
    const Found found{*arm, unasked};
    introduce();
    return found;
}

bool CheckTalk::is_simulated() const {
    return version_answer_.is_object() &&
           version_answer_.value("project_name", Json()) == Json(simulated::kProjectName);
}

CheckTalk::Heard CheckTalk::exchange(const std::optional<Vec3>& force_newton,
                                     ForceDialect dialect) {
    if (!link_) begin_again();
    if (force_newton) {
        pushed_in_ = dialect;
        guard(dialect);
    }
    const auto took = ask({.arm = DeviceId(id_), .force_newton = force_newton, .dialect = dialect});
    if (!message_.complaint.empty()) {
        throw DeviceError("the service complains: " + one_line(message_.complaint.view()));
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

/// Sends a message and reads the answer into message_; returns the time between.
std::chrono::nanoseconds CheckTalk::ask(const Order& order) {
    if (!link_) begin_again();
    const auto sent = Clock::now();
    sent_at_ = sent;
    link_->send(writer_.write(order), sent + kAnswerTakes);
    if (!hears(sent + kAnswerTakes)) {
        throw DeviceError("the service has sent nothing for a second: check whether it still runs");
    }
    text_ = link_->read(sent + kAnswerTakes);
    const auto came = Clock::now();
    if (!reader_.read(text_, message_)) {
        throw DeviceError(
            "the service sent a message that dibhr does not understand: see the record");
    }
    return came - sent;
}

bool CheckTalk::hears(Clock::time_point until) {
    while (!link_->wait(nullptr, std::min(until, Clock::now() + kBeatsEvery))) {
        guardian_.beat();
        if (Clock::now() >= until) return false;
    }
    guardian_.beat();
    if (guarded_in_ && guardian_.died()) {
        throw LinkError(LinkError::Why::unguarded,
                        "the process that takes the force off when dibhr dies was ended: begin "
                        "the check again");
    }
    if (guardian_.spoken()) {
        throw LinkError(LinkError::Why::stood_still,
                        "this check stood still and the force was taken off: begin it again");
    }
    return true;
}

void CheckTalk::keep_silent(Clock::time_point until) {
    guardian_.beat();
    std::this_thread::sleep_until(until);
    guardian_.beat();
}

void CheckTalk::guard(ForceDialect dialect) {
    guardian_.beat();
    if (guarded_in_ == dialect) return;
    const Farewell last = link_->set_last_words(
        writer_.write({.arm = DeviceId(id_), .force_newton = Vec3{0.0}, .dialect = dialect}));
    guardian_.watch(link_->descriptor(), last);
    guarded_in_ = dialect;
}

void CheckTalk::let_go() noexcept {
    if (!pushed_in_) return;
    constexpr int kZeros = 3;
    const ForceDialect first = *pushed_in_;
    const bool anew = !link_.has_value();
    try {
        if (anew) link_.emplace(options_.port, Clock::now() + kAnswerTakes);
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
        pushed_in_.reset();  // the connection and its session are lost,
        guardian_.part();    // or the guardian can still send over it
    }
    if (guarded_in_) guardian_.dismiss();
    guarded_in_.reset();
    // An unrequested message would make every later answer one exchange older.
    if (anew) link_.reset();
}

}  // namespace dibhr::inverse3
