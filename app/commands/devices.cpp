// `dibhr devices`: lists the mouse and the state of every attached device; or checks one.
#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/terminal_console.hpp"
#include "app/settings/consent.hpp"
#include "app/settings/settings.hpp"
#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/plain_text.hpp"
#include "core/realtime/tick_timer.hpp"
#include "device/force_devices.hpp"
#include "device/hand/check/console.hpp"

namespace dibhr {
namespace {

void print(const std::string& line) {
    std::cout << line << std::endl;
}

/// A given firmware file is stored before any device is opened.
void store_firmware(const std::filesystem::path& file) {
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        if (!file.empty() && kind->keep_firmware != nullptr) kind->keep_firmware(file);
    }
}

/// 0: a device can be used, or none is attached and the mouse can be. Throws DeviceError.
int survey() {
    const AllDeviceSettings chosen = load_settings(settings_path()).devices;
    bool usable = false;
    std::string refusal;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const DevicesFound found = force_device_kinds()[k]->survey(chosen[k], print);
        usable = usable || found.usable;
        if (refusal.empty()) refusal = found.refusal;
    }
    if (!usable && !refusal.empty()) throw DeviceError(refusal);
    return 0;
}

/// A device of this kind is attached and has a check. False where the search for it fails.
bool can_be_checked(const ForceDeviceKind& kind, const DeviceSettings& settings) try {
    return kind.check != nullptr && kind.attached(settings);
} catch (const DeviceError&) {
    return false;
}

/// The first kind that can be checked, whether or not its device is usable. Where none can: the
/// first kind, whose check says what to do.
std::size_t kind_to_check(const AllDeviceSettings& chosen) {
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        if (can_be_checked(*force_device_kinds()[k], chosen[k])) return k;
    }
    return 0;
}

int check(const std::filesystem::path& record) {
    const std::filesystem::path settings_file = settings_path();
    const auto console = make_terminal_console();
    const CheckRecordOptions record_options{
        record,
        {{"program", "dibhr " DIBHR_VERSION},
         {"program_sha256", sha256_of_file("/proc/self/exe")},
         {"thread_priority", become_realtime("dibhr check").priority->wait().answer}}};
    Settings settings = load_settings(settings_file);
    const AllDeviceSettings& chosen = settings.devices;
    const std::size_t k = kind_to_check(chosen);
    const ForceDeviceKind& kind = *force_device_kinds()[k];
    if (kind.check_needs_consent) Consent().replace_unsafe_and_warn(settings, settings_file);
    const CheckResult result = kind.check(chosen[k], record_options, print, *console);
    std::cout << "The settings file: " << settings_file.string() << '\n';
    if (!result.fault.empty()) throw DeviceError(result.fault);
    return 0;
}

/// Kinds that can be simulated, by their names.
std::vector<std::string> simulated_kinds() {
    std::vector<std::string> names;
    for (const ForceDeviceKind* const kind : force_device_kinds())
        if (kind->simulate != nullptr) names.emplace_back(kind->name);
    return names;
}

/// `what`: a kind, or a file that --record has written.
int simulate(const std::string& what) {
    const AllDeviceSettings chosen = load_settings(settings_path()).devices;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const ForceDeviceKind& kind = *force_device_kinds()[k];
        if (what == kind.name && kind.simulate != nullptr) {
            kind.simulate(chosen[k], std::cin, print);
            return 0;
        }
        if (kind.play != nullptr && kind.play(what, print)) return 0;
    }
    throw InputError(what + " is not a record of a device: give a file of dibhr devices --record");
}

/// Nothing: `what` can be simulated.
std::string why_not_simulated(std::string& what) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(what, ignored)) return {};
    return CLI::IsMember(simulated_kinds())(what);
}

int initialise() {
    const AllDeviceSettings chosen = load_settings(settings_path()).devices;
    const auto console = make_terminal_console();
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        auto* const function = force_device_kinds()[k]->initialise;
        if (function != nullptr) function(chosen[k], print, *console);
    }
    return 0;
}

/// Of the first kind whose device is attached; where none is, of the first one whose library is
/// installed.
int record_calls(const std::filesystem::path& file) {
    const AllDeviceSettings chosen = load_settings(settings_path()).devices;
    std::optional<DeviceError> refusal;
    for (const bool attached : {true, false}) {
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            const ForceDeviceKind& kind = *force_device_kinds()[k];
            if (kind.record == nullptr || (attached && !kind.attached(chosen[k]))) continue;
            try {
                kind.record(chosen[k], file, print);
                return 0;
            } catch (const DeviceError& error) {
                if (!refusal) refusal = error;
            }
        }
    }
    if (refusal) throw DeviceError(*refusal);
    return 0;
}

}  // namespace

int run_devices(CLI::App& app, const Arguments& arguments) {
    std::filesystem::path firmware_file;  // empty: the kept one
    std::filesystem::path record;         // empty: DEVICE-check-SERIAL-DATE.json
    bool checks = false;
    bool initialises = false;
    std::string simulated;
    std::filesystem::path recorded;
    add_firmware(app, firmware_file);
    auto* const check_given = app.add_flag(
        "--check", checks,
        "Guides you through all measurements of the attached device: a Falcon, or the first of an "
        "Inverse3, a Force Dimension arm and a Touch; a step with force says so before it begins");
    add_file(app, "--out", record, "With --check: the record of what was measured")
        ->default_str("DEVICE-check-SERIAL-DATE.json")
        ->needs(check_given);
    app.add_option("--simulate", simulated,
                   "Simulates the Haply Inverse Service, for people who have none, until its input "
                   "ends; typed commands move the simulated hand. Or plays a file of --record")
        ->type_name(listed(simulated_kinds()))
        ->check(CLI::Validator(why_not_simulated, ""))
        ->excludes(check_given);
    auto* const initialise_given =
        app.add_flag("--initialise", initialises,
                     "Lets the arm of a Force Dimension device drive itself to its stops, after "
                     "you agreed that nobody touches it")
            ->excludes(check_given);
    add_file(app, "--record", recorded,
             "Records for 10 seconds what the library of a Force Dimension arm or a Touch is asked "
             "and answers: a text file to send with a report, which --simulate plays")
        ->excludes(check_given)
        ->excludes(initialise_given);
    app.footer(
        "Ends with 0 when a device can be used, or none is attached and the mouse can be; with 1 "
        "when Falcons, or Inverse3, are attached and none of them can be used.\n\nExamples:\n"
        "  dibhr devices\n"
        "  dibhr devices --firmware nvent_firmware.bin\n"
        "  dibhr devices --check\n"
        "  dibhr devices --simulate inverse3");
    if (!parse(app, arguments)) return 0;
    if (!simulated.empty()) return simulate(simulated);
    if (initialises) return initialise();
    if (!recorded.empty()) return record_calls(recorded);
    if (!checks)
        print("mouse: usable (point at the relief in the viewer, hold the left button to touch)");
    store_firmware(firmware_file);
    return checks ? check(record) : survey();
}

}  // namespace dibhr
