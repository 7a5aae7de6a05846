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

/// Whom a step needs to begin.
enum class StepNeeds {
    nobody,           ///< it is done when nobody can answer, too
    person,           ///< who types Enter
    person_for_force  ///< who types more than that: an Enter may have been meant for the last step
};

/// What of a step is told and asked before it.
struct CheckStep {
    const char* name;     ///< in the record
    const char* title;    ///< for people
    const char* meaning;  ///< what will happen, and what the person does
    StepNeeds needs;
};

class CheckRun {
  public:
    /// All outlive it. `let_go`: leaves the device without force; after it no step is begun.
    CheckRun(CheckQuestions& questions, CheckRecord& record, const CheckFindings& findings,
             std::size_t steps, std::function<void()> let_go);

    /// Introduces and runs it, unless the check is over or `why_not` says why it makes no sense;
    /// the record is written after it.
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
    std::function<void()> let_go_;
    std::size_t number_{0};
    std::string fault_{};
    bool over_{false};
};

/// A step of a device's check, and what it does.
template <typename Desk>
struct StepAt {
    CheckStep told;
    void (*run)(Desk& desk, Json& measured);
    bool needs_answers{true};  ///< makes no sense while the device gives none
};

/// All of them in turn, and then what was found. `desk`: a CheckQuestions with `findings`;
/// `let_go`: as of CheckRun; `why_silent`: why the device gives no answers; empty: it does.
template <typename Desk, std::size_t N>
CheckResult run_steps(const std::array<StepAt<Desk>, N>& steps, Desk& desk, CheckRecord& record,
                      const std::function<void()>& let_go,
                      const std::function<std::string()>& why_silent) {
    CheckRun run(desk, record, desk.findings, N, let_go);
    for (const StepAt<Desk>& step : steps) {
        run.step(
            step.told, [&] { return step.needs_answers ? why_silent() : std::string{}; },
            [&](Json& measured) { step.run(desk, measured); });
    }
    let_go();
    desk.guide.say(desk.findings.summary() + "The record: " + record.file().string());
    return {record.file(), run.fault()};
}

}  // namespace dibhr
