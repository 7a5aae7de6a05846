// Force Dimension's arms among the force devices: how they are named, made, surveyed, initialised
// and recorded.
#include <memory>
#include <string>
#include <utility>

#include "device/force_device.hpp"
#include "device/forcedimension/check/checked_arm.hpp"
#include "device/forcedimension/forcedimension_device.hpp"
#include "device/forcedimension/guided.hpp"
#include "device/forcedimension/record.hpp"
#include "device/forcedimension/settings.hpp"
#include "device/forcedimension/survey.hpp"

namespace dibhr::forcedimension {

namespace {

ConnectionOptions connection_in(const DeviceSettings& settings, const DeviceArguments& given = {}) {
    ConnectionOptions connection =
        connection_of(static_cast<const ForceDimensionSettings&>(settings));
    if (!given.which.empty()) connection.serial = given.which;
    return connection;
}

std::unique_ptr<ForceDevice> make(const DeviceSettings& settings, const DeviceArguments& given) {
    ConnectionOptions connection = connection_in(settings, given);
    FoundCalls found = load_calls(connection.library);
    return std::make_unique<ForceDimensionDevice>(std::move(connection), std::move(found));
}

/// Power and initialisation are not checked here: the window shows what is missing.
std::string why_none_of_survey(const DeviceSettings& settings, const DeviceArguments& given) {
    const ConnectionOptions connection = connection_in(settings, given);
    return why_none(survey_arms(connection), connection.serial);
}

/// "the omega.3 1234: usable, ready to touch".
std::string line_of(const SurveyedArm& arm) {
    return name_of(arm.status).substr(4) + ": " + (arm.usable() ? "usable, " : "not usable yet, ") +
           arm.status.sentence;
}

/// Nothing is printed where neither a library nor an arm is there.
DevicesFound survey(const DeviceSettings& settings, const PrintLine& print) {
    const Survey there = survey_arms(connection_in(settings));
    DevicesFound found;
    if (!there.library.empty()) print("Force Dimension's library " + there.library);
    if (there.arms.empty() && !there.sentence.empty())
        print("Force Dimension: none usable, " + there.sentence);
    if (there.arms.empty() && there.trouble) found.refusal = there.sentence;
    for (const SurveyedArm& arm : there.arms) {
        print(line_of(arm));
        found.usable = found.usable || arm.usable();
        if (found.refusal.empty() && !arm.usable()) found.refusal = arm.status.sentence;
    }
    return found;
}

bool print_attached(const DeviceSettings& settings, const PrintLine& print) {
    bool usable = false;
    for (const SurveyedArm& arm : survey_arms(connection_in(settings)).arms) {
        print("a Force Dimension " + name_of(arm.status).substr(4) +
              " is there: " + arm.status.sentence);
        usable = usable || arm.usable();
    }
    return usable;
}

CheckResult check(const DeviceSettings& settings, const CheckRecordOptions& record_options,
                  const PrintLine& /*line*/, CheckConsole& console) {
    ArmUnderCheck arm(connection_in(settings));
    return check_arm(arm, record_options, console, {});
}

}  // namespace

extern const ForceDeviceKind device_kind{
    .name = "forcedimension",
    .title = "Force Dimension",
    .short_name = "Force Dimension arm",
    .article = "a Force Dimension arm",
    .which = "SERIAL",
    .known = "; its mass and delay are nominal, not measured",
    .no_pose_advice = "no fresh pose: no force",
    .make_settings = make_settings<ForceDimensionSettings>,
    .make = make,
    .why_none = why_none_of_survey,
    .attached =
        [](const DeviceSettings& settings) {
            return !survey_arms(connection_in(settings)).arms.empty();
        },
    .survey = survey,
    .print_attached = print_attached,
    .check = check,
    .initialise =
        [](const DeviceSettings& settings, const PrintLine& print, CheckConsole& console) {
            initialise_arm(connection_in(settings), print, console);
        },
    .record = [](const DeviceSettings& settings, const std::filesystem::path& file,
                 const PrintLine& print) { record_arm(connection_in(settings), file, print); },
    .play =
        [](const std::filesystem::path& file, const PrintLine& print) {
            if (!is_record(file)) return false;
            play_arm(file, print);
            return true;
        },
};

}  // namespace dibhr::forcedimension
