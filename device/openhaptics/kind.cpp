// The Touch among the force devices: how it is named, made and surveyed.
#include <memory>
#include <string>

#include "core/error.hpp"
#include "device/force_device.hpp"
#include "device/openhaptics/check/checked_touch.hpp"
#include "device/openhaptics/openhaptics_device.hpp"
#include "device/openhaptics/record.hpp"
#include "device/openhaptics/settings.hpp"
#include "device/openhaptics/survey.hpp"
#include "device/recorded_device.hpp"

namespace dibhr::openhaptics {

namespace {

ConnectionOptions connection_in(const DeviceSettings& settings, const DeviceArguments& given = {}) {
    ConnectionOptions connection = connection_of(static_cast<const OpenhapticsSettings&>(settings));
    if (!given.which.empty()) connection.name = given.which;
    return connection;
}

std::unique_ptr<ForceDevice> make(const DeviceSettings& settings, const DeviceArguments& given) {
    return std::make_unique<OpenhapticsDevice>(connection_in(settings, given));
}

/// Calibration is not checked here: the window guides the user through it.
std::string why_none_answers(const DeviceSettings& settings, const DeviceArguments& given) {
    const Status status = survey_device(connection_in(settings, given));
    return answers(status) ? std::string{} : status.sentence;
}

bool is_usable(const Status& status) noexcept {
    return status.stage == Stage::ready;
}

/// Nothing is printed where neither OpenHaptics nor a Touch is there.
DevicesFound survey(const DeviceSettings& settings, const PrintLine& print) {
    const ConnectionOptions connection = connection_in(settings);
    const Status status = survey_device(connection);
    const bool attached = is_attached(status, connection);
    if (status.stage == Stage::no_library && !attached) return {};
    if (!answers(status)) {
        print("3D Systems Touch: none usable, " + status.sentence);
        return {.refusal = attached ? status.sentence : ""};
    }
    const std::string name = "3D Systems " + status.model + " " + status.serial;
    print(name + ": " + (is_usable(status) ? "usable, " : "not usable yet, ") + status.sentence);
    print("  driver " + status.driver + ", library " + status.version + ", " + status.library);
    return {.usable = is_usable(status),
            .refusal = is_usable(status) ? "" : name + " is not usable yet, " + status.sentence};
}

void record(const DeviceSettings& settings, const std::filesystem::path& file,
            const PrintLine& print) {
    ConnectionOptions connection = connection_in(settings);
    const LoadedLibrary library = load_hd_library(connection.library);
    if (!library.loaded)
        throw DeviceError(library.trouble.empty() ? sentence_for(Stage::no_library, {})
                                                  : library.trouble);
    connection.forces = false;
    connection.around = recording_in(file, library.file);
    OpenhapticsDevice device(connection);
    record_device(device, file, print);
}

bool play(const std::filesystem::path& file, const PrintLine& print) {
    if (!is_record(file)) return false;
    if (const LoadedLibrary library = play_record(file); !library.loaded)
        throw DeviceError(library.trouble);
    OpenhapticsDevice device({.library = file.string()});
    play_device(device, file, "openhaptics", print);
    return true;
}

CheckResult check(const DeviceSettings& settings, const CheckRecordOptions& record_options,
                  const PrintLine& /*line*/, CheckConsole& console) {
    using Span = ArmCheckTimes::Span;
    TouchUnderCheck arm(connection_in(settings));
    return check_arm(
        arm, record_options, console,
        {.silences = {Span(20), Span(50), Span(100), Span(200), Span(400), Span(800)}});
}

bool print_attached(const DeviceSettings& settings, const PrintLine& print) {
    const Status status = survey_device(connection_in(settings));
    if (answers(status))
        print("a 3D Systems Touch (" + status.serial + ") is there: " + status.sentence);
    return is_usable(status);
}

}  // namespace

extern const ForceDeviceKind device_kind{
    .name = "openhaptics",
    .title = "3D Systems Touch",
    .short_name = "Touch",
    .article = "a Touch",
    .which = "NAME",
    .known = "; its mass and step are nominal, not measured",
    .no_pose_advice = "no fresh pose: no force",
    .make_settings = make_settings<OpenhapticsSettings>,
    .make = make,
    .why_none = why_none_answers,
    .attached =
        [](const DeviceSettings& settings) {
            return answers(survey_device(connection_in(settings)));
        },
    .survey = survey,
    .print_attached = print_attached,
    .check = check,
    .record = record,
    .play = play,
};

}  // namespace dibhr::openhaptics
