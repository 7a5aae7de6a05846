// Leads through the steps of a check, and keeps the record.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "core/files/json.hpp"
#include "device/hand/check/questions.hpp"
#include "device/hand/check/record.hpp"

namespace dibhr {

/// What a step needs from the user before it begins.
enum class StepNeeds {
    nobody,           ///< nothing: it also runs when the input has ended
    person,           ///< Enter
    person_for_force  ///< F: an Enter may have been pressed for the step before
};

/// The text printed before a step, and what it needs.
struct CheckStep {
    const char* name;     ///< in the record
    const char* title;    ///< as printed
    const char* meaning;  ///< what will happen, and what the user does
    StepNeeds needs;
};

class CheckRun {
  public:
    /// All must outlive this object. `release_force` leaves the device without force; no step runs
    /// then.
    CheckRun(CheckQuestions& questions, CheckRecord& record, const CheckFindings& findings,
             std::size_t steps, std::function<void()> release_force);

    /// Prints the step's text, runs the step and writes the record. Does not run it when the check
    /// is over, or when `why_not` returns a reason.
    void step(const CheckStep& step, const std::function<std::string()>& why_not,
              const std::function<void(Json&)>& run);

    /// Why the device failed; empty when it did not.
    [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

  private:
    [[nodiscard]] CheckEnd guarded(const CheckStep& step,
                                   const std::function<std::string()>& why_not,
                                   const std::function<void(Json&)>& run, Json& measured,
                                   std::string& remark);
    void introduce(const CheckStep& step);

    CheckQuestions& questions_;
    CheckRecord& record_;
    const CheckFindings& findings_;
    std::size_t steps_;
    std::function<void()> release_force_;
    std::size_t number_{0};
    std::string fault_{};
    bool over_{false};
};

/// A step of a device's check: its text and its function.
template <typename Context>
struct DeviceStep {
    CheckStep introduction;
    void (*run)(Context& context, Json& measured);
    bool needs_answers{true};  ///< not run while the device does not answer
};

/// Runs all steps in turn, then prints the findings. The second argument is a CheckQuestions with
/// `findings`; `release_force`: as of CheckRun; `why_no_answer`: why the device does not answer, or
/// empty.
template <typename Context, std::size_t N>
CheckResult run_steps(const std::array<DeviceStep<Context>, N>& steps, Context& context,
                      CheckRecord& record, const std::function<void()>& release_force,
                      const std::function<std::string()>& why_no_answer) {
    CheckRun run(context, record, context.findings, N, release_force);
    for (const DeviceStep<Context>& step : steps) {
        run.step(
            step.introduction, [&] { return step.needs_answers ? why_no_answer() : std::string{}; },
            [&](Json& measured) { step.run(context, measured); });
    }
    release_force();
    context.console.print(context.findings.summary() + "The record: " + record.file().string());
    return {record.file(), run.fault()};
}

}  // namespace dibhr
