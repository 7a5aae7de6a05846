// `dibhr devices --check` for a Falcon: measures what ../README.md, To be measured, lists, step by
// step, guides the user, and keeps a record of everything.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "device/falcon/firmware_image.hpp"
#include "device/falcon/kinematics.hpp"
#include "device/hand/check/console.hpp"

namespace dibhr::falcon {

/// Durations of the check; tests shorten them.
struct CheckTimes {
    using Span = std::chrono::milliseconds;

    Span rate{3000};        ///< of one measurement of the reply rate
    Span homing_bit{2000};  ///< with the homing bit cleared
    Span sample{500};       ///< over which counts are averaged
    Span button_calm{100};  ///< without a change: the button has stopped bouncing
    Span ramp{500};         ///< up to a force, and down again
    Span hold{3000};        ///< of a force on the scale, at most
    Span short_hold{1000};  ///< of the force before a silence
    Span reconnect{5000};   ///< until a Falcon that is plugged in again may be opened
    std::vector<Span> silences{Span(10), Span(100), Span(1000)};  ///< after the last packet
};

struct CheckOptions {
    std::string serial{};  ///< empty: the first one
    FirmwareImage firmware{};
    Geometry geometry{};             ///< of the current settings
    std::filesystem::path record{};  ///< empty: falcon-check-SERIAL-DATE.json in this folder
    /// More entries for the record, such as the program's version.
    std::vector<std::pair<std::string, std::string>> facts{};
    CheckTimes times{};
};

/// Runs all steps and writes the record after each; the user may skip any of them, or quit. There
/// is force only in steps that announce it: homed, ramped, at most 3 s, and ended at once by any
/// key or fault. However the check ends, it sends five packets without force. Throws DeviceError
/// when no Falcon is attached, InputError when the record cannot be written.
[[nodiscard]] CheckResult run_check(const CheckOptions& options, CheckConsole& console);

}  // namespace dibhr::falcon
