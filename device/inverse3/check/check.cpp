// Runs the steps of the check of an Inverse3, and keeps the record.
#include "device/inverse3/check/check.hpp"

#include <array>
#include <string>

#include "device/hand/check/run.hpp"
#include "device/inverse3/check/desk.hpp"

namespace dibhr::inverse3 {

namespace {

using Step = StepAt<CheckDesk>;

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
Json about(const CheckTalk& talk, const ConnectionOptions& connection) {
    Json head{{"simulated", talk.is_simulated()},
              {"service_port", connection.port},
              {"older_port", connection.older_port},
              {"dialect_setting", connection.dialect ? name_of(*connection.dialect) : "automatic"},
              {"preset_asked", talk.newer() ? Json(connection.preset.view()) : Json()}};
    head.update(told_frame(talk));
    return head;
}

}  // namespace

CheckResult run_check(const CheckOptions& options, CheckGuide& guide) {
    CheckTalk talk(options.connection);
    CheckDesk desk(guide, talk, options);
    CheckRecord record(options.record, {"inverse3", "device_id", talk.id()}, options.facts);
    guide.say("Checks the Inverse3 " + talk.id() + "; the record is " + record.file().string() +
              ", written again after every step.");
    record.tell(about(talk, options.connection));
    record.explain(check_legend());
    if (talk.is_simulated()) {
        guide.say("This is dibhr's own simulated service: nothing here is measured on a device.");
    }
    if (const std::string fault = talk.unguarded(); !fault.empty()) guide.say(fault);
    return run_steps(
        kSteps, desk, record, [&] { talk.let_go(); }, [] { return std::string{}; });
}

}  // namespace dibhr::inverse3
