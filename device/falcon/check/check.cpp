// Runs the steps of the check of a Falcon, and keeps the record.
#include "device/falcon/check/check.hpp"

#include <array>
#include <string>

#include "device/falcon/check/context.hpp"
#include "device/hand/check/run.hpp"

namespace dibhr::falcon {

namespace {

using Step = DeviceStep<CheckContext>;

constexpr std::array kSteps{
    Step{{"descriptors", "What the Falcon says it is",
          "Reads what lsusb -v would show. Nothing moves; you need do nothing.", StepNeeds::nobody},
         check_identity,
         false},
    Step{{"upload", "Firmware",
          "Asks whether firmware is there, then loads it at both speeds that are reported to "
          "work. The motors are off meanwhile, and homing is lost. Keep the 30 V adapter "
          "plugged in.",
          StepNeeds::nobody},
         check_upload,
         false},
    Step{{"rate", "Reply rate",
          "Exchanges packets without force as fast as they come, with and without the event "
          "character. Some seconds each; nothing moves.",
          StepNeeds::nobody},
         check_rate},
    Step{{"homing-bit", "Homing",
          "Homes the Falcon with your help, then clears the homing bit for a moment to see "
          "whether homing survives. No force. Let the grip hang when it is homed.",
          StepNeeds::person},
         check_homing},
    Step{{"end-stops", "End stops and lengths",
          "You hold the grip at its ends, and move it along a ruler. No force. Have a ruler at "
          "hand.",
          StepNeeds::person},
         check_stops},
    Step{{"after-last-packet", "The force after the last packet",
          "FORCE, a weak one: the grip presses down on a kitchen scale while the program sends "
          "nothing. Put the scale under the grip, on books, so that the ball rests on it at about "
          "half its height; keep hands and hair away; then set the scale to zero.",
          StepNeeds::person_for_force},
         check_silence},
    Step{{"torque-scale", "Force on a kitchen scale",
          "FORCE, from weak to the strongest there is: the grip presses down on the scale for "
          "at most 3 s each time, and you type the grams. The scale stands as before, on "
          "something that does not give way; hands and hair away.",
          StepNeeds::person_for_force},
         check_force},
    Step{{"buttons", "Buttons",
          "You press the four buttons of the grip, one after the other. No force.",
          StepNeeds::person},
         check_buttons},
    Step{{"plugs", "Cables",
          "You unplug the USB cable and plug it in again, then the power adapter. No force. "
          "Homing and firmware may be lost.",
          StepNeeds::person},
         check_plugs},
};

}  // namespace

CheckResult run_check(const CheckOptions& options, CheckConsole& console) {
    CheckedFalcon falcon(options.serial);
    CheckContext context(console, falcon, options);
    CheckRecord record(options.record, {"falcon", "serial", falcon.attached().serial},
                       options.facts);
    console.print("Checks " + full_name_of(falcon.attached()) + "; the record is " +
                  record.file().string() + ", written again after every step.");
    if (const std::string fault = falcon.unguarded(); !fault.empty()) console.print(fault);
    return run_steps(
        kSteps, context, record, [&] { falcon.release_force(); },
        [&] {
            const bool answers = falcon.answering() || falcon.answers();
            return answers ? std::string{} : std::string("the Falcon gives no replies");
        });
}

}  // namespace dibhr::falcon
