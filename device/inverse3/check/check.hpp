// `dibhr devices --check` for an Inverse3: measures what ../README.md does not know, step by step,
// with a person beside it and a record of everything.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "device/hand/check/guide.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// How long things last; tests shorten them.
struct CheckTimes {
    using Span = std::chrono::milliseconds;

    Span rate{3000};       ///< of one measurement of the rate
    Span moving{300'000};  ///< while the person moves the grip about, at most
    Span unplugging{
        300'000};             ///< of each half of pulling the cable out and plugging it in, at most
    Span frozen{3000};        ///< a position that stays for longer, once it has moved
    Span ramp{500};           ///< up to a force
    Span hold{3000};          ///< of a force on the scale, at most
    Span short_hold{100};     ///< of the weak force before a silence
    Span closing_hold{1500};  ///< and before its connection ends
    Span dialect{700};        ///< of the weak force in each dialect
    /// Without a message, after which the force is looked for.
    std::vector<Span> silences{Span(5),   Span(10),  Span(20),  Span(50),
                               Span(100), Span(200), Span(500), Span(1000)};
    /// Without a connection.
    std::vector<Span> closings{Span(0), Span(100), Span(2000)};
};

struct CheckOptions {
    ConnectionOptions connection{};
    std::filesystem::path record{};  ///< empty: inverse3-check-ID-DATE.json in this folder
    /// What else belongs into the record, such as the program's version.
    std::vector<std::pair<std::string, std::string>> facts{};
    CheckTimes times{};
};

/// Leads through all steps and writes the record after each; a person may skip any of them, or
/// quit. Force only in steps that say so before, at most 4 N for 3 s, and released at once when the
/// person wants it. Every way out leaves with zero forces. Throws DeviceError when there is no
/// device to begin with, InputError when the record cannot be written.
[[nodiscard]] CheckResult run_check(const CheckOptions& options, CheckGuide& guide);

}  // namespace dibhr::inverse3
