// The whole program touches with a simulated arm below the stand-in for a library of Force
// Dimension or 3D Systems, which it loads as it loads the maker's.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/haptics/safety.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/stall.hpp"
#include "tests/app/program/stand_in_arm.hpp"
#include "tests/app/program/strokes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

using Words = std::vector<std::string>;

constexpr std::chrono::seconds kPatience{60};  // only reached by a failure

std::string any_kind() {
    return GENERATE(as<std::string>{}, "forcedimension", "openhaptics");
}

/// The program on its display, recording.
class ArmScene {
  public:
    explicit ArmScene(const std::string& kind, Words arguments, const Words& host = {},
                      Desk own_desk = Desk())
        : desk(std::move(own_desk)),
          arm(make_stand_in(kind, folder)),
          viewer(start(std::move(arguments), host)) {
        viewer.wait_for_surface();
    }

    void wait_for_zero() const {
        REQUIRE(eventually([this] { return arm->newton() == 0.0; }, kPatience));
    }
    [[nodiscard]] std::vector<Row> rows() const { return read_session(folder / "hand.dibhr"); }

    const Desk desk;
    const TemporaryFolder folder{};
    const std::unique_ptr<StandInArm> arm;
    WindowProgram viewer;

  private:
    WindowProgram start(Words arguments, const Words& host) {
        arguments.insert(arguments.end(),
                         {"--device", arm->kind(), "--record", "hand.dibhr", "--size", "320x240"});
        return desk.start_viewer(folder, arguments, host);
    }
};

/// Makes something go wrong, or the program end.
void begin_fault(const ArmScene& at, const Stall& stall, const std::string& what) {
    if (what == "display") at.desk.stop();
    if (what == "display's end") at.desk.kill();
    if (what == "disk") stall.begin();
    if (what == "window") at.viewer.hang();
    for (const auto& [name, signal] : {std::pair{"SIGTERM", SIGTERM},
                                       {"SIGKILL", SIGKILL},
                                       {"SIGSEGV", SIGSEGV},
                                       {"SIGABRT", SIGABRT},
                                       {"SIGSTOP", SIGSTOP}})
        if (what == name) at.viewer.send(signal);
}

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::vector<std::string> lines_with(const std::string& text, const std::string& part) {
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (says(line, part)) found.push_back(line);
    return found;
}

/// One line on standard error, and an end with 1.
void check_refused(const ProgramResult& result, const std::string& begin, const std::string& part) {
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(result.errors.starts_with("dibhr: " + begin));
    CHECK(says(result.errors, part));
    CHECK(result.errors.find('\n') == result.errors.size() - 1);
}

}  // namespace

TEST_CASE(
    "the program presses and slides with an arm; its forces are those of dibhr touch, and the "
    "session replays to the same bits",
    "[makers_library][window]") {
    ArmScene at(any_kind(), {"--stability", "off", "--speed", "0.25", "--stiffness", "0.2"});
    CAPTURE(at.arm->kind());
    const auto is_enough = [](const Stroked& so_far) {
        return so_far.contacts > 800 && so_far.held_back > 100;
    };
    Stroked so_far;
    for (int strokes = 0; strokes < 20 && !is_enough(so_far); ++strokes) {
        at.arm->move_hand(0.0, -3.0, 50);
        at.arm->press();
        at.arm->move_hand(14.0, 7.0, 400);
        at.arm->move_hand(14.0, -30.0, 100);
        so_far = stroked(at.rows());
    }
    CHECK(is_enough(so_far));
    at.desk.press("key q");
    REQUIRE(at.viewer.wait() == 0);
    CHECK(read_text(at.folder / "errors.txt").empty());
    const auto rows = at.rows();
    CHECK(strongest(rows) <= SafetyLimits{}.max_force_newton + 1e-9);
    CHECK_THAT(worst_touched_again(rows), WithinAbs(0.0, 1e-12));
    require_same_bits(at.folder, at.folder / "hand.dibhr");
    CHECK(at.arm->wrong_calls() == 0);
    CHECK_FALSE(at.arm->is_open());
    CHECK_FALSE(at.arm->force_is_on());
}

TEST_CASE("however the program ends, the motors push nobody: stopped by it, or by the arm itself",
          "[makers_library][window]") {
    const std::string signal =
        GENERATE(as<std::string>{}, "SIGTERM", "SIGKILL", "SIGSEGV", "SIGABRT", "SIGSTOP");
    ArmScene at(any_kind(), {"--pause"});
    CAPTURE(signal, at.arm->kind());
    at.arm->press();
    begin_fault(at, Stall("none"), signal);
    at.wait_for_zero();
    if (signal == "SIGSTOP") at.viewer.send(SIGKILL);
    (void)at.viewer.wait();
    CHECK(at.arm->newton() == 0.0);
    CHECK(at.arm->is_open() == (signal != "SIGTERM"));
    CHECK(at.arm->wrong_calls() == 0);
}

TEST_CASE("an arm without a watchdog keeps the force of a program that is killed",
          "[makers_library][window]") {
    ArmScene at("openhaptics", {"--pause"});
    at.arm->set_watchdog(false);
    at.arm->press();
    at.viewer.send(SIGKILL);
    (void)at.viewer.wait();
    CHECK(at.arm->newton() > 0.6);  // nothing of dibhr is left that could end it
}

TEST_CASE("what stands still, or goes, takes the force off an arm while the program lives",
          "[makers_library][window][long]") {
    const std::string what =
        GENERATE(as<std::string>{}, "display", "display's end", "disk", "window");
    const Stall stall("hand.dibhr");
    const Words host = what == "disk" ? stall.host() : Words{};
    const bool display = what.starts_with("display");
    ArmScene at(any_kind(), {"--pause"}, host, display ? Desk::of_its_own() : Desk());
    CAPTURE(what, at.arm->kind());
    at.arm->set_watchdog(false);
    at.arm->press();
    begin_fault(at, stall, what);
    at.wait_for_zero();
    at.viewer.send(SIGTERM);
    (void)at.viewer.wait();
    CHECK(at.arm->newton() == 0.0);
    CHECK(at.arm->wrong_calls() == 0);
}

// Prints the table of SAFETY.md, when called by its name alone.
TEST_CASE("how long an arm still pushes, for every way out", "[makers_library][.]") {
    constexpr int kRuns = 11;
    const std::string what = GENERATE(as<std::string>{}, "SIGTERM", "SIGKILL", "SIGSEGV", "SIGABRT",
                                      "SIGSTOP", "display's end", "display", "disk", "window");
    const std::string kind = any_kind();
    std::vector<double> took_ms;
    while (took_ms.size() < kRuns) {
        const Stall stall("hand.dibhr");
        const bool display = what.starts_with("display");
        ArmScene at(kind, {"--pause"}, what == "disk" ? stall.host() : Words{},
                    display ? Desk::of_its_own() : Desk());
        at.arm->press();
        const auto begun = std::chrono::steady_clock::now();
        begin_fault(at, stall, what);
        while (at.arm->newton() > 0.0) std::this_thread::yield();
        took_ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun)
                .count());
        at.viewer.send(SIGKILL);
        (void)at.viewer.wait();
    }
    std::sort(took_ms.begin(), took_ms.end());
    std::cout << kind << ", " << what << ": " << took_ms[kRuns / 2] << " ms, at most "
              << took_ms.back() << " ms\n";
    CHECK(took_ms.front() >= 0.0);
}

TEST_CASE("dibhr devices tells of an arm with its next step", "[makers_library][devices]") {
    const TemporaryFolder folder;
    const auto arm = make_stand_in(any_kind(), folder);
    const bool omega = arm->kind() == std::string("forcedimension");
    const ProgramResult usable = run_dibhr(folder, {"devices"});
    INFO(usable.output << usable.errors);
    CHECK(usable.exit_code == 0);
    CHECK(usable.errors.empty());
    CHECK(says(usable.output, omega ? "omega.3 1234: usable, ready to touch"
                                    : "3D Systems Touch SIM-1: usable, ready to touch"));
    CHECK(says(usable.output, omega ? "version 3.17.6.0" : "library 3.4 stand-in"));
    const ProgramResult other =
        run_dibhr(folder, {"view", "--device", arm->kind() + std::string(":77")});
    check_refused(other, omega ? "no Force Dimension arm with serial 77" : "no Touch with the name",
                  "77");
    arm->occupy();
    check_refused(run_dibhr(folder, {"devices"}), omega ? "the Force" : "the Touch",
                  "end that one");
    CHECK(arm->wrong_calls() == 0);
    CHECK_FALSE(arm->force_is_on());
}

TEST_CASE("nobody agrees to an initialisation, and the arm does not move",
          "[makers_library][devices]") {
    const TemporaryFolder folder;
    const auto arm = make_stand_in("forcedimension", folder);
    arm->lose_position();
    check_refused(run_dibhr(folder, {"devices"}), "the omega.3 1234", "does not know its position");
    const ProgramResult asked = run_dibhr(folder, {"devices", "--initialise"});
    CHECK(asked.exit_code == 0);
    CHECK(says(asked.output, "keep hands"));
    CHECK(says(asked.output, "The arm has not moved."));
    CHECK_FALSE(arm->force_is_on());
    CHECK(arm->wrong_calls() == 0);
}

TEST_CASE("a library that cannot be used is one sentence, and the mouse touches",
          "[makers_library][devices]") {
    const auto [kind, file, title] = GENERATE(table<const char*, const char*, const char*>(
        {{"forcedimension", "libdrd.so.3", "Force Dimension: none usable, "},
         {"openhaptics", "libHD.so.3.4", "3D Systems Touch: none usable, "}}));
    const auto [fault, told_as] =
        GENERATE(table<std::string, std::string>({{"32-bit", "is a 32-bit library"},
                                                  {"a text", "is not a library"},
                                                  {"cut off", "is damaged"},
                                                  {"another maker's", "has no function"}}));
    const TemporaryFolder folder;
    const std::string library = (folder / file).string();
    const auto arm = make_stand_in(kind, folder, library);
    const bool of_omega = kind == std::string("forcedimension");
    std::filesystem::copy_file(of_omega ? STAND_IN_HD : STAND_IN_DRD, library);
    if (fault == "a text") write_text(library, "no library");
    if (fault == "cut off") std::filesystem::resize_file(library, 4000);
    if (fault == "32-bit") {
        std::fstream stream(library, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(4);
        stream.put(1);
    }
    // No arm is attached, and the mouse can be used.
    const ProgramResult listed = run_dibhr(folder, {"devices"});
    INFO(listed.output << listed.errors);
    CHECK(listed.exit_code == 0);
    CHECK(listed.errors.empty());
    const std::vector<std::string> told = lines_with(listed.output, library);
    REQUIRE(told.size() == 1);
    CHECK(told.front().starts_with(title));
    CHECK(says(told.front(), told_as));
    CHECK(says(told.front(), "install "));
    check_refused(run_dibhr(folder, {"view", "--device", kind}), library, told_as);
}

TEST_CASE("with no library, and with those that cannot be used, the mouse touches without a word",
          "[makers_library][window]") {
    const bool installed = GENERATE(false, true);
    const Desk desk;
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "config/dibhr");
    std::ofstream(folder / "config/dibhr/settings.toml") << "[window]\npanels-visible = false\n";
    for (const char* const kind : {"forcedimension", "openhaptics"}) {
        const std::string library = (folder / kind).string() + ".so";
        if (installed) write_text(library, "no library");
        if (installed) (void)make_stand_in(kind, folder, library);
    }
    const ProgramResult listed = run_dibhr(folder, {"devices"});
    CHECK(listed.exit_code == 0);
    CHECK(says(listed.output, "Force Dimension") == installed);
    CHECK(says(listed.output, "Touch") == installed);
    WindowProgram viewer = desk.start_viewer(folder, {"--pause", "--size", "320x240"});
    viewer.wait_for_surface();
    viewer.act("mousemove 160 120 mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.sent_newton > 0.1 && now.mouse_fallback; });
    desk.press("key q");
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt").empty());
}

TEST_CASE("a library that is too old is named with its version", "[makers_library][devices]") {
    const TemporaryFolder folder;
    const auto arm = make_stand_in("forcedimension", folder);
    arm->age_library();
    check_refused(run_dibhr(folder, {"view", "--device", "forcedimension"}), STAND_IN_DRD,
                  "is version 3.2.6, which is too old");
}

TEST_CASE("without a person the check of an arm measures what needs none, and pushes nobody",
          "[makers_library][devices][long]") {
    const TemporaryFolder folder;
    const auto arm = make_stand_in(any_kind(), folder);
    CAPTURE(arm->kind());
    const ProgramResult checked = run_dibhr(folder, {"devices", "--check", "--out", "check.json"});
    CAPTURE(checked.output, checked.errors);
    CHECK(checked.exit_code == 0);
    CHECK(says(checked.output, " a second (half within"));
    CHECK(says(read_text(folder / "check.json"), std::string("dibhr ") + arm->kind() + " check"));
    CHECK(arm->strongest_newton() == 0.0);
    CHECK(arm->wrong_calls() == 0);
    CHECK_FALSE(arm->is_open());
}

TEST_CASE("what a record has is played as a device", "[makers_library][devices][long]") {
    const TemporaryFolder folder;
    const auto arm = make_stand_in(any_kind(), folder);
    CAPTURE(arm->kind());
    const bool omega = arm->kind() == std::string("forcedimension");
    const std::string ready =
        omega ? "omega.3 1234: ready to touch" : "Touch SIM-1: ready to touch";
    const ProgramResult recorded = run_dibhr(folder, {"devices", "--record", "arm.txt"});
    CAPTURE(recorded.output, recorded.errors);
    CHECK(recorded.exit_code == 0);
    CHECK(says(recorded.output, ready));
    CHECK(arm->strongest_newton() == 0.0);
    arm->unplug();
    const ProgramResult played = run_dibhr(folder, {"devices", "--simulate", "arm.txt"});
    CAPTURE(played.output, played.errors);
    CHECK(played.exit_code == 0);
    CHECK(says(played.output, ready));
    write_text(folder / "other.txt", "no record");
    const ProgramResult other = run_dibhr(folder, {"devices", "--simulate", "other.txt"});
    CHECK(other.exit_code == 1);
    CHECK(says(other.errors, "other.txt is not a record of a device"));
}
