// Where a step of the check has the person, the Falcon, and what is found.
#pragma once

#include <optional>
#include <string>

#include "device/falcon/check/check.hpp"
#include "device/falcon/check/falcon.hpp"
#include "device/falcon/check/findings.hpp"
#include "device/falcon/check/guide.hpp"

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
    /// Goes on when the person has done what was asked.
    void wait_for(const std::string& question);
    /// The typed word; empty: Enter alone.
    [[nodiscard]] std::string word(const std::string& question);
    /// The typed number, asked for again until it is one in the range; nothing: Enter alone.
    [[nodiscard]] std::optional<double> number(const std::string& question, double lowest,
                                               double highest);

    /// A line typed since the last question, if there is one; "s" and "q" throw. For steps that
    /// wait for something else meanwhile.
    [[nodiscard]] std::optional<std::string> answer();
    /// Throws PersonQuits after Ctrl+C.
    void quit_if_interrupted() const;

  private:
    [[nodiscard]] std::optional<std::string> line();
    void keep_talking();
};

}  // namespace dibhr::falcon
