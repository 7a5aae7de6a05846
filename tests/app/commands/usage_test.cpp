// The command line itself: commands, options, help, and what is refused.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/settings/command_options.hpp"
#include "core/haptics/parameters.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

std::vector<std::string> touch_with(std::vector<std::string> options) {
    options.insert(options.begin(), {"touch", "--depth", "depth.png", "--goals", "goals.csv"});
    return options;
}

void write_inputs(const TemporaryFolder& folder) {
    write_depth_png(folder / "depth.png", 16, 12, 100);
    write_text(folder / "goals.csv", "t,x,y,z\n0,5,5,120\n0.001,5,5,90\n0.002,8,5,90\n");
}

/// Column px of the last row: how far friction let the proxy follow the goal.
std::string last_column(const ProgramResult& result, std::size_t column) {
    const std::vector<std::string> lines = split(result.output, '\n');
    REQUIRE(lines.size() == 5);
    return split(lines[3], ',').at(column);
}

}  // namespace

TEST_CASE("bad usage is refused in one line before anything is done", "[usage]") {
    const std::vector<std::vector<std::string>> wrong{
        {"touch"},
        {"touch", "--depth", "depth.png"},
        {"info"},
        {"devices", "all"},
        {"view", "a", "b", "c"},
        {"--nonsense"},
        {"view", "none.mp4", "--size", "1280"},
        {"view", "none.mp4", "--size", "1280x"},
        {"view", "none.mp4", "--size", "x800"},
        {"view", "none.mp4", "--size", "1280x800 "},
        {"view", "none.mp4", "--size", "0x0"},
        {"view", "none.mp4", "--size", "99999x99999"},
        {"view", "none.mp4", "--seconds", "-1"},
        {"view", "none.mp4", "--seconds", "soon"},
        {"view", "none.mp4", "--start", "-1"},
        {"view", "none.mp4", "--start", "3", "--end", "3"},
        {"view", "none.mp4", "--speed", "0"},
        {"view", "none.mp4", "--speed", "5"},
        {"view", "none.mp4", "--loop", "yes"},
        {"view", "none.mp4", "--device", "joystick"},
        {"view", "none.mp4", "--device", "goals:"},
        {"view", "none.mp4", "--device", "falcon:"},
        {"view", "none.mp4", "--firmware"},
        {"devices", "--firmware"},
        touch_with({"extra"}),
        touch_with({"--algorithm", "magic"}),
        touch_with({"--algorithm", "PGA"}),
        touch_with({"--friction", "-0.1"}),
        touch_with({"--friction", "nan"}),
        touch_with({"--friction", "inf"}),
        touch_with({"--friction", "0.4x"}),
        touch_with({"--friction", ""}),
        touch_with({"--friction"}),
        touch_with({"--friction", "0.1", "--friction", "0.2"}),
        touch_with({"--damping-cutoff", "-1"}),
        touch_with({"--damping-cutoff", "801"}),
        touch_with({"--damping-cutoff", "nan"}),
        touch_with({"--damping-cutoff", "50Hz"}),
        touch_with({"--damping-cutoff"}),
        touch_with({"--intrinsics", "200deg"}),
        touch_with({"--intrinsics", "60degrees"}),
        touch_with({"--static-friction", "0.2", "--dynamic-friction", "0.3"}),
        touch_with({"--friction", "0.2", "--dynamic-friction", "0.3"}),
    };
    for (const auto& arguments : wrong) {
        std::string line;
        for (const std::string& argument : arguments) line += argument + ' ';
        INFO(line);
        CHECK_THROWS_AS(run_command_line(arguments), UsageError);
        try {
            run_command_line(arguments);
        } catch (const UsageError& error) {
            const std::string words = error.what();
            INFO(words);
            CHECK(words.find("--") != std::string::npos);
            CHECK(words.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("bad usage ends with 2 and one line on stderr", "[usage]") {
    const TemporaryFolder folder;
    const ProgramResult result = run_dibhr(folder, touch_with({"--algorithm", "magic"}));
    CHECK(result.exit_code == 2);
    CHECK(result.output.empty());
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    CHECK(result.errors.find("god-object") != std::string::npos);
}

TEST_CASE("every number is an option with a range, beyond which it is refused", "[usage]") {
    const TemporaryFolder folder;
    const std::string touch_help = run_dibhr(folder, {"touch", "--help"}).output;
    const std::string view_help = run_dibhr(folder, {"view", "--help"}).output;
    for (const TouchNumber& option : touch_numbers()) {
        const std::string name = "--" + std::string(option.name);
        INFO(name);
        const std::string above = std::to_string(option.highest + 1.0);
        const std::string below = std::to_string(option.lowest - 1.0);
        CHECK_THROWS_AS(run_command_line(touch_with({name, above})), UsageError);
        CHECK_THROWS_AS(run_command_line(touch_with({name, below})), UsageError);
        CHECK(touch_help.find(name) != std::string::npos);
        CHECK(view_help.find(name) != std::string::npos);
    }
}

TEST_CASE("numbers start inside their ranges and are brought back into them", "[usage]") {
    TouchParameters high;
    TouchParameters low;
    TouchParameters broken;
    for (const TouchNumber& option : touch_numbers()) {
        TouchParameters defaults;
        INFO(option.name);
        CHECK(option.lowest <= option.in(defaults));
        CHECK(option.in(defaults) <= option.highest);
        option.in(high) = option.highest + 1.0;
        option.in(low) = option.lowest - 1.0;
        option.in(broken) = std::nan("");
    }
    keep_in_range(high);
    keep_in_range(low);
    keep_in_range(broken);
    CHECK(broken == TouchParameters{});
    for (const TouchNumber& option : touch_numbers()) {
        INFO(option.name);
        CHECK(option.in(high) <= option.highest);
        CHECK(option.in(low) >= option.lowest);
    }
    TouchParameters slippery;
    slippery.friction = {0.3, 0.6};
    keep_in_range(slippery);
    CHECK(slippery.friction == Friction{0.3, 0.3});
}

TEST_CASE("--friction sets both coefficients, and one given by itself wins", "[usage]") {
    const TemporaryFolder folder;
    write_inputs(folder);
    const auto proxy_x = [&folder](const std::vector<std::string>& options) {
        std::vector<std::string> raw{"--raw-depth"};
        raw.insert(raw.end(), options.begin(), options.end());
        const ProgramResult result = run_dibhr(folder, touch_with(raw));
        REQUIRE(result.exit_code == 0);
        return std::stod(last_column(result, 4));
    };
    // The goal lies 10 px deep and moves 3 px: a coefficient of 0.2 lets the proxy follow to 2 px
    // behind it.
    using Catch::Matchers::WithinAbs;
    CHECK_THAT(proxy_x({"--friction", "0"}), WithinAbs(8.0, 1e-9));
    CHECK_THAT(proxy_x({"--friction", "0.2"}), WithinAbs(6.0, 1e-9));
    CHECK_THAT(proxy_x({"--friction", "0.2", "--static-friction", "0.5"}), WithinAbs(5.0, 1e-9));
    CHECK_THAT(proxy_x({"--static-friction", "0.5", "--friction", "0.2"}), WithinAbs(5.0, 1e-9));
    CHECK_THAT(proxy_x({"--static-friction", "0.1"}), WithinAbs(7.0, 1e-9));
}

TEST_CASE("help and version answer on standard output", "[usage]") {
    const TemporaryFolder folder;
    const ProgramResult help = run_dibhr(folder, {"--help"});
    CHECK(help.exit_code == 0);
    CHECK(help.errors.empty());
    for (const std::string command : {"view", "touch", "surface", "clip", "prepare", "depth",
                                      "study", "info", "devices", "bench"}) {
        INFO(command);
        CHECK(help.output.find(command) != std::string::npos);
        const ProgramResult its_help = run_dibhr(folder, {command, "--help"});
        CHECK(its_help.exit_code == 0);
        CHECK(its_help.output.find("dibhr " + command) != std::string::npos);
    }
    const ProgramResult version = run_dibhr(folder, {"--version"});
    CHECK(version.exit_code == 0);
    CHECK(version.output.starts_with("dibhr "));
    CHECK(run_dibhr(folder, {"-V"}).output == version.output);
    CHECK(run_dibhr(folder, {"help"}).output == help.output);
    CHECK(run_dibhr(folder, {"help", "touch"}).output ==
          run_dibhr(folder, {"touch", "--help"}).output);
    CHECK(run_dibhr(folder, {"help", "nothing"}).exit_code == 2);
}

TEST_CASE("all options that a command needs and was not given are named at once", "[usage]") {
    const TemporaryFolder folder;
    const ProgramResult touch = run_dibhr(folder, {"touch"});
    CHECK(touch.exit_code == 2);
    CHECK(contains(touch.errors, "--depth and --goals are required (see dibhr touch --help)"));
    CHECK(contains(run_dibhr(folder, {"touch", "--depth", "a.png"}).errors, "--goals is required"));
}

TEST_CASE("export explains every column, and the codes of a cut", "[usage]") {
    const TemporaryFolder folder;
    const std::string help = run_dibhr(folder, {"export", "--help"}).output;
    for (const std::string column :
         {"gx", "cz", "lets_go", "stand_in", "cut", "pair", "source", "ox", "utc_s", "lateness_us"})
        CHECK(contains(help, "\n  " + column + " "));
    CHECK(contains(help, "why the force was cut: 0 not cut, 1 not finite, 2 force off, "));
}

TEST_CASE("app/prepare says how it is used, and which presets there are", "[usage]") {
    const TemporaryFolder folder;
    const auto said = [&folder](const std::string& words) {
        run_shell(folder, "{ '" DIBHR_SOURCE_DIR "/app/prepare' " + words +
                              " >said 2>&1; echo $? >>said; } </dev/null");
        return read_text(folder / "said");
    };
    const std::string usage =
        "usage: app/prepare PRESET [TARGET...]\nPRESET is one of: release dev ";
    CHECK(said("").starts_with(usage));
    CHECK(said("").ends_with("\n2\n"));
    CHECK(said("--help").starts_with(usage));
    CHECK(said("--help").ends_with("\n0\n"));
    CHECK(said("relaese").starts_with("dibhr: there is no preset 'relaese'; one of: release dev "));
}

TEST_CASE("app/run takes no command for the viewer but view", "[usage]") {
    const TemporaryFolder folder;
    const std::string script = read_text(DIBHR_RUN_SCRIPT);
    std::istringstream help(run_dibhr(folder, {"--help"}).output);
    int commands = 0;
    for (std::string line; std::getline(help, line) && !line.starts_with("Examples");) {
        std::istringstream words(line);
        std::string program, command;
        words >> program >> command;
        if (program != "dibhr" || command == "[view]" || command.starts_with("-")) continue;
        CAPTURE(command);
        ++commands;
        CHECK((script.find(" " + command + " |") != std::string::npos ||
               script.find(" " + command + ")") != std::string::npos));
        // Nor does what it takes run into what it does.
        if (command != "help" && command != "completion")
            CHECK(line.find("  ", line.find(command)) != std::string::npos);
    }
    CHECK(commands > 10);
}

TEST_CASE("the help of every command ends with examples of it", "[usage]") {
    for (const std::string command :
         {"view", "touch", "surface", "clip", "depth", "experiment", "replay", "export", "report",
          "archive", "study", "info", "devices", "bench"}) {
        CAPTURE(command);
        const TemporaryFolder folder;
        const std::string help = run_dibhr(folder, {"help", command}).output;
        const std::size_t examples = help.find("\nExamples:\n");
        REQUIRE(examples != std::string::npos);
        CHECK(help.find("  dibhr " + (command == "view" ? "" : command), examples) !=
              std::string::npos);
    }
}

TEST_CASE("headings and errors are coloured at a terminal only, and not with NO_COLOR", "[usage]") {
    const TemporaryFolder folder;
    const auto said = [&](const std::vector<std::string>& environment) {
        return run_dibhr_at_terminal(folder, {"help", "bench"}, environment) +
               run_dibhr_at_terminal(folder, {"info", "none.mp4"}, environment);
    };
    const std::string coloured = said({"TERM=xterm", "NO_COLOR="});
    CHECK(contains(coloured, "\x1b[1mExamples:\x1b[0m"));
    CHECK(contains(coloured, "\x1b[1mUsage:\x1b[0m dibhr bench"));
    CHECK(contains(coloured, "\x1b[1;31mdibhr:\x1b[0m 'none.mp4'"));
    for (const std::vector<std::string>& environment :
         {std::vector<std::string>{"TERM=xterm", "NO_COLOR=1"}, {"TERM=dumb", "NO_COLOR="}}) {
        const std::string plain = said(environment);
        CHECK(contains(plain, "Examples:"));
        CHECK(contains(plain, "dibhr: 'none.mp4'"));
        CHECK_FALSE(contains(plain, "\x1b"));
    }
    const std::string piped = run_dibhr(folder, {"help", "bench"}).output +
                              run_dibhr(folder, {"info", "none.mp4"}).errors;
    CHECK(contains(piped, "dibhr: 'none.mp4'"));
    CHECK_FALSE(contains(piped, "\x1b"));
}

TEST_CASE("a mistyped command or option is told what it may have meant", "[usage]") {
    const auto said = [](const std::vector<std::string>& arguments) -> std::string {
        try {
            run_command_line(arguments);
        } catch (const UsageError& error) {
            return error.what();
        }
        return {};
    };
    CHECK(contains(said({"tuoch"}), "; did you mean touch?"));
    CHECK(contains(said(touch_with({"--algorithm", "dibr"})), "god-object; did you mean dibhr?"));
    CHECK(contains(said({"help", "replya"}), "; did you mean replay?"));
    CHECK(contains(said(touch_with({"--frictoin", "0.2"})), "; did you mean --friction?"));
    CHECK(contains(said({"touch", "--frictoin", "0.2"}), "there is no option --frictoin"));
    CHECK(contains(said(touch_with({"--stifness=1"})), "; did you mean --stiffness?"));
    CHECK(contains(said({"view", "none.mp4", "--scrennshot", "a.png"}),
                   "; did you mean --screenshot?"));
    CHECK_FALSE(contains(said({"zzzzzz"}), "did you mean"));
    CHECK_FALSE(contains(said(touch_with({"--qqqq"})), "did you mean"));
}

TEST_CASE("a file that is called like a command is reachable through view", "[usage]") {
    const TemporaryFolder folder;
    write_text(folder / "info", "this is no video\n");
    const ProgramResult result = run_dibhr(folder, {"view", "info", "info"});
    INFO(result.errors);
    CHECK(result.exit_code == 1);
    CHECK(result.errors.find("info") != std::string::npos);
    CHECK(run_dibhr(folder, {"info"}).exit_code == 2);
}

TEST_CASE("a reader that had enough is no failure", "[usage]") {
    const TemporaryFolder folder;
    write_inputs(folder);
    const std::string program = DIBHR_PROGRAM;
    run_shell(folder,
              "{ '" + program +
                  "' touch --depth depth.png --goals goals.csv 2>errors; echo $? >code; } | true");
    // A reader that ended before anything is written.
    run_shell(folder, "mkfifo gone && exec 3<>gone 4>gone 3<&- && { '" + program +
                          "' --help >&4 2>>errors; echo $? >>code; }");
    CHECK(read_text(folder / "errors").empty());
    CHECK(read_text(folder / "code") == "0\n0\n");
}

TEST_CASE("the program starts without the libraries of videos, photos and plots", "[usage]") {
    const TemporaryFolder folder;
    run_shell(folder, "{ objdump -p '" DIBHR_PROGRAM "' | grep NEEDED > needed; }");
    const std::string needed = read_text(folder / "needed");
    CHECK(contains(needed, "libc.so"));
    for (const char* const library : {"libavformat", "libavcodec", "libswscale", "libheif",
                                      "libzip", "libcairo", "libpango", "libopencv_imgcodecs"})
        CHECK_FALSE(contains(needed, library));
}

TEST_CASE("standard output that cannot be written is a failure told in one line", "[usage]") {
    const TemporaryFolder folder;
    const std::string program = DIBHR_PROGRAM;
    run_shell(folder, "{ '" + program + "' --help >/dev/full 2>errors; echo $? >code; }");
    CHECK(read_text(folder / "code") == "1\n");
    CHECK(split(read_text(folder / "errors"), '\n').size() == 2);
}
