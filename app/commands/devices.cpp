// `dibhr devices`: the mouse, and how far every attached device goes; or the check of one.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/devices_inverse3.hpp"
#include "app/commands/terminal_guide.hpp"
#include "app/settings/consent.hpp"
#include "app/settings/settings.hpp"
#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/realtime/tick_timer.hpp"
#include "device/falcon/check/check.hpp"
#include "device/falcon/survey.hpp"
#include "device/hand_device.hpp"
#include "device/inverse3/check/check.hpp"
#include "device/inverse3/survey.hpp"

namespace dibhr {
namespace {

std::string name_of(const falcon::AttachedFalcon& falcon) {
    return "Novint Falcon " + (falcon.serial.empty() ? "(serial unknown)" : falcon.serial);
}

std::string state_of(const falcon::SurveyedFalcon& falcon, const FirmwareAtHand& firmware) {
    const bool wants_file = falcon.stage == falcon::Stage::no_firmware && firmware.image.empty();
    return (falcon.usable() ? "usable, " : "not usable yet, ") + falcon.sentence +
           (wants_file ? "; then: dibhr devices --firmware FILE" : "");
}

/// Nothing, and a line about it, when the USB cannot be looked at: the mouse can still be used.
std::vector<falcon::AttachedFalcon> attached_or_none() {
    try {
        std::vector<falcon::AttachedFalcon> attached = falcon::attached_falcons();
        if (attached.empty()) std::cout << "Novint Falcon: none attached\n";
        return attached;
    } catch (const DeviceError& error) {
        std::cout << "Novint Falcon: not known whether one is attached, " << error.what() << '\n';
        return {};
    }
}

DevicesFound survey_falcons(const FirmwareAtHand& firmware) {
    if (attached_or_none().empty()) return {};
    if (!firmware.trouble.empty()) std::cout << "kept firmware: " << firmware.trouble << '\n';
    falcon::ConnectionOptions options = load_settings(settings_path()).falcon.connection;
    options.serial.clear();  // all of them
    const std::vector<falcon::SurveyedFalcon> falcons =
        falcon::survey_falcons(options, firmware.image);
    for (const falcon::SurveyedFalcon& one : falcons) {
        std::cout << name_of(one.attached) << " at USB bus " << one.attached.bus << " address "
                  << one.attached.address << ": " << state_of(one, firmware) << '\n';
    }
    const bool usable = std::any_of(falcons.begin(), falcons.end(),
                                    [](const falcon::SurveyedFalcon& one) { return one.usable(); });
    // One that was unplugged in the meantime is none.
    if (usable || falcons.empty()) return {.usable = usable};
    const std::string more = falcons.size() > 1 ? "; the others are told above" : "";
    return {.refusal = name_of(falcons.front().attached) + " is " +
                       state_of(falcons.front(), firmware) + more};
}

/// 0: a device can be used, or none is attached and the mouse can be. Throws DeviceError.
int survey(const FirmwareAtHand& firmware) {
    const inverse3::ConnectionOptions connection =
        connection_of(load_settings(settings_path()).inverse3);
    const DevicesFound falcons = survey_falcons(firmware);
    const DevicesFound inverse3 = tell_inverse3(connection);
    if (falcons.usable || inverse3.usable) return 0;
    const std::string& refusal = falcons.refusal.empty() ? inverse3.refusal : falcons.refusal;
    if (!refusal.empty()) throw DeviceError(refusal);
    return 0;
}

using Facts = std::vector<std::pair<std::string, std::string>>;

CheckResult check_falcon(const FirmwareAtHand& firmware, const std::filesystem::path& record,
                         const Facts& facts, CheckGuide& guide) {
    Settings all = load_settings(settings_path());
    Consent().hold_and_warn(all, settings_path());
    const FalconSettings& settings = all.falcon;
    if (!firmware.trouble.empty()) std::cout << "kept firmware: " << firmware.trouble << '\n';
    falcon::CheckOptions options;
    options.serial = settings.connection.serial;
    options.firmware = firmware.image;
    options.geometry = settings.geometry;
    options.record = record;
    options.facts = facts;
    return falcon::run_check(options, guide);
}

CheckResult check_inverse3(const std::filesystem::path& record, const Facts& facts,
                           CheckGuide& guide) {
    inverse3::CheckOptions options;
    options.connection = connection_of(load_settings(settings_path()).inverse3);
    options.record = record;
    options.facts = facts;
    return inverse3::run_check(options, guide);
}

/// Of an Inverse3 where the service has one and no Falcon is attached.
int check(const FirmwareAtHand& firmware, const std::filesystem::path& record) {
    const std::filesystem::path settings_file = settings_path();
    const auto guide = make_terminal_guide();
    const Facts facts{{"program", "dibhr " DIBHR_VERSION},
                      {"program_sha256", sha256_of_file("/proc/self/exe")},
                      {"thread_priority", become_realtime("dibhr check").priority.answer}};
    const bool of_inverse3 =
        falcon::attached_falcons().empty() &&
        !inverse3::survey_service(connection_of(load_settings(settings_file).inverse3))
             .arms.empty();
    const CheckResult result = of_inverse3 ? check_inverse3(record, facts, *guide)
                                           : check_falcon(firmware, record, facts, *guide);
    std::cout << "The settings file: " << settings_file.string() << '\n';
    if (!result.fault.empty()) throw DeviceError(result.fault);
    return 0;
}

}  // namespace

int run_devices(CLI::App& app, const Arguments& arguments) {
    std::filesystem::path firmware_file;  // empty: the kept one
    std::filesystem::path record;         // empty: DEVICE-check-SERIAL-DATE.json
    bool checks = false;
    std::string simulated;
    add_firmware(app, firmware_file);
    auto* const check_given =
        app.add_flag("--check", checks,
                     "Leads you through everything that is to be measured on a Falcon, or on an "
                     "Inverse3 where no Falcon is attached, with force only where it says so");
    add_file(app, "--out", record, "With --check: the record of what was measured")
        ->default_str("DEVICE-check-SERIAL-DATE.json")
        ->needs(check_given);
    app.add_option("--simulate", simulated,
                   "Stands in for the Haply Inverse Service, for people without one, until its "
                   "input ends; type to move its hand")
        ->type_name("inverse3")
        ->check(CLI::IsMember({"inverse3"}))
        ->excludes(check_given);
    app.footer(
        "Ends with 0 when a device can be used, or none is attached and the mouse can be; with 1 "
        "when Falcons, or Inverse3, are attached and none of them can be used.\n\nExamples:\n"
        "  dibhr devices\n"
        "  dibhr devices --firmware nvent_firmware.bin\n"
        "  dibhr devices --check\n"
        "  dibhr devices --simulate inverse3");
    if (!parse(app, arguments)) return 0;
    if (!simulated.empty()) {
        simulate_inverse3(connection_of(load_settings(settings_path()).inverse3));
        return 0;
    }
    if (checks) return check(firmware_at_hand(firmware_file), record);
    std::cout
        << "mouse: usable (point at the relief in the viewer, hold the left button to touch)\n";
    return survey(firmware_at_hand(firmware_file));
}

}  // namespace dibhr
