// Leads through the steps of a check, and keeps the record.
#include "device/hand/check/run.hpp"

#include <chrono>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

CheckRun::CheckRun(CheckQuestions& questions, CheckRecord& record, const CheckFindings& findings,
                   std::size_t steps, std::function<void()> release_force)
    : questions_(questions),
      record_(record),
      findings_(findings),
      steps_(steps),
      release_force_(std::move(release_force)) {
    record_.write(findings_);  // before any step: fails at once when the file cannot be written
}

void CheckRun::step(const CheckStep& step, const std::function<std::string()>& why_not,
                    const std::function<void(Json&)>& run) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    ++number_;
    Json measured = Json::object();
    std::string remark;
    const CheckEnd end =
        over_ ? CheckEnd::not_begun : guarded(step, why_not, run, measured, remark);
    over_ = over_ || end == CheckEnd::quit || end == CheckEnd::failed;
    if (over_) release_force_();
    const std::chrono::duration<double> took = Clock::now() - begin;
    record_.add(step.name, end, remark, took.count(), measured);
    record_.write(findings_);
}

CheckEnd CheckRun::guarded(const CheckStep& step, const std::function<std::string()>& why_not,
                           const std::function<void(Json&)>& run, Json& measured,
                           std::string& remark) {
    try {
        remark = why_not();
        if (!remark.empty()) return CheckEnd::not_begun;
        introduce(step);
        run(measured);
        return CheckEnd::done;
    } catch (const StepSkipped&) {
        return CheckEnd::skipped;
    } catch (const ForceReleased&) {
        questions_.console.print("Released: there is no force any more. This step ends here.");
        return CheckEnd::released;
    } catch (const PersonQuits&) {
        return CheckEnd::quit;
    } catch (const DeviceError& failure) {
        remark = fault_ = failure.what();
        return CheckEnd::failed;
    }
}

void CheckRun::introduce(const CheckStep& step) {
    questions_.console.print("\n" + std::to_string(number_) + " of " + std::to_string(steps_) +
                             ": " + step.title + "\n" + step.meaning);
    const char* const question = "Enter = go on, s = skip, q = quit";
    switch (step.needs) {
        case StepNeeds::nobody:
            questions_.begin(question);
            break;
        case StepNeeds::person:
            questions_.word(question);
            break;
        case StepNeeds::person_for_force:
            questions_.agree_to_force("F and Enter = begin with force, s = skip, q = quit");
            break;
    }
}

}  // namespace dibhr
