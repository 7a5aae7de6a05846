// `dibhr experiment` as people and scripts use it, and what it refuses.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/settings/command_options.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// The error of a wrong command line.
std::string usage_error(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "experiment");
    try {
        run_command_line(arguments);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "nothing";
}

}  // namespace

TEST_CASE("experiment circle prints the paper's table and writes JSON and pictures",
          "[experiment]") {
    const TemporaryFolder folder;
    const ProgramResult result = run_dibhr(
        folder, {"experiment", "circle", "--json", "numbers.json", "--plots", "pictures"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    // No bar without a terminal; a busy machine adds one line.
    CHECK((result.errors.empty() ||
           result.errors.starts_with("dibhr: warning: other programs had the processor")));
    for (const char* part : {"207.31", "0.528 (0)", "exact answer", "god-object", "mu 0.4"}) {
        CAPTURE(part);
        CHECK(contains(result.output, part));
    }
    const std::string json = read_text(folder / "numbers.json");
    CHECK(contains(json, "\"path\": \"circle\""));
    CHECK(contains(json, "\"algorithm\": \"neighborhood\""));
    CHECK(std::filesystem::file_size(folder / "pictures/paths-circle.png") > 0);
}

TEST_CASE("experiment runs the algorithms, friction and depth it is given", "[experiment]") {
    const TemporaryFolder folder;
    const ProgramResult result =
        run_dibhr(folder, {"experiment", "linear", "--mu", "0.8", "--depth", "5", "--algorithm",
                           "dibhr", "--algorithm", "pga", "--json", "-"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(result.output.starts_with("{"));
    CHECK(contains(result.output, "\"mu\": 0.8"));
    CHECK(contains(result.output, "\"depth_px\": 5"));
    CHECK(contains(result.output, "\"algorithm\": \"pga\""));
    CHECK_FALSE(contains(result.output, "\"algorithm\": \"neighborhood\""));
    CHECK_FALSE(contains(result.output, "Time of an update"));
}

TEST_CASE("experiment writes its pictures in the formats that are asked for", "[experiment]") {
    const TemporaryFolder folder;
    const ProgramResult result =
        run_dibhr(folder, {"experiment", "linear", "--algorithm", "dibhr", "--plots", "pictures",
                           "--plot-format", "svg,pdf"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const std::string svg = read_text(folder / "pictures/force-linear.svg");
    CHECK(svg.starts_with("<?xml"));
    CHECK(contains(svg, ">How the force turned: linear</text>"));
    CHECK(read_text(folder / "pictures/force-linear.pdf").starts_with("%PDF"));
    CHECK_FALSE(std::filesystem::exists(folder / "pictures/force-linear.png"));
}

TEST_CASE("an unknown path, algorithm or format is refused with the choices", "[experiment]") {
    CHECK(contains(usage_error({"--plot-format", "gif"}), "png, svg, pdf"));
    CHECK(contains(usage_error({"--plot-format", "png,gif"}), "'gif' is none of"));
    CHECK(contains(usage_error({"--plot-format", "svg"}), "--plots"));
    CHECK(contains(usage_error({"square"}), "linear, circle, human, all, sweep"));
    CHECK(contains(usage_error({"--algorithm", "magic"}), "dibhr, pga, neighborhood, god-object"));
    const TemporaryFolder folder;
    const ProgramResult result = run_dibhr(folder, {"experiment", "square"});
    CHECK(result.exit_code == 2);
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
}

TEST_CASE("options that do not go together are refused", "[experiment]") {
    const std::vector<std::vector<std::string>> wrong{
        {"circle", "linear"},
        {"linear", "--trace", "pen.csv"},
        {"sweep", "--session", "hand.dibhr"},
        {"human", "--trace", "pen.csv", "--session", "hand.dibhr"},
        {"sweep", "--mu", "0.4"},
        {"sweep", "--depth", "20"},
        {"circle", "--mu", "-1"},
        {"circle", "--mu", "nan"},
        {"circle", "--depth", "0"},
        {"circle", "--depth", "deep"},
    };
    for (const auto& arguments : wrong) {
        const std::string words = usage_error(arguments);
        INFO(words);
        CHECK(words != "nothing");
        CHECK(contains(words, "--help"));
        CHECK_FALSE(contains(words, "\n"));
    }
}

TEST_CASE("a hand or an output that cannot be used ends with 1 and one line", "[experiment]") {
    const TemporaryFolder folder;
    write_text(folder / "nan.csv", "t,x,y\n0,1,2\n1,nan,2\n");
    write_text(folder / "column.csv", "t,x\n0,1\n1,2\n");
    write_text(folder / "row.csv", "t,x,y\n0,1,2\n");
    write_text(folder / "text.dibhr", "this is no session\n");
    write_text(folder / "empty.dibhr", "");
    write_moving_hand(folder / "none.dibhr", 0);
    write_moving_hand(folder / "foreign.dibhr", 50, 240);
    const auto before = names_in(folder.path());
    const std::vector<std::vector<std::string>> bad{
        {"human", "--trace", "nan.csv"},         {"human", "--trace", "column.csv"},
        {"human", "--trace", "row.csv"},         {"human", "--trace", "missing.csv"},
        {"human", "--session", "text.dibhr"},    {"human", "--session", "empty.dibhr"},
        {"human", "--session", "none.dibhr"},    {"human", "--session", "foreign.dibhr"},
        {"human", "--session", "missing.dibhr"}, {"circle", "--json", "none/out.json"},
        {"circle", "--plots", "nan.csv"},        {"circle", "--plots", "nan.csv/deeper"},
    };
    for (std::vector<std::string> arguments : bad) {
        const std::string named = arguments.back();
        arguments.insert(arguments.begin(), "experiment");
        if (arguments[2] != "--json") {
            arguments.insert(arguments.end(), {"--json", "out.json"});
            if (arguments[2] != "--plots") {
                arguments.insert(arguments.end(), {"--plots", "pictures"});
            }
        }
        const ProgramResult result = run_dibhr(folder, arguments);
        INFO(named << ": " << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(result.output.empty());
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        CHECK(contains(result.errors, named));
        CHECK(names_in(folder.path()) == before);  // nothing half-written
    }
}
