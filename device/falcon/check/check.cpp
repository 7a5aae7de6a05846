// Leads through the steps of the check, and keeps the record.
#include "device/falcon/check/check.hpp"

#include <array>
#include <string>

#include "device/falcon/check/desk.hpp"
#include "device/falcon/check/record.hpp"
#include "device/hand/check/run.hpp"

namespace dibhr::falcon {

namespace {

/// What a step needs to make sense.
enum class Needs { nothing, replies, replies_and_person, replies_and_force };

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
         Needs::replies_and_force, check_silence},
    Step{"torque-scale", "Force on a kitchen scale",
         "FORCE, from weak to the strongest there is: the grip presses down on the scale for "
         "at most 3 s each time, and you type the grams. The scale stands as before, on "
         "something that does not give way; hands and hair away.",
         Needs::replies_and_force, check_force},
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
          desk_(guide, falcon_, options),
          record_(options.record, checked_device(falcon_.attached()), options.facts) {}

    CheckResult run() {
        guide_.say("Checks " + full_name_of(falcon_.attached()) + "; the record is " +
                   record_.file().string() + ", written again after every step.");
        if (const std::string fault = falcon_.unguarded(); !fault.empty()) guide_.say(fault);
        CheckRun run(desk_, record_, desk_.findings, kSteps.size(), [this] { falcon_.let_go(); });
        for (const Step& step : kSteps) {
            run.step(
                {step.name, step.title, step.meaning, whom(step.needs)},
                [&] { return why_not(step); }, [&](Json& measured) { step.run(desk_, measured); });
        }
        falcon_.let_go();
        guide_.say(desk_.findings.summary() + "The record: " + record_.file().string());
        return {record_.file(), run.fault()};
    }

  private:
    static StepNeeds whom(Needs needs) {
        return needs == Needs::replies_and_force    ? StepNeeds::person_for_force
               : needs == Needs::replies_and_person ? StepNeeds::person
                                                    : StepNeeds::nobody;
    }

    /// Why the step makes no sense; empty: it does.
    std::string why_not(const Step& step) {
        const bool can = step.needs == Needs::nothing || falcon_.answering() || falcon_.answers();
        return can ? std::string{} : "the Falcon gives no replies";
    }

    CheckGuide& guide_;
    CheckedFalcon falcon_;
    CheckDesk desk_;
    CheckRecord record_;
};

}  // namespace

CheckResult run_check(const CheckOptions& options, CheckGuide& guide) {
    return Check(options, guide).run();
}

}  // namespace dibhr::falcon
