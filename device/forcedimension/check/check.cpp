// Runs the steps of the check of a Force Dimension arm, and keeps the record.
#include "device/forcedimension/check/check.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <optional>
#include <string>
#include <thread>

#include "core/error.hpp"
#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "device/forcedimension/check/checked_arm.hpp"
#include "device/hand/check/numbers.hpp"
#include "device/hand/check/push.hpp"
#include "device/hand/check/run.hpp"

namespace dibhr::forcedimension {

namespace {

using Clock = CheckedArm::Clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr double kMetre_mm = 1000.0;
constexpr double kHeaviest_g = 2000.0;
constexpr Vec3 kDown{0.0, 0.0, -1.0};
constexpr double kWeak_newton = 0.5;
constexpr std::array kOnTheScale_newton{1.0, 2.0, 3.0, 4.0};  // the last is the viewer's own limit
constexpr std::array kAxes{"x", "y", "z"};
constexpr std::chrono::milliseconds kBetweenCalls{1};

enum class OpenQuestion : std::size_t { calls, step, workspace, axes, silence, force };
constexpr std::array<CheckQuestion, 6> kQuestions{{
    {"calls", "How long a call takes"},
    {"step", "Smallest step of the position"},
    {"workspace", "Workspace"},
    {"axes", "The axes right, up and towards the user"},
    {"silence", "The force without a call"},
    {"force", "Force at the grip"},
}};

struct CheckContext final : CheckQuestions {
    CheckContext(CheckConsole& person, CheckedArm& checked, const CheckOptions& chosen)
        : CheckQuestions(person), arm(checked), options(chosen) {}

    CheckedArm& arm;
    const CheckOptions& options;
    CheckFindings findings{kQuestions, "forcedimension"};

  private:
    void keep_alive() override {
        (void)arm.position_m();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
};

Json along_axes(Vec3 values) {
    return {{"x", values.x}, {"y", values.y}, {"z", values.z}};
}

/// Calls again and again for `span`; the times go into `measured`.
std::string time_calls(CheckContext& context, const char* name, Json& measured,
                       const std::function<void()>& call) {
    Sample took_ms;
    const auto begin = Clock::now();
    while (Clock::now() < begin + context.options.times.calls) {
        context.quit_if_interrupted();
        const auto asked = Clock::now();
        call();
        took_ms.add(Milliseconds(Clock::now() - asked).count());
    }
    const double per_s = static_cast<double>(took_ms.count()) /
                         std::chrono::duration<double>(Clock::now() - begin).count();
    measured[name] = {{"per_s", per_s},
                      {"ms_p50", took_ms.quantile(0.5)},
                      {"ms_p99", took_ms.quantile(0.99)},
                      {"ms_max", took_ms.most()}};
    return std::string(name) + " " + rate_in_words(per_s, took_ms);
}

void check_calls(CheckContext& context, Json& measured) {
    CheckedArm& arm = context.arm;
    const std::string words =
        time_calls(context, "position", measured, [&arm] { (void)arm.position_m(); }) + "; " +
        time_calls(context, "status", measured, [&arm] { (void)arm.status(); }) + "; " +
        time_calls(context, "buttons", measured, [&arm] { (void)arm.library().buttons(arm.id()); });
    context.console.print(words);
    context.findings.record_answer(OpenQuestion::calls, words);
}

void check_moving(CheckContext& context, Json& measured) {
    context.console.ask(
        "Move the grip slowly, then to every end; Enter when you have been everywhere. No force.");
    Vec3 lowest_mm{1e9};
    Vec3 highest_mm{-1e9};
    Sample steps_mm;
    std::optional<Vec3> last_mm;
    const auto limit = Clock::now() + context.options.times.moving;
    while (!context.answered() && Clock::now() < limit) {
        const Vec3 now_mm = context.arm.position_m() * kMetre_mm;
        lowest_mm = glm::min(lowest_mm, now_mm);
        highest_mm = glm::max(highest_mm, now_mm);
        for (int axis = 0; last_mm && axis < 3; ++axis) {
            const double step = std::abs(now_mm[axis] - (*last_mm)[axis]);
            if (step > 0.0) steps_mm.add(step);
        }
        last_mm = now_mm;
        std::this_thread::sleep_for(kBetweenCalls);
    }
    measured = {{"lowest_mm", along_axes(lowest_mm)},
                {"highest_mm", along_axes(highest_mm)},
                {"steps", steps_mm.count()},
                {"step_mm_p05", steps_mm.quantile(0.05)}};
    if (steps_mm.count() == 0) {
        context.console.print("The grip was not moved: its steps and its workspace stay open.");
        return;
    }
    const Vec3 size_mm = highest_mm - lowest_mm;
    context.findings.record_answer(OpenQuestion::step, number_text(steps_mm.quantile(0.05), 4) +
                                                           " mm (95 % of the steps are longer)");
    context.findings.record_answer(OpenQuestion::workspace, number_text(size_mm.x, 0) + " x " +
                                                                number_text(size_mm.y, 0) + " x " +
                                                                number_text(size_mm.z, 0) +
                                                                " mm (x, y, z) were reached");
}

/// "+y": the axis along which the way is longest.
std::string axis_of(Vec3 way) {
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(way[axis]) > std::abs(way[longest])) longest = axis;
    return (way[longest] < 0.0 ? "-" : "+") +
           std::string(kAxes.at(static_cast<std::size_t>(longest)));
}

void check_axes(CheckContext& context, Json& measured) {
    constexpr std::array kWays{std::pair{"right", "+y"}, std::pair{"up", "+z"},
                               std::pair{"towards you", "+x"}};
    std::string words;
    bool as_expected = true;
    for (const auto& [way, expected] : kWays) {
        const Vec3 from_m = context.arm.position_m();
        context.begin(std::string("Move the grip some centimetres ") + way + ", then Enter.");
        const Vec3 way_m = context.arm.position_m() - from_m;
        measured[way] = along_axes(way_m * kMetre_mm);
        words += (words.empty() ? "" : ", ") + std::string(way) + " is " + axis_of(way_m);
        as_expected = as_expected && axis_of(way_m) == expected;
    }
    words += as_expected ? ": as dibhr takes them" : ": NOT as dibhr takes them (+y, +z, +x)";
    context.console.print(words);
    context.findings.record_answer(OpenQuestion::axes, words);
}

/// A force on the grip; the destructor ends it.
class Push : public CheckPush {
  public:
    explicit Push(CheckContext& context)
        : CheckPush(context.console, [&context] { context.arm.release_force(); }),
          context_(context) {
        context.arm.switch_force_on();
    }

    /// Rises to the force and holds it for `hold`. Throws ForceReleased, PersonQuits, DeviceError.
    void hold(double newton, CheckTimes::Span hold) {
        const Milliseconds ramp = context_.options.times.ramp;
        const auto begin = Clock::now();
        while (Clock::now() < begin + context_.options.times.ramp + hold) {
            if (!may_continue()) throw ForceReleased{};
            const double part = std::min(1.0, Milliseconds(Clock::now() - begin) / ramp);
            context_.arm.set_force(part * newton * kDown);
            std::this_thread::sleep_for(kBetweenCalls);
        }
    }

  private:
    CheckContext& context_;
};

/// Whether the arm still has its force on after so long without a call.
ArmStatus status_after_silence(CheckContext& context, CheckTimes::Span silence) {
    Push push(context);
    push.hold(kWeak_newton, context.options.times.short_hold);
    if (!push.pause_sending(silence,
                            [](CheckPush::Time until) { std::this_thread::sleep_until(until); }))
        throw ForceReleased{};
    return context.arm.status();
}

void check_silence(CheckContext& context, Json& measured) {
    std::string words;
    for (const CheckTimes::Span silence : context.options.times.silences) {
        const ArmStatus status = status_after_silence(context, silence);
        const std::string time = std::to_string(silence.count());
        measured[time + "_ms"] = {{"force_on", status.force},
                                  {"cause", static_cast<int>(status.cause)}};
        words += (words.empty() ? "" : ", ") + std::string(status.force ? "on" : "off") +
                 " after " + time + " ms";
    }
    context.console.print("The force is " + words);
    context.findings.record_answer(OpenQuestion::silence, words);
}

void check_force(CheckContext& context, Json& measured) {
    std::string words;
    for (const double newton : kOnTheScale_newton) {
        context.agree_to_force(number_text(newton, 0) + " N downwards: F and Enter");
        {
            Push push(context);
            push.hold(newton, context.options.times.hold);
        }
        const auto grams = context.number("Grams on the scale", -kHeaviest_g, kHeaviest_g);
        if (!grams) continue;
        const double measured_newton = *grams / 1000.0 * kStandardGravity;
        measured[number_text(newton, 0) + "_newton"] = {{"grams", *grams},
                                                        {"newton", measured_newton}};
        words += (words.empty() ? "" : ", ") + number_text(newton, 0) + " N gave " +
                 number_text(measured_newton, 2) + " N";
    }
    if (!words.empty()) context.findings.record_answer(OpenQuestion::force, words);
}

using Step = DeviceStep<CheckContext>;

constexpr std::array kSteps{
    Step{
        {"calls", "How long a call takes",
         "Asks for position, status and buttons as fast as they come. Some seconds; nothing moves.",
         StepNeeds::nobody},
        check_calls},
    Step{{"moving", "Steps and workspace",
          "You move the grip about, slowly at first, then to every end that it has. No force.",
          StepNeeds::person},
         check_moving},
    Step{{"axes", "The axes", "You move the grip to the right, up, and towards you. No force.",
          StepNeeds::person},
         check_axes},
    Step{{"silence", "The force without a call",
          "FORCE, 0.5 N downwards, while the program is silent for up to 0.2 s each time. Hold the "
          "grip loosely in the middle of its reach; any key ends the force.",
          StepNeeds::person_for_force},
         check_silence},
    Step{{"force", "Force on a kitchen scale",
          "FORCE, 1, 2, 3 and 4 N downwards for at most 3 s each: the grip presses on a kitchen "
          "scale, and you type the grams. Put the scale under the grip, on something that does not "
          "give way, and set it to zero; hands and hair away. Any key ends the force.",
          StepNeeds::person_for_force},
         check_force},
};

Json about(const Status& found) {
    return {{"type", found.type},
            {"library", found.library},
            {"controller", found.controller_version ? Json(*found.controller_version) : Json()},
            {"watchdog_ms", found.watchdog_ms},
            {"library_limits_force", found.clamped}};
}

}  // namespace

CheckResult run_check(const CheckOptions& options, CheckConsole& console) {
    CheckedArm arm(options.connection);
    CheckContext context(console, arm, options);
    CheckRecord record(options.record, {"forcedimension", "serial", arm.found().serial},
                       options.facts);
    console.print("Checks " + name_of(arm.found()) + "; the record is " + record.file().string() +
                  ", written again after every step.");
    record.add_to_head(about(arm.found()));
    if (!arm.found().unguarded.empty()) console.print(arm.found().unguarded);
    return run_steps(
        kSteps, context, record, [&arm] { arm.release_force(); }, [] { return std::string{}; });
}

}  // namespace dibhr::forcedimension
