// The Inverse3 among the force devices: how it is named, made, surveyed, checked and simulated.
#include <algorithm>
#include <cmath>
#include <istream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device/force_device.hpp"
#include "device/inverse3/check/check.hpp"
#include "device/inverse3/inverse3_device.hpp"
#include "device/inverse3/kept_settings.hpp"
#include "device/inverse3/settings.hpp"
#include "device/inverse3/simulated/hand_script.hpp"
#include "device/inverse3/simulated/service.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr::inverse3 {

namespace {

ConnectionOptions connection_in(const DeviceSettings& settings, const DeviceGiven& given = {}) {
    ConnectionOptions connection = connection_of(static_cast<const Inverse3Settings&>(settings));
    if (!given.which.empty()) connection.device = given.which;
    return connection;
}

std::unique_ptr<ForceDevice> make(const DeviceSettings& settings, const DeviceGiven& given) {
    return std::make_unique<Inverse3Device>(connection_in(settings, given));
}

std::vector<DeviceLine> ask_kept(const DeviceSettings& settings, const std::string& id) {
    std::vector<DeviceLine> lines;
    for (const KeptSetting& kept : ask_kept_settings(connection_in(settings), id)) {
        lines.push_back({.text = kept.name + ": " + kept.words,
                         .help = "As it was when the device was connected. The service keeps it "
                                 "for all programs; dibhr does not change it"});
    }
    return lines;
}

/// Power and calibration are not checked here: the window shows what is missing.
std::string why_none_of_service(const DeviceSettings& settings, const DeviceGiven& given) {
    const ConnectionOptions connection = connection_in(settings, given);
    return why_none(survey_service(connection), connection.device);
}

std::string name_of(const SurveyedArm& arm) {
    const std::string kind = arm.minverse ? "Haply Minverse " : "Haply Inverse3 ";
    return kind + arm.id;
}

void tell_of(const GripStatus& grip, const TellLine& tell) {
    std::string text = "Haply grip " + grip.id + ": " + (grip.wired ? "wired" : "wireless") +
                       (grip.awake ? "" : ", asleep: press its button");
    if (grip.battery)
        text += ", battery " + std::to_string(std::lround(100.0 * *grip.battery)) + " %";
    tell(text);
}

void tell_of(const SurveyedArm& arm, const TellLine& tell) {
    tell(name_of(arm) + ": " + (arm.usable() ? "usable, " : "not usable yet, ") + arm.sentence);
    if (arm.kept.empty()) return;
    tell("  kept by the service for all programs, not changed by dibhr:");
    for (const KeptSetting& kept : arm.kept) tell("    " + kept.name + ": " + kept.words);
}

DevicesFound survey(const DeviceSettings& settings, const TellLine& tell) {
    const Survey there = survey_service(connection_in(settings));
    if (there.stage != Stage::ready) {
        tell("Haply Inverse3: none usable, " + there.sentence);
        return {};
    }
    tell("Haply Inverse Service" + (there.version.empty() ? "" : " " + there.version));
    DevicesFound found;
    for (const SurveyedArm& arm : there.arms) {
        tell_of(arm, tell);
        found.usable = found.usable || arm.usable();
        if (found.refusal.empty()) {
            found.refusal = name_of(arm) + " is not usable yet, " + arm.sentence;
        }
    }
    for (const GripStatus& grip : there.grips) tell_of(grip, tell);
    return found;
}

bool glance(const DeviceSettings& settings, const TellLine& tell) {
    const Survey there = survey_service(connection_in(settings));
    for (const SurveyedArm& arm : there.arms)
        tell("a Haply Inverse3 (" + arm.id + ") is there: " + arm.sentence);
    return std::any_of(there.arms.begin(), there.arms.end(),
                       [](const SurveyedArm& arm) { return arm.usable(); });
}

CheckResult check(const DeviceSettings& settings, const CheckPaper& paper, const TellLine& /*line*/,
                  CheckGuide& guide) {
    return run_check(
        {.connection = connection_in(settings), .record = paper.record, .facts = paper.facts},
        guide);
}

/// Typed lines move the simulated hand and device. Throws DeviceError when a port is taken.
void simulate(const DeviceSettings& settings, std::istream& orders, const TellLine& tell) {
    const ConnectionOptions connection = connection_in(settings);
    simulated::Scene scene;
    scene.grips = {simulated::Grip{}};
    simulated::Service service(std::move(scene), connection.port, connection.older_port);
    std::string_view commands = simulated::kHandCommands;
    commands.remove_suffix(1);  // the last newline
    tell("A simulated Inverse3 answers on port " + std::to_string(service.port()) +
         ". Start dibhr in another terminal.\n" + std::string(commands));
    simulated::HandScript script(service);
    for (std::string line; std::getline(orders, line);) {
        const std::string answer = script.obey(line);
        if (!answer.empty()) tell(answer);
    }
}

}  // namespace

extern const ForceDeviceKind device_kind{
    .name = "inverse3",
    .title = "Haply Inverse3",
    .called = "Inverse3",
    .article = "an Inverse3",
    .which = "ID",
    .known = "; its mass and delay are assumed, not measured",
    .no_pose = "no fresh pose: no force",
    .make_settings = make_settings<Inverse3Settings>,
    .make = make,
    .ask_kept = ask_kept,
    .why_none = why_none_of_service,
    .attached =
        [](const DeviceSettings& settings) {
            return !survey_service(connection_in(settings)).arms.empty();
        },
    .survey = survey,
    .glance = glance,
    .check = check,
    .simulate = simulate,
};

}  // namespace dibhr::inverse3
