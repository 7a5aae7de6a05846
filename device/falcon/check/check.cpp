// Leads through the steps of the check, and keeps the record.
#include "device/falcon/check/check.hpp"

#include <chrono>
#include <cstddef>
#include <string>

#include "device/falcon/check/desk.hpp"
#include "device/falcon/check/record.hpp"
#include "device/falcon/check/steps.hpp"

namespace dibhr::falcon {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kNoReplies = "the Falcon gives no replies";

class Check {
  public:
    Check(const CheckOptions& options, CheckGuide& guide)
        : guide_(guide),
          falcon_(options.serial),
          desk_{guide, falcon_, options},
          record_(options.record, falcon_.attached(), options.facts) {}

    CheckResult run() {
        guide_.say("Checks " + full_name_of(falcon_.attached()) + "; the record is " +
                   record_.file().string() + ", written again after every step.");
        record_.write(desk_.findings);  // before the work: an unwritable file is told at once
        const auto steps = check_steps();
        for (std::size_t k = 0; k < steps.size(); ++k) {
            const std::string number =
                std::to_string(k + 1) + " of " + std::to_string(steps.size());
            run_step(number, steps[k]);
        }
        falcon_.let_go();
        guide_.say(desk_.findings.summary() + "The record: " + record_.file().string());
        return {record_.file(), fault_};
    }

  private:
    void run_step(const std::string& number, const CheckStep& step) {
        if (over_) {
            record_.add(step.name, StepEnd::not_begun, "", 0.0, {});
            record_.write(desk_.findings);
            return;
        }
        const auto begin = Clock::now();
        Measured measured;
        std::string remark;
        const StepEnd end = guarded(number, step, measured, remark);
        over_ = end == StepEnd::quit || end == StepEnd::failed;
        if (over_) falcon_.let_go();
        const std::chrono::duration<double> took = Clock::now() - begin;
        record_.add(step.name, end, remark, took.count(), measured);
        record_.write(desk_.findings);
    }

    StepEnd guarded(const std::string& number, const CheckStep& step, Measured& measured,
                    std::string& remark) {
        try {
            if (step.needs != StepNeeds::nothing && !falcon_.answering() && !falcon_.answers()) {
                remark = kNoReplies;
                return StepEnd::not_begun;
            }
            introduce(number, step);
            step.run(desk_, measured);
            return StepEnd::done;
        } catch (const StepSkipped&) {
            return StepEnd::skipped;
        } catch (const PersonQuits&) {
            return StepEnd::quit;
        } catch (const DeviceError& failure) {
            remark = fault_ = failure.what();
            return StepEnd::failed;
        }
    }

    void introduce(const std::string& number, const CheckStep& step) {
        guide_.say("\n" + number + ": " + step.title + "\n" + step.meaning);
        const char* const question = "Enter = go on, s = skip, q = quit";
        if (step.needs == StepNeeds::replies_and_person) {
            desk_.wait_for(question);
        } else {
            desk_.begin(question);
        }
    }

    CheckGuide& guide_;
    CheckedFalcon falcon_;
    CheckDesk desk_;
    CheckRecord record_;
    std::string fault_{};
    bool over_{false};
};

}  // namespace

CheckResult run_check(const CheckOptions& options, CheckGuide& guide) {
    return Check(options, guide).run();
}

}  // namespace dibhr::falcon
