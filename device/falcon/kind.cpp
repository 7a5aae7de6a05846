// The Falcon among the force devices: how it is named, made, surveyed and checked.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "device/falcon/check/check.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/settings.hpp"
#include "device/falcon/survey.hpp"
#include "device/force_device.hpp"

namespace dibhr::falcon {

namespace {

const FalconSettings& falcon_settings(const DeviceSettings& settings) {
    return static_cast<const FalconSettings&>(settings);
}

/// The firmware to load into a Falcon that has none.
struct AvailableFirmware {
    FirmwareImage image{};
    std::string trouble{};  ///< why the kept file cannot be used
};

/// `given`, checked and kept for later starts; if empty, the kept image. Throws InputError when
/// `given` is no firmware.
AvailableFirmware available_firmware(const std::filesystem::path& given = {}) {
    if (!given.empty()) return {keep_firmware(given), {}};
    try {
        return {kept_firmware(), {}};
    } catch (const InputError& error) {
        return {{}, error.what()};
    }
}

ConnectionOptions connection_of(const DeviceSettings& settings, const DeviceArguments& given) {
    ConnectionOptions connection = falcon_settings(settings).connection;
    if (!given.which.empty()) connection.serial = given.which;
    return connection;
}

std::unique_ptr<ForceDevice> make(const DeviceSettings& settings, const DeviceArguments& given) {
    AvailableFirmware firmware = available_firmware(given.file);
    return std::make_unique<FalconDevice>(connection_of(settings, given), std::move(firmware.image),
                                          std::move(firmware.trouble));
}

/// Firmware and homing are not checked here: the window guides the user through them.
std::string why_none_to_open(const DeviceSettings& settings, const DeviceArguments& given) {
    const std::string serial = connection_of(settings, given).serial;
    const std::vector<AttachedFalcon> attached = attached_falcons();
    if (attached.empty()) {
        return "no Novint Falcon is attached: plug in its USB cable and its power adapter, or use "
               "--device mouse";
    }
    if (serial.empty() && attached.size() > 1) {
        return std::to_string(attached.size()) + " Novint Falcons are attached (" +
               serials_of(attached) +
               "): choose one with --device falcon:SERIAL or in the settings";
    }
    const auto requested = choose(attached, serial);
    return requested ? why_it_cannot_be_opened(*requested)
                     : why_none(attached, serial) + " with --device falcon:SERIAL";
}

std::string name_of(const AttachedFalcon& falcon) {
    return "Novint Falcon " + (falcon.serial.empty() ? "(serial unknown)" : falcon.serial);
}

std::string state_of(const SurveyedFalcon& falcon, const AvailableFirmware& firmware) {
    const bool wants_file = falcon.stage == Stage::no_firmware && firmware.image.empty();
    return (falcon.usable() ? "usable, " : "not usable yet, ") + falcon.sentence +
           (wants_file ? "; then: dibhr devices --firmware FILE" : "");
}

/// A failure to list the USB devices is only printed, because the mouse can still be used.
DevicesFound survey(const DeviceSettings& settings, const PrintLine& print) {
    try {
        if (attached_falcons().empty()) {
            print("Novint Falcon: none attached");
            return {};
        }
    } catch (const DeviceError& error) {
        print(std::string("Novint Falcon: not known whether one is attached, ") + error.what());
        return {};
    }
    const AvailableFirmware firmware = available_firmware();
    if (!firmware.trouble.empty()) print("kept firmware: " + firmware.trouble);
    ConnectionOptions options = falcon_settings(settings).connection;
    options.serial.clear();  // all of them
    const std::vector<SurveyedFalcon> falcons = survey_falcons(options, firmware.image);
    for (const SurveyedFalcon& one : falcons) {
        print(name_of(one.attached) + " at USB bus " + std::to_string(one.attached.bus) +
              " address " + std::to_string(one.attached.address) + ": " + state_of(one, firmware));
    }
    const bool usable = std::any_of(falcons.begin(), falcons.end(),
                                    [](const SurveyedFalcon& one) { return one.usable(); });
    // A Falcon that was unplugged meanwhile is not in the list.
    if (usable || falcons.empty()) return {.usable = usable};
    const std::string more = falcons.size() > 1 ? "; the others are listed above" : "";
    return {.refusal = name_of(falcons.front().attached) + " is " +
                       state_of(falcons.front(), firmware) + more};
}

bool print_attached(const DeviceSettings& /*settings*/, const PrintLine& print) {
    try {
        if (attached_falcons().empty()) return false;
        print("a Novint Falcon is attached; dibhr devices says whether it can be used");
    } catch (const DeviceError& error) {
        print(std::string("it is not known whether a Novint Falcon is attached: ") + error.what());
    }
    return true;
}

CheckResult check(const DeviceSettings& settings, const CheckRecordOptions& record_options,
                  const PrintLine& print, CheckConsole& console) {
    AvailableFirmware firmware = available_firmware();
    if (!firmware.trouble.empty()) print("kept firmware: " + firmware.trouble);
    return run_check({.serial = falcon_settings(settings).connection.serial,
                      .firmware = std::move(firmware.image),
                      .geometry = falcon_settings(settings).geometry,
                      .record = record_options.record,
                      .facts = record_options.facts},
                     console);
}

}  // namespace

extern const ForceDeviceKind device_kind{
    .name = "falcon",
    .title = "Novint Falcon",
    .short_name = "Falcon",
    .article = "a Falcon",
    .which = "SERIAL",
    .no_pose_advice = "no pose: pull the grip in, or see Calibration",
    .check_needs_consent = true,
    .make_settings = make_settings<FalconSettings>,
    .make = make,
    .keep_firmware = [](const std::filesystem::path& file) { return keep_firmware(file).name; },
    .why_none = why_none_to_open,
    .attached = [](const DeviceSettings& /*settings*/) { return !attached_falcons().empty(); },
    .survey = survey,
    .print_attached = print_attached,
    .check = check,
};

}  // namespace dibhr::falcon
