// `dibhr devices --check` for a Force Dimension arm: measures what ../README.md, To be measured,
// lists, step by step, guides the user, and keeps a record of everything.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "device/forcedimension/status.hpp"
#include "device/hand/check/console.hpp"

namespace dibhr::forcedimension {

/// Durations of the check; tests shorten them.
struct CheckTimes {
    using Span = std::chrono::milliseconds;

    Span calls{3000};      ///< of the measurement of each call's time
    Span moving{300'000};  ///< while the user moves the grip, at most
    Span ramp{500};        ///< up to a force
    Span hold{3000};       ///< of a force on the scale, at most
    Span short_hold{100};  ///< of the weak force before a silence
    /// Times without a call, after which the arm is asked whether its force is on.
    std::vector<Span> silences{Span(5), Span(10), Span(15), Span(25), Span(50), Span(200)};
};

struct CheckOptions {
    ConnectionOptions connection{};
    std::filesystem::path record{};  ///< empty: forcedimension-check-SERIAL-DATE.json
    /// More entries for the record, such as the program's version.
    std::vector<std::pair<std::string, std::string>> facts{};
    CheckTimes times{};
};

/// Runs all steps and writes the record after each; the user may skip any of them, or quit. There
/// is force only in steps that announce it, at most 4 N for 3 s, and any key ends it at once.
/// However the check ends, the arm is stopped. Throws DeviceError when no arm can be used,
/// InputError when the record cannot be written.
[[nodiscard]] CheckResult run_check(const CheckOptions& options, CheckConsole& console);

}  // namespace dibhr::forcedimension
