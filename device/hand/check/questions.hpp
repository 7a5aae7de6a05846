// Questions to the user of a device check.
#pragma once

#include <optional>
#include <string>

#include "device/hand/check/console.hpp"

namespace dibhr {

/// Thrown when the user skips this step.
struct StepSkipped {};
/// Thrown when the user quits the check.
struct PersonQuits {};
/// Thrown when the user ended a force, which ends the step.
struct ForceReleased {};

/// Every question may throw StepSkipped (the answer "s") and PersonQuits ("q", Ctrl+C). When the
/// input has ended, steps that need an answer are skipped. Single letters may be upper or lower
/// case.
class CheckQuestions {
  public:
    /// `person` must outlive this object.
    explicit CheckQuestions(CheckConsole& person) : console(person) {}
    virtual ~CheckQuestions() = default;

    CheckConsole& console;

    /// Returns after any answer, or at once when the input has ended.
    void begin(const std::string& question);
    /// Repeats the question until the user types "f". Enter alone begins no force: the user may
    /// have pressed it for the question before.
    void agree_to_force(const std::string& question);
    /// Repeats the question until the answer is y or n.
    [[nodiscard]] bool yes_or_no(const std::string& question);
    /// The typed line; empty: Enter alone.
    std::string word(const std::string& question);
    /// The typed number; repeats the question until it is in the range. Nothing: Enter alone.
    [[nodiscard]] std::optional<double> number(const std::string& question, double lowest,
                                               double highest);

    /// Whether a line was typed since the last question; does not wait. "s", "q" and the end of the
    /// input throw. For steps that measure while they wait for the answer.
    bool answered();
    /// Throws PersonQuits after Ctrl+C.
    void quit_if_interrupted() const;

  protected:
    /// Called every few milliseconds while a question is open: keeps the link to the device alive.
    virtual void keep_alive() = 0;

  private:
    [[nodiscard]] std::optional<std::string> typed();
    [[nodiscard]] std::optional<std::string> line();
};

}  // namespace dibhr
