// `dibhr export` as a person runs it: every tick, one row, the contract's columns first.
#include <charconv>
#include <cstddef>
#include <string>
#include <vector>

#include "app/commands/output.hpp"
#include "core/session/session.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

double real_of(const std::string& cell) {
    double value = -1.0;
    std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return value;
}

}  // namespace

TEST_CASE("an export has every tick, the contract's columns first, every real to the last bit",
          "[export]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "hill_depth.png", 60, 40, 60, 2);
    write_depth_png(folder / "hill_color.png", 60, 40, 10, 1);
    record_session(folder / "mine.dibhr",
                   {.colour = folder / "hill_color.png", .depth = folder / "hill_depth.png"});
    const ProgramResult result = run_dibhr(folder, {"export", "mine.dibhr", "--csv", "mine.csv"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(result.output.starts_with("first tick (t = "));
    CHECK(contains(result.output, "drift of the wall clock on t: "));
    const auto lines = split(read_text(folder / "mine.csv"), '\n');
    REQUIRE(lines.size() == 1002);
    std::string contract(kOutputHeader);
    contract.back() = ',';
    CHECK(lines[0].starts_with(contract));
    const std::size_t columns = split(lines[0], ',').size();
    const Session session(folder / "mine.dibhr");
    Session::Ticks ticks(session);
    TickRecord tick;
    for (std::size_t k = 1; ticks.next(tick); ++k) {
        CAPTURE(k);
        const auto cells = split(lines.at(k), ',');
        REQUIRE(cells.size() == columns);
        REQUIRE(same_bits(real_of(cells[0]), tick.t_s));
        const auto real = [&](int cell) { return real_of(cells[static_cast<std::size_t>(cell)]); };
        for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(same_bits(real(1 + axis), tick.goal[axis]));
            REQUIRE(same_bits(real(4 + axis), tick.proxy[axis]));
            REQUIRE(same_bits(real(7 + axis), tick.spring_newton[axis]));
            REQUIRE(same_bits(real(10 + axis), tick.sent_newton[axis]));
        }
        REQUIRE(cells[13] == (tick.contact ? "1" : "0"));
        REQUIRE(cells[15] == std::to_string(tick.i));
    }
    const ProgramResult out = run_dibhr(folder, {"export", "mine.dibhr", "--csv", "-"});
    CHECK(out.exit_code == 0);
    CHECK(out.output == read_text(folder / "mine.csv"));
}

TEST_CASE("the Python of FORMAT.md reads the same ticks as an export, to the last bit",
          "[export]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "hill_depth.png", 60, 40, 60, 2);
    write_depth_png(folder / "hill_color.png", 60, 40, 10, 1);
    // Past the limits of the force, and without a surface at the end: every way to code a cell.
    record_session(folder / "mine.dibhr", {.colour = folder / "hill_color.png",
                                           .depth = folder / "hill_depth.png",
                                           .ticks_without_surface = 20,
                                           .jumps = true});
    REQUIRE(run_dibhr(folder, {"export", "mine.dibhr", "--csv", "mine.csv"}).exit_code == 0);
    const std::string script = "PYTHONDONTWRITEBYTECODE=1 python3 '" DIBHR_SOURCE_DIR
                               "/core/session/read_session.py' mine.dibhr python.csv >mine.json";
    run_shell(folder, script);
    CHECK(contains(read_text(folder / "mine.json"), R"({"key": "complete", "value": "1"})"));
    const auto exported = split(read_text(folder / "mine.csv"), '\n');
    const auto read = split(read_text(folder / "python.csv"), '\n');
    REQUIRE(exported.size() > 1000);
    REQUIRE(read.size() == exported.size());
    REQUIRE(read[0] == exported[0]);
    for (std::size_t k = 1; k + 1 < read.size(); ++k) {
        CAPTURE(k);
        const auto cells = split(read[k], ','), expected = split(exported[k], ',');
        REQUIRE(cells.size() == expected.size());
        for (std::size_t column = 0; column < cells.size(); ++column) {
            CAPTURE(column, cells[column], expected[column]);
            const bool same = cells[column] == expected[column] ||
                              (!cells[column].empty() && !expected[column].empty() &&
                               same_bits(real_of(cells[column]), real_of(expected[column])));
            REQUIRE(same);
        }
    }
}

TEST_CASE("an export says the wall time of its first tick, and the drift of the wall clock",
          "[export]") {
    const TemporaryFolder folder;
    run_shell(folder, "sqlite3 mine.dibhr \".read '" DIBHR_SOURCE_DIR
                      "/tests/data/sessions/schema_2_first.sql'\" 'DELETE FROM clock' "
                      "'INSERT INTO clock VALUES(1000000, 1795000000.5, 0, 0), "
                      "(5001000000, 1795000005.75, 0, 0)'");
    const ProgramResult result = run_dibhr(folder, {"export", "mine.dibhr", "--csv", "mine.csv"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(result.output ==
          "first tick (t = 0.001000 s): 2026-11-18 11:06:40 UTC, utc_s = 1795000000.500000\n"
          "drift of the wall clock on t: 250.000 ms in 5.0 s\n");
}

TEST_CASE("an export needs to be told where to write, and never writes over the session",
          "[export]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "hill_depth.png", 60, 40, 60, 2);
    write_depth_png(folder / "hill_color.png", 60, 40, 10, 1);
    record_session(folder / "mine.dibhr",
                   {.colour = folder / "hill_color.png", .depth = folder / "hill_depth.png"});
    const std::string before = read_text(folder / "mine.dibhr");
    CHECK(run_dibhr(folder, {"export", "mine.dibhr"}).exit_code == 2);
    const ProgramResult same = run_dibhr(folder, {"export", "mine.dibhr", "--csv", "mine.dibhr"});
    CHECK(same.exit_code == 1);
    CHECK(same.errors.find("is the session that is read") != std::string::npos);
    CHECK(run_dibhr(folder, {"export", "mine.dibhr", "--csv", "no/such/folder.csv"}).exit_code ==
          1);
    CHECK(read_text(folder / "mine.dibhr") == before);
}
