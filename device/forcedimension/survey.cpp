// The attached arms.
#include "device/forcedimension/survey.hpp"

#include <memory>
#include <utility>

#include "device/forcedimension/arm.hpp"

namespace dibhr::forcedimension {

namespace {

Stage stage_of(const std::optional<ArmStatus>& status) {
    if (!status) return Stage::cannot_open;
    if (!status->power) return Stage::no_power;
    if (status->error) return Stage::fault;
    return status->initialised ? Stage::ready : Stage::not_initialised;
}

SurveyedArm surveyed(const Arm& arm) {
    SurveyedArm found;
    arm.identify(found.status);
    found.status.stage = stage_of(arm.library().status(arm.id()));
    found.status.sentence = sentence_for(found.status.stage, found.status);
    return found;
}

}  // namespace

Survey survey_arms(const ConnectionOptions& options) {
    const UsbBus bus = read_usb_bus(options.usb_devices);
    FoundCalls found = load_calls(options.library);
    Survey survey;
    if (found.calls == nullptr) {
        survey.sentence = found.trouble.empty() ? why_no_library(bus) : found.trouble;
        survey.trouble = bus.has_arm && !survey.sentence.empty();
        return survey;
    }
    const auto library = std::make_shared<Library>(std::move(found.calls));
    survey.library = library->file() + ", version " + library->version();
    ArmSearch search(library, bus);
    while (const auto arm = search.next()) survey.arms.push_back(surveyed(*arm));
    if (!survey.arms.empty()) return survey;
    const NoArm why = why_no_arm(search, bus, {});
    survey.sentence = why.sentence;
    survey.trouble = why.stage != Stage::looking;
    return survey;
}

std::string why_none(const Survey& survey, const std::string& serial) {
    if (survey.arms.empty()) {
        return !survey.sentence.empty() ? survey.sentence
                                        : "no Force Dimension arm is attached, and its maker's "
                                          "library is not installed: "
                                          "see device/README.md, or use --device mouse";
    }
    std::string there;
    for (const SurveyedArm& arm : survey.arms) {
        if (serial.empty() || arm.status.serial == serial) return {};
        there += (there.empty() ? "" : ", ") + arm.status.serial;
    }
    return "no Force Dimension arm with serial " + serial + " is attached, but " + there +
           ": choose with --device forcedimension:SERIAL";
}

}  // namespace dibhr::forcedimension
