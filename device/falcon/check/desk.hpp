// Where a step of the check has the person, the Falcon, and what is found.
#pragma once

#include <optional>
#include <string>

#include "device/falcon/check/check.hpp"
#include "device/falcon/check/falcon.hpp"
#include "device/falcon/check/record.hpp"

namespace dibhr::falcon {

/// The person leaves this step out.
struct StepSkipped {};
/// The person leaves the check.
struct PersonQuits {};

/// Every question may throw StepSkipped (the answer "s") and PersonQuits ("q", Ctrl+C). While the
/// person thinks, the Falcon gets commands without force. When nobody can answer, what needs a
/// person is skipped.
struct CheckDesk {
    CheckGuide& guide;
    CheckedFalcon& falcon;
    const CheckOptions& options;
    Findings findings{};
    std::optional<double> counts_per_newton_metre{};  ///< once it was measured

    /// Any answer goes on; so does nobody.
    void begin(const std::string& question);
    /// The typed word, when the person has done what was asked; empty: Enter alone.
    std::string word(const std::string& question);
    /// The typed number, asked for again until it is one in the range; nothing: Enter alone.
    [[nodiscard]] std::optional<double> number(const std::string& question, double lowest,
                                               double highest);

    /// Whether a line was typed since the last question; "s" and "q" throw, and so does nobody. For
    /// steps that wait for something else meanwhile.
    bool answered();
    /// Throws PersonQuits after Ctrl+C.
    void quit_if_interrupted() const;

  private:
    [[nodiscard]] std::optional<std::string> typed();
    [[nodiscard]] std::optional<std::string> line();
    void keep_talking();
};

// The steps, each in the file of its name (check_silence with check_force). They add what they
// measure; they throw StepSkipped, PersonQuits, and DeviceError when the Falcon fails.
void check_identity(CheckDesk& desk, Json& measured);
void check_upload(CheckDesk& desk, Json& measured);
void check_rate(CheckDesk& desk, Json& measured);
void check_homing(CheckDesk& desk, Json& measured);
void check_stops(CheckDesk& desk, Json& measured);
void check_silence(CheckDesk& desk, Json& measured);
void check_force(CheckDesk& desk, Json& measured);
void check_buttons(CheckDesk& desk, Json& measured);
void check_plugs(CheckDesk& desk, Json& measured);

/// Until all three axes are homed; leads the person through it when they are not.
void home_with_person(CheckDesk& desk, Json& measured);

}  // namespace dibhr::falcon
