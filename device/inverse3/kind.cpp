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

ConnectionOptions connection_in(const DeviceSettings& settings, const DeviceArguments& given = {}) {
    ConnectionOptions connection = connection_of(static_cast<const Inverse3Settings&>(settings));
    if (!given.which.empty()) connection.device = given.which;
    return connection;
}

std::unique_ptr<ForceDevice> make(const DeviceSettings& settings, const DeviceArguments& given) {
    return std::make_unique<Inverse3Device>(connection_in(settings, given));
}

std::vector<DeviceLine> read_kept_settings(const DeviceSettings& settings, const std::string& id) {
    std::vector<DeviceLine> lines;
    for (const KeptSetting& kept : fetch_kept_settings(connection_in(settings), id)) {
        lines.push_back({.text = kept.name + ": " + kept.text,
                         .help = "As it was when the device was connected. The service keeps it "
                                 "for all programs; dibhr does not change it"});
    }
    return lines;
}

/// Power and calibration are not checked here: the window shows what is missing.
std::string why_none_of_service(const DeviceSettings& settings, const DeviceArguments& given) {
    const ConnectionOptions connection = connection_in(settings, given);
    return why_none(survey_service(connection), connection.device);
}

std::string name_of(const SurveyedArm& arm) {
    const std::string kind = arm.minverse ? "Haply Minverse " : "Haply Inverse3 ";
    return kind + arm.id;
}

void print_device(const GripStatus& grip, const PrintLine& print) {
    std::string text = "Haply grip " + grip.id + ": " + (grip.wired ? "wired" : "wireless") +
                       (grip.awake ? "" : ", asleep: press its button");
    if (grip.battery)
        text += ", battery " + std::to_string(std::lround(100.0 * *grip.battery)) + " %";
    print(text);
}

void print_device(const SurveyedArm& arm, const PrintLine& print) {
    print(name_of(arm) + ": " + (arm.usable() ? "usable, " : "not usable yet, ") + arm.sentence);
    if (arm.kept.empty()) return;
    print("  kept by the service for all programs, not changed by dibhr:");
    for (const KeptSetting& kept : arm.kept) print("    " + kept.name + ": " + kept.text);
}

DevicesFound survey(const DeviceSettings& settings, const PrintLine& print) {
    const Survey there = survey_service(connection_in(settings));
    if (there.stage != Stage::ready) {
        print("Haply Inverse3: none usable, " + there.sentence);
        return {};
    }
    print("Haply Inverse Service" + (there.version.empty() ? "" : " " + there.version));
    DevicesFound found;
    for (const SurveyedArm& arm : there.arms) {
        print_device(arm, print);
        found.usable = found.usable || arm.usable();
        if (found.refusal.empty()) {
            found.refusal = name_of(arm) + " is not usable yet, " + arm.sentence;
        }
    }
    for (const GripStatus& grip : there.grips) print_device(grip, print);
    return found;
}

bool print_attached(const DeviceSettings& settings, const PrintLine& print) {
    const Survey there = survey_service(connection_in(settings));
    for (const SurveyedArm& arm : there.arms)
        print("a Haply Inverse3 (" + arm.id + ") is there: " + arm.sentence);
    return std::any_of(there.arms.begin(), there.arms.end(),
                       [](const SurveyedArm& arm) { return arm.usable(); });
}

CheckResult check(const DeviceSettings& settings, const CheckRecordOptions& record_options,
                  const PrintLine& /*line*/, CheckConsole& console) {
    return run_check({.connection = connection_in(settings),
                      .record = record_options.record,
                      .facts = record_options.facts},
                     console);
}

/// Typed lines move the simulated hand and device. Throws DeviceError when a port is taken.
void simulate(const DeviceSettings& settings, std::istream& input, const PrintLine& print) {
    const ConnectionOptions connection = connection_in(settings);
    simulated::Scene scene;
    scene.grips = {simulated::Grip{}};
    simulated::Service service(std::move(scene), connection.port, connection.older_port);
    std::string_view commands = simulated::kHandCommands;
    commands.remove_suffix(1);  // the last newline
    print("A simulated Inverse3 answers on port " + std::to_string(service.port()) +
          ". Start dibhr in another terminal.\n" + std::string(commands));
    simulated::HandScript script(service);
    for (std::string line; std::getline(input, line);) {
        const std::string answer = script.run_line(line);
        if (!answer.empty()) print(answer);
    }
}

}  // namespace

extern const ForceDeviceKind device_kind{
    .name = "inverse3",
    .title = "Haply Inverse3",
    .short_name = "Inverse3",
    .article = "an Inverse3",
    .which = "ID",
    .known = "; its mass and delay are assumed, not measured",
    .no_pose_advice = "no fresh pose: no force",
    .make_settings = make_settings<Inverse3Settings>,
    .make = make,
    .read_kept_settings = read_kept_settings,
    .why_none = why_none_of_service,
    .attached =
        [](const DeviceSettings& settings) {
            return !survey_service(connection_in(settings)).arms.empty();
        },
    .survey = survey,
    .print_attached = print_attached,
    .check = check,
    .simulate = simulate,
};

}  // namespace dibhr::inverse3
