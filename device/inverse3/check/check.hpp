// `dibhr devices --check` for an Inverse3: measures what ../README.md, To be measured, lists, step
// by step, guides the user, and keeps a record of everything.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "device/hand/check/console.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// Durations of the check; tests shorten them.
struct CheckTimes {
    using Span = std::chrono::milliseconds;

    Span rate{3000};           ///< of one measurement of the rate
    Span moving{300'000};      ///< while the user moves the grip, at most
    Span unplugging{300'000};  ///< for unplugging, and again for plugging in, at most
    Span frozen{3000};         ///< a position unchanged for longer counts as frozen
    Span ramp{500};            ///< up to a force
    Span hold{3000};           ///< of a force on the scale, at most
    Span short_hold{100};      ///< of the weak force before a silence
    Span closing_hold{1500};   ///< of the weak force before its connection ends
    Span dialect{700};         ///< of the weak force in each dialect
    /// Times without a message, after which the force is read.
    std::vector<Span> silences{Span(5),   Span(10),  Span(20),  Span(50),
                               Span(100), Span(200), Span(500), Span(1000)};
    /// Times without a connection.
    std::vector<Span> closings{Span(0), Span(100), Span(2000)};
};

struct CheckOptions {
    ConnectionOptions connection{};
    std::filesystem::path record{};  ///< empty: inverse3-check-ID-DATE.json in this folder
    /// More entries for the record, such as the program's version.
    std::vector<std::pair<std::string, std::string>> facts{};
    CheckTimes times{};
};

/// Runs all steps and writes the record after each; the user may skip any of them, or quit. There
/// is force only in steps that announce it, at most 4 N for 3 s, and any key ends it at once.
/// However the check ends, it sends zero forces. Throws DeviceError when no device can be used,
/// InputError when the record cannot be written.
[[nodiscard]] CheckResult run_check(const CheckOptions& options, CheckConsole& console);

}  // namespace dibhr::inverse3
