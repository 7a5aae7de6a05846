// The devices of the service.
#include "device/inverse3/survey.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/files/plain_text.hpp"
#include "device/inverse3/arm_watch.hpp"
#include "device/inverse3/message.hpp"
#include "device/inverse3/service_link.hpp"
#include "device/inverse3/service_version.hpp"

namespace dibhr::inverse3 {

namespace {

using std::chrono::milliseconds;
using Why = LinkError::Why;

constexpr milliseconds kStepTimeout{1000};
constexpr milliseconds kInventoryTimeout{500};

ServiceLink::Time deadline_in(milliseconds span) {
    return ServiceLink::Time::clock::now() + span;
}

/// Reads the inventory; requests it where the service does not send it. Throws LinkError.
bool read_inventory(const ConnectionOptions& options, ServiceMessage& message) {
    ServiceLink link(options.port, deadline_in(kStepTimeout));
    if (!link.wait(nullptr, deadline_in(kInventoryTimeout))) {
        RequestWriter writer;
        link.send(writer.write({.whole_state = true}), deadline_in(kStepTimeout));
        if (!link.wait(nullptr, deadline_in(kStepTimeout))) {
            throw LinkError(Why::lost, "it has been silent for a second");
        }
    }
    MessageReader reader;
    const bool understood = reader.read(link.read(deadline_in(kStepTimeout)), message);
    link.close(deadline_in(milliseconds(100)));
    return understood;
}

SurveyedArm surveyed(const Arm& arm, const ConnectionOptions& options) {
    ArmWatch watch;
    watch.add(arm, {});
    SurveyedArm found;
    found.id = one_line(arm.id.view());
    if (arm.config) {
        found.minverse = arm.config->minverse;
        found.handedness = arm.config->handedness;
    }
    found.stage = watch.stage();
    Status status;
    status.id = found.id;
    status.minverse = found.minverse;
    found.sentence = sentence_for(found.stage, status);
    found.kept = fetch_kept_settings(options, std::string(arm.id.view()));
    return found;
}

GripStatus surveyed(const Grip& grip) {
    return {one_line(grip.id.view()), grip.wired, grip.awake && grip.connected, grip.battery};
}

void take(const ServiceMessage& message, const ConnectionOptions& options, Survey& survey) {
    for (std::size_t k = 0; k < message.arm_count; ++k) {
        survey.arms.push_back(surveyed(message.arms[k], options));
    }
    for (std::size_t k = 0; k < message.grip_count; ++k) {
        survey.grips.push_back(surveyed(message.grips[k]));
    }
    std::sort(survey.arms.begin(), survey.arms.end(),
              [](const SurveyedArm& a, const SurveyedArm& b) { return a.id < b.id; });
    survey.stage = survey.arms.empty() ? Stage::no_device : Stage::ready;
}

const char* word_of(Handedness hand) {
    return hand == Handedness::left ? "left" : hand == Handedness::right ? "right" : "";
}

}  // namespace

Survey survey_service(const ConnectionOptions& options) {
    Survey survey;
    Status status;
    status.installed = is_installed(options);
    const auto version = ask_version(options);
    if (version) survey.version = status.version = version->text;
    if (version && !version->at_least(3, 1)) {
        survey.stage = Stage::too_old;
    } else {
        try {
            ServiceMessage message;
            survey.stage = Stage::not_understood;
            if (read_inventory(options, message)) take(message, options, survey);
        } catch (const LinkError& error) {
            auto [stage, sentence] = service_fault(error, status);
            survey.stage = stage;
            survey.sentence = std::move(sentence);
            return survey;
        }
    }
    survey.sentence = sentence_for(survey.stage, status);
    return survey;
}

std::string why_none(const Survey& survey, const std::string& device) {
    if (survey.stage != Stage::ready) return survey.sentence;
    std::string there;
    for (const SurveyedArm& arm : survey.arms) {
        if (device.empty() || arm.id == device || word_of(arm.handedness) == device) return {};
        there += (there.empty() ? "" : ", ") + arm.id;
    }
    return "the Haply Inverse Service has no Inverse3 that is " + device + ", but " + there +
           ": choose with --device inverse3:ID";
}

}  // namespace dibhr::inverse3
