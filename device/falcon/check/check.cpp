// Leads through the steps of the check, and keeps the record.
#include "device/falcon/check/check.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include "device/falcon/check/desk.hpp"
#include "device/falcon/check/record.hpp"

namespace dibhr::falcon {

namespace {

using Clock = std::chrono::steady_clock;

/// What a step needs to make sense.
enum class Needs { nothing, replies, replies_and_person };

struct Step {
    const char* name;     ///< in the record
    const char* title;    ///< for people
    const char* meaning;  ///< what will happen, and what the person does
    Needs needs;
    void (*run)(CheckDesk& desk, Json& measured);
};

constexpr std::array kSteps{
    Step{"descriptors", "What the Falcon says it is",
         "Reads what lsusb -v would show. Nothing moves; you need do nothing.", Needs::nothing,
         check_identity},
    Step{"upload", "Firmware",
         "Asks whether firmware is there, then loads it at both speeds that are reported to "
         "work. The motors are off meanwhile, and homing is lost. Keep the 30 V adapter "
         "plugged in.",
         Needs::nothing, check_upload},
    Step{"rate", "Reply rate",
         "Exchanges packets without force as fast as they come, with and without the event "
         "character. Some seconds each; nothing moves.",
         Needs::replies, check_rate},
    Step{"homing-bit", "Homing",
         "Homes the Falcon with your help, then clears the homing bit for a moment to see "
         "whether homing survives. No force. Let the grip hang when it is homed.",
         Needs::replies_and_person, check_homing},
    Step{"end-stops", "End stops and lengths",
         "You hold the grip at its ends, and move it along a ruler. No force. Have a ruler at "
         "hand.",
         Needs::replies_and_person, check_stops},
    Step{"after-last-packet", "The force after the last packet",
         "FORCE, a weak one: the grip presses down on a kitchen scale while the program "
         "falls silent. Put the scale under the grip, on books, so that the ball rests on it "
         "at about half its height; keep hands and hair away; then set the scale to zero.",
         Needs::replies_and_person, check_silence},
    Step{"torque-scale", "Force on a kitchen scale",
         "FORCE, from weak to the strongest there is: the grip presses down on the scale for "
         "at most 3 s each time, and you type the grams. The scale stands as before, on "
         "something that does not give way; hands and hair away.",
         Needs::replies_and_person, check_force},
    Step{"buttons", "Buttons",
         "You press the four buttons of the grip, one after the other. No force.",
         Needs::replies_and_person, check_buttons},
    Step{"plugs", "Cables",
         "You unplug the USB cable and plug it in again, then the power adapter. No force. "
         "Homing and firmware may be lost.",
         Needs::replies_and_person, check_plugs},
};

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
        if (const std::string fault = falcon_.unguarded(); !fault.empty()) guide_.say(fault);
        record_.write(desk_.findings);  // before the work: an unwritable file is told at once
        for (std::size_t k = 0; k < kSteps.size(); ++k) {
            run_step(std::to_string(k + 1) + " of " + std::to_string(kSteps.size()), kSteps.at(k));
        }
        falcon_.let_go();
        guide_.say(desk_.findings.summary() + "The record: " + record_.file().string());
        return {record_.file(), fault_};
    }

  private:
    void run_step(const std::string& number, const Step& step) {
        const auto begin = Clock::now();
        Json measured = Json::object();
        std::string remark;
        const StepEnd end = over_ ? StepEnd::not_begun : guarded(number, step, measured, remark);
        over_ = over_ || end == StepEnd::quit || end == StepEnd::failed;
        if (over_) falcon_.let_go();
        const std::chrono::duration<double> took = Clock::now() - begin;
        record_.add(step.name, end, remark, took.count(), measured);
        record_.write(desk_.findings);
    }

    StepEnd guarded(const std::string& number, const Step& step, Json& measured,
                    std::string& remark) {
        try {
            if (step.needs != Needs::nothing && !falcon_.answering() && !falcon_.answers()) {
                remark = "the Falcon gives no replies";
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

    void introduce(const std::string& number, const Step& step) {
        guide_.say("\n" + number + ": " + step.title + "\n" + step.meaning);
        const char* const question = "Enter = go on, s = skip, q = quit";
        if (step.needs == Needs::replies_and_person) {
            desk_.word(question);
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
