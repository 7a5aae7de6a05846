// The Inverse3 under check: one message and its answer at a time.
#include "device/inverse3/check/checked_inverse3.hpp"

#include <algorithm>
#include <thread>

#include "core/files/plain_text.hpp"
#include "device/inverse3/service_version.hpp"
#include "device/inverse3/simulated/name.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr::inverse3 {

namespace {

constexpr std::chrono::milliseconds kAnswerTimeout{1000};
constexpr std::chrono::milliseconds kInventoryTimeout{500};
constexpr std::chrono::milliseconds kVersionTimeout{300};
constexpr std::chrono::milliseconds kBeatPeriod{10};  // the guardian's timeout is 50 ms

/// Text that is no JSON stays text.
Json parsed_or_text(std::string_view text) {
    Json answer = parsed_json(text);
    return answer.is_discarded() ? Json(text) : answer;
}

/// Null: /version answers on no port.
Json reported_version(const ConnectionOptions& options) {
    for (const std::uint16_t port : {options.port, options.older_port}) {
        try {
            return parsed_or_text(
                http_get(port, "/version", CheckedInverse3::Clock::now() + kVersionTimeout));
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

CheckedInverse3::CheckedInverse3(const ConnectionOptions& options) : options_(options) {
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
    version_answer_ = reported_version(options);
    const auto version = version_of(survey.version);
    newer_ = version && version->at_least(3, 5);
    inventory_unrequested_ = connect();
    inventory_ = parsed_or_text(text_);
    name_session();
    (void)ask({.arm = DeviceId(id_), .whole_state = true});  // reads the settings back
    configured_state_ = parsed_or_text(text_);
}

CheckedInverse3::~CheckedInverse3() {
    release_force();
    if (link_) link_->close(Clock::now() + std::chrono::milliseconds(100));
}

bool CheckedInverse3::connect() {
    link_.emplace(options_.port, Clock::now() + kAnswerTimeout);
    if (!link_->wait(nullptr, Clock::now() + kInventoryTimeout)) {
        (void)ask({.arm = DeviceId(id_), .whole_state = true});
        return false;
    }
    text_ = link_->read(Clock::now() + kAnswerTimeout);
    (void)reader_.read(text_, message_);
    return true;
}

void CheckedInverse3::name_session() {
    if (!newer_) return;
    (void)ask({.arm = DeviceId(id_), .sets_session_name = true, .preset = options_.preset});
    error_text_ = message_.error_text.view();
}

void CheckedInverse3::drop_connection() noexcept {
    if (guarded_dialect_) guardian_.dismiss();
    guarded_dialect_.reset();
    if (link_) (void)link_->set_stop_packet({});
    link_.reset();
}

void CheckedInverse3::reopen() {
    (void)connect();
    name_session();
}

CheckedInverse3::Found CheckedInverse3::reconnect() {
    const bool unrequested = connect();
    const Arm* const arm = message_.arm(DeviceId(id_));
    if (arm == nullptr) throw DeviceError("the Inverse3 " + id_ + " was unplugged");
    const Found found{*arm, unrequested};
    name_session();
    return found;
}

bool CheckedInverse3::is_simulated() const {
    return version_answer_.is_object() &&
           version_answer_.value("project_name", Json()) == Json(simulated::kProjectName);
}

CheckedInverse3::Received CheckedInverse3::exchange(const std::optional<Vec3>& force_newton,
                                                    ForceDialect dialect) {
    if (!link_) reopen();
    if (force_newton) {
        last_force_dialect_ = dialect;
        guard(dialect);
    }
    const auto took = ask({.arm = DeviceId(id_), .force_newton = force_newton, .dialect = dialect});
    if (!message_.error_text.empty()) {
        throw DeviceError("the service complains: " + one_line(message_.error_text.view()));
    }
    const Arm* const arm = message_.arm(DeviceId(id_));
    if (arm == nullptr) throw DeviceError("the Inverse3 " + id_ + " was unplugged");
    return {*arm, took};
}

std::optional<Arm> CheckedInverse3::poll(ForceDialect dialect) {
    (void)ask({.arm = DeviceId(id_), .dialect = dialect});
    const Arm* const arm = message_.arm(DeviceId(id_));
    return arm == nullptr ? std::nullopt : std::optional(*arm);
}

/// Sends a message and reads the answer into message_; returns the time between.
std::chrono::nanoseconds CheckedInverse3::ask(const ServiceRequest& request) {
    if (!link_) reopen();
    const auto sent = Clock::now();
    sent_at_ = sent;
    link_->send(writer_.write(request), sent + kAnswerTimeout);
    if (!wait_for_answer(sent + kAnswerTimeout)) {
        throw DeviceError("the service has sent nothing for a second: check whether it still runs");
    }
    text_ = link_->read(sent + kAnswerTimeout);
    const auto came = Clock::now();
    if (!reader_.read(text_, message_)) {
        throw DeviceError(
            "the service sent a message that dibhr does not understand: see the record");
    }
    return came - sent;
}

bool CheckedInverse3::wait_for_answer(Clock::time_point until) {
    while (!link_->wait(nullptr, std::min(until, Clock::now() + kBeatPeriod))) {
        guardian_.beat();
        if (Clock::now() >= until) return false;
    }
    guardian_.beat();
    if (guarded_dialect_ && guardian_.died()) {
        throw LinkError(LinkError::Why::unguarded,
                        "the process that takes the force off when dibhr dies was ended: begin "
                        "the check again");
    }
    if (guardian_.has_sent()) {
        throw LinkError(LinkError::Why::program_stalled,
                        "this check stood still and the force was taken off: begin it again");
    }
    return true;
}

void CheckedInverse3::pause_sending(Clock::time_point until) {
    guardian_.beat();
    std::this_thread::sleep_until(until);
    guardian_.beat();
}

void CheckedInverse3::guard(ForceDialect dialect) {
    guardian_.beat();
    if (guarded_dialect_ == dialect) return;
    const StopPacket last = link_->set_stop_packet(
        writer_.write({.arm = DeviceId(id_), .force_newton = Vec3{0.0}, .dialect = dialect}));
    guardian_.watch(link_->descriptor(), last);
    guarded_dialect_ = dialect;
}

void CheckedInverse3::release_force() noexcept {
    if (!last_force_dialect_) return;
    constexpr int kZeros = 3;
    const ForceDialect first = *last_force_dialect_;
    const bool anew = !link_.has_value();
    try {
        if (anew) link_.emplace(options_.port, Clock::now() + kAnswerTimeout);
        for (int k = 0; k < kZeros; ++k) {
            for (const ForceDialect dialect : {first, other(first)}) {
                const auto until = Clock::now() + kAnswerTimeout;
                link_->send(
                    writer_.write(
                        {.arm = DeviceId(id_), .force_newton = Vec3{0.0}, .dialect = dialect}),
                    until);
                if (wait_for_answer(until)) (void)link_->read(until);
            }
        }
    } catch (const LinkError&) {
        last_force_dialect_.reset();  // the connection and its session are lost,
        guardian_.detach();           // or the guardian can still send over it
    }
    if (guarded_dialect_) guardian_.dismiss();
    guarded_dialect_.reset();
    // An unrequested message would make every later answer one exchange older.
    if (anew) link_.reset();
}

}  // namespace dibhr::inverse3
