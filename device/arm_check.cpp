// Runs the steps of the check of an arm, and keeps the record.
#include "device/arm_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "device/hand/check/numbers.hpp"
#include "device/hand/check/push.hpp"
#include "device/hand/check/run.hpp"

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr double kMetre_mm = 1000.0;
constexpr double kHeaviest_g = 2000.0;
constexpr double kMost_newton = 4.0;                     // of any arm: the viewer's own limit
constexpr std::array kOnTheScale{0.25, 0.5, 0.75, 1.0};  // parts of the greatest force
constexpr double kLeastWay_m = 0.01;
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
    CheckContext(CheckConsole& person, CheckedArm& checked, const ArmCheckTimes& chosen)
        : CheckQuestions(person), arm(checked), times(chosen) {}

    CheckedArm& arm;
    const ArmCheckTimes& times;
    CheckFindings findings{kQuestions, arm.kind()};

    [[nodiscard]] double most_newton() const { return std::min(kMost_newton, arm.most_newton()); }

  private:
    void keep_alive() override {
        (void)arm.position_m();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
};

Json along_axes(Vec3 values) {
    return {{"x", values.x}, {"y", values.y}, {"z", values.z}};
}

/// Calls again and again; the times go into `measured`.
std::string time_calls(CheckContext& context, const TimedCall& timed, Json& measured) {
    Sample took_ms;
    const auto begin = Clock::now();
    while (Clock::now() < begin + context.times.calls) {
        context.quit_if_interrupted();
        const auto asked = Clock::now();
        timed.call();
        took_ms.add(Milliseconds(Clock::now() - asked).count());
    }
    const double per_s = static_cast<double>(took_ms.count()) /
                         std::chrono::duration<double>(Clock::now() - begin).count();
    measured[timed.name] = {{"per_s", per_s},
                            {"ms_p50", took_ms.quantile(0.5)},
                            {"ms_p99", took_ms.quantile(0.99)},
                            {"ms_max", took_ms.most()}};
    return std::string(timed.name) + " " + rate_in_words(per_s, took_ms);
}

void check_calls(CheckContext& context, Json& measured) {
    std::string words;
    for (const TimedCall& timed : context.arm.calls())
        words += (words.empty() ? "" : "; ") + time_calls(context, timed, measured);
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
    const auto limit = Clock::now() + context.times.moving;
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
    constexpr std::array kWays{"right", "up", "towards you"};
    const std::array<const char*, 3> expected = context.arm.axes();
    std::string words;
    bool as_expected = true;
    for (std::size_t k = 0; k < kWays.size(); ++k) {
        const char* const way = kWays.at(k);
        const Vec3 from_m = context.arm.position_m();
        context.begin(std::string("Move the grip some centimetres ") + way + ", then Enter.");
        const Vec3 way_m = context.arm.position_m() - from_m;
        if (glm::length(way_m) < kLeastWay_m) {
            context.console.print("The grip was not moved: its axes stay open.");
            return;
        }
        measured[way] = along_axes(way_m * kMetre_mm);
        words += (words.empty() ? "" : ", ") + std::string(way) + " is " + axis_of(way_m);
        as_expected = as_expected && axis_of(way_m) == expected.at(k);
    }
    words += as_expected ? ": as dibhr takes them"
                         : std::string(": NOT as dibhr takes them (") + expected[0] + ", " +
                               expected[1] + ", " + expected[2] + ")";
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
    void hold(double newton, ArmCheckTimes::Span hold) {
        const Milliseconds ramp = context_.times.ramp;
        const auto begin = Clock::now();
        while (Clock::now() < begin + context_.times.ramp + hold) {
            if (!may_continue()) throw ForceReleased{};
            const double part = std::min(1.0, Milliseconds(Clock::now() - begin) / ramp);
            context_.arm.set_force(part * newton * context_.arm.down());
            std::this_thread::sleep_for(kBetweenCalls);
        }
    }

  private:
    CheckContext& context_;
};

/// Whether the force is still on after so long without a call; nothing: the arm does not tell.
std::optional<bool> force_after_silence(CheckContext& context, ArmCheckTimes::Span silence,
                                        Json& line) {
    Push push(context);
    push.hold(0.5 * std::min(1.0, context.most_newton()), context.times.short_hold);
    context.arm.fall_silent();
    if (!push.pause_sending(silence,
                            [](CheckPush::Time until) { std::this_thread::sleep_until(until); }))
        throw ForceReleased{};
    return context.arm.force_after(line);
}

void check_silence(CheckContext& context, Json& measured) {
    std::string words;
    for (const ArmCheckTimes::Span silence : context.times.silences) {
        const std::string time = std::to_string(silence.count());
        Json& line = measured[time + "_ms"] = Json::object();
        std::optional<bool> is_on = force_after_silence(context, silence, line);
        if (!is_on)
            is_on = context.yes_or_no("Did the grip push to the end, for " + time +
                                      " ms after its rise?");
        line["force_on"] = *is_on;
        words += (words.empty() ? "" : ", ") + std::string(*is_on ? "on" : "off") + " after " +
                 time + " ms";
    }
    context.console.print("The force is " + words);
    context.findings.record_answer(OpenQuestion::silence, words);
}

void check_force(CheckContext& context, Json& measured) {
    std::string words;
    for (const double part : kOnTheScale) {
        const double newton = part * context.most_newton();
        const std::string asked = number_text(newton, 2);
        context.agree_to_force(asked + " N downwards: F and Enter");
        {
            Push push(context);
            push.hold(newton, context.times.hold);
        }
        const auto grams = context.number("Grams on the scale", -kHeaviest_g, kHeaviest_g);
        if (!grams) continue;
        const double measured_newton = *grams / 1000.0 * kStandardGravity;
        measured[asked + "_newton"] = {{"grams", *grams}, {"newton", measured_newton}};
        words += (words.empty() ? "" : ", ") + asked + " N gave " +
                 number_text(measured_newton, 2) + " N";
    }
    if (!words.empty()) context.findings.record_answer(OpenQuestion::force, words);
}

using Step = DeviceStep<CheckContext>;

constexpr std::array kSteps{
    Step{{"calls", "How long a call takes",
          "Asks for the position and more as fast as it comes. Some seconds; nothing moves.",
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
          "FORCE, 0.5 N downwards at most, while the program is silent for less than a second each "
          "time. Hold the grip loosely in the middle of its reach; any key ends the force.",
          StepNeeds::person_for_force},
         check_silence},
    Step{{"force", "Force on a kitchen scale",
          "FORCE, downwards in four steps up to the arm's greatest, never above 4 N, at most 3 s "
          "each: the grip presses on a kitchen scale, and you type the grams. Put the scale under "
          "the grip, on something rigid, and set it to zero; hands and hair away. "
          "Any key ends the force.",
          StepNeeds::person_for_force},
         check_force},
};

}  // namespace

CheckResult check_arm(CheckedArm& arm, const CheckRecordOptions& options, CheckConsole& console,
                      const ArmCheckTimes& times) {
    CheckContext context(console, arm, times);
    CheckRecord record(options.record, {arm.kind(), "serial", arm.serial()}, options.facts);
    console.print("Checks " + arm.name() + "; the record is " + record.file().string() +
                  ", written again after every step.");
    record.add_to_head(arm.about());
    if (!arm.unguarded().empty()) console.print(arm.unguarded());
    return run_steps(
        kSteps, context, record, [&arm] { arm.release_force(); }, [] { return std::string{}; });
}

}  // namespace dibhr
