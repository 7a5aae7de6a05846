// The steps of the check, and what a person is told of each before it begins.
#include "device/falcon/check/steps.hpp"

#include <array>

namespace dibhr::falcon {

namespace {

constexpr std::array kSteps{
    CheckStep{"descriptors", "What the Falcon says it is",
              "Reads what lsusb -v would show. Nothing moves; you need do nothing.",
              StepNeeds::nothing, check_identity},
    CheckStep{"upload", "Firmware",
              "Asks whether firmware is there, then loads it at both speeds that are reported to "
              "work. The motors are off meanwhile, and homing is lost. Keep the 30 V adapter "
              "plugged in.",
              StepNeeds::nothing, check_upload},
    CheckStep{"rate", "Reply rate",
              "Exchanges packets without force as fast as they come, with and without the event "
              "character. Some seconds each; nothing moves.",
              StepNeeds::replies, check_rate},
    CheckStep{"homing-bit", "Homing",
              "Homes the Falcon with your help, then clears the homing bit for a moment to see "
              "whether homing survives. No force. Let the grip hang when it is homed.",
              StepNeeds::replies_and_person, check_homing},
    CheckStep{"end-stops", "End stops and lengths",
              "You hold the grip at its ends, and move it along a ruler. No force. Have a ruler at "
              "hand.",
              StepNeeds::replies_and_person, check_stops},
    CheckStep{"after-last-packet", "The force after the last packet",
              "FORCE, a weak one: the grip presses down on a kitchen scale while the program "
              "falls silent. Put the scale under the grip, on books, so that the ball rests on it "
              "at about half its height; keep hands and hair away; then set the scale to zero.",
              StepNeeds::replies_and_person, check_silence},
    CheckStep{"torque-scale", "Force on a kitchen scale",
              "FORCE, from weak to the strongest there is: the grip presses down on the scale for "
              "at most 3 s each time, and you type the grams. The scale stands as before, on "
              "something that does not give way; hands and hair away.",
              StepNeeds::replies_and_person, check_force},
    CheckStep{"buttons", "Buttons",
              "You press the four buttons of the grip, one after the other. No force.",
              StepNeeds::replies_and_person, check_buttons},
    CheckStep{"plugs", "Cables",
              "You unplug the USB cable and plug it in again, then the power adapter. No force. "
              "Homing and firmware may be lost.",
              StepNeeds::replies_and_person, check_plugs},
};

}  // namespace

std::span<const CheckStep> check_steps() noexcept {
    return kSteps;
}

}  // namespace dibhr::falcon
