// Runs the steps of the check of an Inverse3, and keeps the record.
#include "device/inverse3/check/check.hpp"

#include <array>
#include <string>

#include "device/hand/check/run.hpp"
#include "device/inverse3/check/context.hpp"

namespace dibhr::inverse3 {

namespace {

using Step = DeviceStep<CheckContext>;

constexpr std::array kSteps{
    Step{{"service", "What the service says",
          "Keeps the service's own words about itself and its devices. Nothing moves; you need do "
          "nothing.",
          StepNeeds::nobody},
         check_service},
    Step{{"rate", "Exchanges a second",
          "Exchanges messages without force as fast as they come. Some seconds; nothing moves.",
          StepNeeds::nobody},
         check_rate},
    Step{{"moving", "Steps and workspace",
          "You move the grip about, slowly at first, then to every end that it has. No force.",
          StepNeeds::person},
         check_moving},
    Step{{"dialect", "The format of a force",
          "FORCE, a weak one of 0.5 N to the left, twice for less than a second. Hold the grip "
          "loosely in the middle of its reach; any key ends the force.",
          StepNeeds::person_for_force},
         check_dialect},
    Step{{"silence", "The force after the last message",
          "FORCE, 0.5 N to the left, while the program sends nothing for up to a second each time. "
          "Hold the grip loosely; any key ends the force.",
          StepNeeds::person_for_force},
         check_silence},
    Step{{"closing", "The force when its connection ends",
          "FORCE, 0.5 N to the left, three times, while the program breaks its connection off "
          "without a zero, as if it died, and connects anew, at last after 2 s. Hold the grip "
          "loosely, and count the seconds that it pulls the last time; any key ends the force.",
          StepNeeds::person_for_force},
         check_closing},
    Step{{"force", "Force on a kitchen scale",
          "FORCE, 1, 2, 3 and 4 N downwards for at most 3 s each: the grip presses on a kitchen "
          "scale, and you type the grams. Put the scale under the grip, on something that does not "
          "give way, and set it to zero; hands and hair away. Any key ends the force.",
          StepNeeds::person_for_force},
         check_force},
    Step{{"unplugged", "Unplugged and plugged in again",
          "You move the grip about, pull its USB cable out for some seconds, and plug it in again. "
          "No force.",
          StepNeeds::person},
         check_unplugged},
};

/// The head of the record.
Json about(const CheckedInverse3& device, const ConnectionOptions& connection) {
    Json head{{"simulated", device.is_simulated()},
              {"service_port", connection.port},
              {"older_port", connection.older_port},
              {"dialect_setting", connection.dialect ? name_of(*connection.dialect) : "automatic"},
              {"preset_asked", device.newer() ? Json(connection.preset.view()) : Json()}};
    head.update(reported_frame(device));
    return head;
}

}  // namespace

CheckResult run_check(const CheckOptions& options, CheckConsole& console) {
    CheckedInverse3 device(options.connection);
    CheckContext context(console, device, options);
    CheckRecord record(options.record, {"inverse3", "device_id", device.id()}, options.facts);
    console.print("Checks the Inverse3 " + device.id() + "; the record is " +
                  record.file().string() + ", written again after every step.");
    record.add_to_head(about(device, options.connection));
    record.set_legend(check_legend());
    if (device.is_simulated()) {
        console.print(
            "This is dibhr's own simulated service: nothing here is measured on a device.");
    }
    if (const std::string fault = device.unguarded(); !fault.empty()) console.print(fault);
    return run_steps(
        kSteps, context, record, [&] { device.release_force(); }, [] { return std::string{}; });
}

}  // namespace dibhr::inverse3
