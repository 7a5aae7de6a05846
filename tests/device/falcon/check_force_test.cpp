// Force during a check: when it acts, how it rises, and that it ends.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "tests/device/falcon/check_bench.hpp"
#include "tests/device/time/simulated_time.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::test::falcon;
using Catch::Matchers::WithinAbs;
using dibhr::test::let_pass;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using Request = CheckConsole::Request;

}  // namespace

TEST_CASE("a force is gone at once, whatever ends it", "[check]") {
    struct Ending {
        const char* name;
        void (*happens)(Checked&);
        Request request;
        const char* told;
    };
    const auto ending = GENERATE(
        Ending{"a key", [](Checked&) {}, Request::release, "because a key was pressed"},
        Ending{"q", [](Checked&) {}, Request::quit, ""},
        Ending{"the grip leaves its place",
               [](Checked& check) {
                   check.unit.with([](FalconModel& model) {
                       model.board().hand().place({0.0, 0.031, 0.150});
                   });
               },
               Request::none, "moved more than 30 mm"},
        Ending{"homing is lost", [](Checked& check) { start_firmware(check.unit); }, Request::none,
               "not homed any more"},
        Ending{"no replies", [](Checked& check) { check.unit.set_faults({.dropped_replies = 8}); },
               Request::none, "a reply was late"});
    Checked check;
    CAPTURE(ending.name);
    check.only("Force on a kitchen scale");
    check.options.times.hold = milliseconds(500);
    int wishes = 0;
    std::uint64_t with_force = 0;
    check.person.wish_under_force = [&] {
        // Well after the ramp.
        constexpr int kLate = 60;
        if (++wishes < kLate) return Request::none;
        if (wishes == kLate) {
            with_force = log_of(check.unit).with_force;
            ending.happens(check);
        }
        return ending.request;
    };
    CommandLog after;
    check.person.after_force = [&] {
        if (after.commands == 0) after = log_of(check.unit);
        check.person.instead = [](const std::string&) { return "q"; };
    };
    CHECK(check.run().fault.empty());
    CHECK(wishes <= 63);
    CHECK(after.with_force > 0);
    CHECK(after.with_force <= with_force + 3);  // 8 ms apart, until 20 ms have passed
    CHECK(after.zeros_in_a_row >= 5);
    CHECK(holds(check.person.heard, ending.told));
}

TEST_CASE("a cable that is pulled under force ends the check, and the record tells it", "[check]") {
    Checked check;
    check.only("Force on a kitchen scale");
    int wishes = 0;
    check.person.wish_under_force = [&] {
        if (++wishes == 10) UsbBench::pull_cable(check.unit);
        return Request::none;
    };
    CHECK(holds(check.run().fault, "was unplugged"));
    CHECK(check.end_of(6) == "failed");
    check.bus.unplug(check.unit);
}

TEST_CASE(
    "a force rises and falls within half a second each, even when the program stalls, and is "
    "held for 3 s at most",
    "[check]") {
    Checked check;
    check.only("Force on a kitchen scale");
    check.options.times.ramp = dibhr::falcon::CheckTimes{}.ramp;
    check.options.times.hold = std::chrono::seconds(10);
    std::optional<Clock::time_point> begin;
    Clock::time_point end;
    int wishes = 0;
    int steepest_rise = 0;
    int steepest_fall = 0;
    int last = 0;
    check.person.wish_under_force = [&] {
        if (!begin) begin = Clock::now();
        constexpr int kInTheRamp = 50;
        if (++wishes == kInTheRamp) let_pass(milliseconds(60));
        const auto motors =
            check.unit.with([](FalconModel& model) { return model.board().motors(); });
        int largest = 0;
        for (const int motor : motors) largest = std::max(largest, std::abs(motor));
        steepest_rise = std::max(steepest_rise, largest - last);
        steepest_fall = std::max(steepest_fall, last - largest);
        last = largest;
        return Request::none;
    };
    check.person.after_force = [&] {
        end = Clock::now();
        check.person.instead = [](const std::string&) { return "q"; };
    };
    CHECK(check.run().fault.empty());
    CHECK(log_of(check.unit).largest == 500);
    // 5 counts in the 5 ms that a step covers at most, and the rounding.
    CHECK(steepest_rise <= 6);
    CHECK(steepest_fall <= 6);
    // Of the 60 ms in which nothing was sent the ramp takes 5.
    const std::chrono::duration<double> took = end - begin.value();
    CHECK_THAT(took.count(), WithinAbs(4.055, 0.02));
}

TEST_CASE("no force begins by Enter alone", "[check]") {
    const std::string title =
        GENERATE(as<std::string>(), "The force after the last packet", "Force on a kitchen scale");
    const bool at_step = GENERATE(true, false);  // else at the force itself
    CAPTURE(title, at_step);
    Checked check;
    check.only(title);
    const auto usual = check.person.instead;
    int enters = 0;
    check.person.instead = [&](const std::string& question) -> std::optional<std::string> {
        const auto as_usual = usual(question);
        if (as_usual == "s" || !holds(question, "F and Enter")) return as_usual;
        if (!at_step && holds(question, "begin with force")) return "f";
        return ++enters > 3 ? "s" : "";
    };
    CHECK(check.run().fault.empty());
    CHECK(enters == 4);
    CHECK(log_of(check.unit).with_force == 0);
}

TEST_CASE("all its force is for a person who types yes", "[check]") {
    const std::string answer = GENERATE("", "y", "YES please");
    Checked check;
    check.only("Force on a kitchen scale");
    const auto usual = check.person.instead;
    check.person.instead = [&](const std::string& question) -> std::optional<std::string> {
        if (holds(question, "Type yes")) return answer;
        return usual(question);
    };
    CHECK(check.run().fault.empty());
    CHECK(log_of(check.unit).largest == 2000);
    CHECK(holds(check.found("torque-scale"), "up to 2000 counts"));
}

TEST_CASE("a scale that shows nothing leaves the torque scale open", "[check]") {
    const bool always = GENERATE(true, false);  // else under the weakest force alone
    CAPTURE(always);
    Checked check;
    check.only("Force on a kitchen scale");
    const auto usual = check.person.instead;
    int asked = 0;
    check.person.instead = [&](const std::string& question) -> std::optional<std::string> {
        const bool reads = holds(question, "What did the scale show");
        if (reads && (++asked == 1 || always)) return "0";
        return usual(question);
    };
    CHECK(check.run().fault.empty());
    CHECK(asked == 4);
    CHECK_THAT(check.number("$.steps[6].measured.\"500_counts\".scale_g"), WithinAbs(0.0, 1e-12));
    CHECK_FALSE(
        holds(check.value("$.steps[6].measured.\"500_counts\""), "\"counts_per_newton_metre\""));
    CHECK(check.found("torque-scale").empty() == always);
    CHECK(check.setting("counts-per-newton-metre").empty() == always);
}

TEST_CASE("without homing there is no force", "[check]") {
    Checked check;
    check.only("Force on a kitchen scale");
    start_firmware(check.unit);  // not homed any more
    const auto usual = check.person.instead;
    check.person.instead = [&](const std::string& question) -> std::optional<std::string> {
        if (holds(question, "Pull the grip all the way out")) return "s";
        return usual(question);
    };
    CHECK(check.run().fault.empty());
    CHECK(check.end_of(6) == "skipped");
    CHECK(log_of(check.unit).with_force == 0);
}

TEST_CASE("what is left of a force after its last packet is measured by the encoders", "[check]") {
    const bool stays = GENERATE(false, true);
    CAPTURE(stays);
    Checked check;
    check.only("The force after the last packet");
    check.options.times.short_hold = check.options.times.sample = milliseconds(300);
    check.options.times.silences = {milliseconds(10), milliseconds(400)};
    check.unit.with(
        [&](FalconModel& model) { model.board().hold_commands(milliseconds(stays ? 0 : 150)); });
    CHECK(check.run().fault.empty());
    const char* const left = ".part_of_the_force_left";
    CHECK_THAT(check.number("$.steps[5].measured.\"after 10 ms\"" + std::string(left)),
               WithinAbs(1.0, 0.1));
    CHECK_THAT(check.number("$.steps[5].measured.\"after 400 ms\"" + std::string(left)),
               WithinAbs(stays ? 1.0 : 0.0, 0.1));
}
