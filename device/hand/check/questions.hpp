// Questions to the person beside a device that is checked.
#pragma once

#include <optional>
#include <string>

#include "device/hand/check/guide.hpp"

namespace dibhr {

/// The person leaves this step out.
struct StepSkipped {};
/// The person leaves the check.
struct PersonQuits {};
/// The person let go of a force, and with it of the step.
struct ForceLetGo {};

/// Every question may throw StepSkipped (the answer "s") and PersonQuits ("q", Ctrl+C). When nobody
/// can answer, what needs a person is skipped. Single letters count small and large.
class CheckQuestions {
  public:
    /// `person` outlives it.
    explicit CheckQuestions(CheckGuide& person) : guide(person) {}
    virtual ~CheckQuestions() = default;

    CheckGuide& guide;

    /// Any answer goes on; so does nobody.
    void begin(const std::string& question);
    /// Until the person typed "f": an Enter may have been meant for what came before, and begins no
    /// force.
    void agree_to_force(const std::string& question);
    /// Asked again until it is y or n.
    [[nodiscard]] bool yes_or_no(const std::string& question);
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

  protected:
    /// Some milliseconds while the person thinks: the device must not be forgotten.
    virtual void keep_talking() = 0;

  private:
    [[nodiscard]] std::optional<std::string> typed();
    [[nodiscard]] std::optional<std::string> line();
};

}  // namespace dibhr
