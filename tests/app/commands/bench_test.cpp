// `dibhr bench` as people and scripts use it: no row may be lost.
#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/bench_updates.hpp"
#include "core/files/json.hpp"
#include "core/haptics/parameters.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinRel;

namespace {

const std::vector<std::string> kRows{
    "bit-flat linear 720x486",   "bit-flat circle 720x486",  "bit-flat linear 7680x4320",
    "bit-flat circle 7680x4320", "near-flat linear 720x486", "near-flat circle 720x486",
    "bumpy linear 720x486",      "bumpy circle 720x486",     "bump map linear 720x486",
    "bump map circle 720x486",   "crease linear 7680x4320",  "sample linear 640x480",
    "sample circle 640x480"};
const std::vector<std::string> kJumps{"bit-flat contact 7680x4320", "bit-flat air 7680x4320",
                                      "crease crease 7680x4320"};

std::string size_in(const Json& row) {
    return std::to_string(row.at("columns").get<int>()) + "x" +
           std::to_string(row.at("rows").get<int>());
}

/// "bumpy circle 720x486" of each; `what`: path or jump.
std::vector<std::string> names_in(const Json& rows, const char* what) {
    std::vector<std::string> names;
    for (const Json& row : rows) {
        names.push_back(row.at("ground").get<std::string>() + " " +
                        row.at(what).get<std::string>() + " " + size_in(row));
    }
    return names;
}

std::vector<std::string> algorithms_in(const Json& rows) {
    std::vector<std::string> names;
    for (const Json& row : rows) names.push_back(row.at("algorithm").get<std::string>());
    return names;
}

/// The text with each run of spaces reduced to one space.
std::string squeezed(const std::string& text) {
    std::string squeezed;
    for (const char letter : text) {
        if (letter != ' ' || squeezed.empty() || squeezed.back() != ' ') squeezed += letter;
    }
    return squeezed;
}

std::vector<std::string> all_names() {
    std::vector<std::string> names;
    for (const Algorithm algorithm : all_algorithms()) names.emplace_back(name_of(algorithm));
    return names;
}

// The keys of 0.1, which scripts read.
void check_flat(const Json& json) {
    std::set<std::string> updates;
    for (const Json& row : json.at("updates")) {
        CHECK(row.at("median_us").get<double>() > 0.0);
        CHECK(row.at("p99_us") <= row.at("max_us"));
        CHECK(row.at("moves").get<double>() > 1.0);
        updates.insert(row.at("algorithm").get<std::string>() + " " +
                       row.at("path").get<std::string>() + " " + size_in(row));
    }
    CHECK(json.at("updates").size() == 16);
    CHECK(updates.size() == 16);
    REQUIRE(json.at("teleports").size() == 2);
    CHECK(json.at("teleports")[0].at("where") == "contact");
    CHECK(json.at("teleports")[1].at("where") == "air");
    for (const Json& row : json.at("teleports")) CHECK(row.at("samples") == 50);
}

void check_grounds(const Json& json) {
    CHECK(names_in(json.at("grounds"), "path") == kRows);
    for (const Json& row : json.at("grounds")) {
        CAPTURE(json_line(row));
        const Json& costs = row.at("algorithms");
        REQUIRE(algorithms_in(costs) == all_names());
        // Where the sample's frames jump, a person's outline leaves the proxy half an image behind.
        if (row.at("ground") != "sample") CHECK(costs[0].at("bounds_met") == 0);
        for (const Json& cost : costs) {
            CHECK(cost.at("update_ns").get<double>() > 0.0);
            CHECK(cost.at("whole_update_ns").get<double>() > 0.0);
            CHECK(cost.at("moves").get<double>() >= 1.0);
            CHECK_THAT(cost.at("move_ns").get<double>() * cost.at("moves").get<double>(),
                       WithinRel(cost.at("update_ns").get<double>(), 1e-12));
            CHECK(cost.at("single").at("p99_us") <= cost.at("single").at("max_us"));
        }
        CHECK_THAT(row.at("dibhr_to_pga").get<double>(),
                   WithinRel(costs[0].at("update_ns").get<double>() /
                                 costs[1].at("update_ns").get<double>(),
                             1e-12));
        CHECK(row.at("paper_dibhr_to_pga").get<double>() > 4.0);
    }
    CHECK(json.at("coplanar_crossing_ns").get<double>() > 0.0);
}

void check_jumps(const Json& json) {
    CHECK(names_in(json.at("jumps"), "jump") == kJumps);
    for (const Json& row : json.at("jumps")) {
        CAPTURE(json_line(row));
        REQUIRE(algorithms_in(row.at("algorithms")) == all_names());
        for (const Json& jump : row.at("algorithms")) {
            CHECK(jump.at("slowest_update").at("max_us") >= jump.at("first_update").at("max_us"));
            CHECK(jump.at("updates_to_catch_up").get<int>() > 1);
            CHECK(jump.at("updates_to_catch_up").get<int>() < 1000);
        }
    }
}

void check_table(const std::string& told) {
    const std::string table = squeezed(told);
    for (const std::vector<std::string>* const rows : {&kRows, &kJumps})
        for (const std::string& row : *rows) {
            CAPTURE(row);
            CHECK(contains(table, row + " "));
        }
    for (const char* part :
         {"the paper linear 720x486 4.35", "the paper circle 720x486 4.37", "dibhr : pga"}) {
        CAPTURE(part);
        CHECK(contains(table, part));
    }
}

/// "bumpy circle 720x486" in parts.
struct Named {
    std::string ground, what;
    int columns, rows;
};

Named parts_of(const std::string& row) {
    const std::size_t size = row.rfind(' ');
    const std::size_t what = row.rfind(' ', size - 1);
    const std::size_t by = row.find('x', size);
    return {row.substr(0, what), row.substr(what + 1, size - what - 1),
            std::stoi(row.substr(size + 1, by - size - 1)), std::stoi(row.substr(by + 1))};
}

/// Costs with made-up measurements.
UpdateCosts made_up_costs() {
    UpdateCosts costs{.clock_us = 0.02, .crossing_ns = 3.0};
    for (const std::string& row : kRows) {
        const Named name = parts_of(row);
        PathCost& path = costs.paths.emplace_back(
            PathCost{name.ground, name.what, name.columns, name.rows, 20.0});
        for (const Algorithm algorithm : all_algorithms())
            path.algorithms.push_back(
                {.algorithm = algorithm,
                 .time_us = statistics_of({0.1, 0.2, 0.3}),
                 .whole_run_us = 0.1 + 0.001 * static_cast<double>(path.algorithms.size()),
                 .whole_update_us = 0.2,
                 .moves_per_update = 3.0});
    }
    for (const std::string& row : kJumps) {
        const Named name = parts_of(row);
        JumpCost& jump =
            costs.jumps.emplace_back(JumpCost{name.ground, name.what, name.columns, name.rows});
        for (const Algorithm algorithm : all_algorithms())
            jump.algorithms.push_back({.algorithm = algorithm,
                                       .first_us = statistics_of(std::vector<double>(50, 1.0)),
                                       .slowest_us = statistics_of(std::vector<double>(50, 2.0)),
                                       .most_updates = 7});
    }
    return costs;
}

}  // namespace

TEST_CASE("what was measured of the algorithms is told whole, to people and to scripts",
          "[bench command]") {
    const UpdateCosts costs = made_up_costs();
    Json json;
    add_to_json(costs, json);
    check_flat(json);
    check_grounds(json);
    check_jumps(json);
    CHECK(json.at("coplanar_crossing_ns") == 3.0);
    CHECK(json.at("jumps")[0].at("algorithms")[0].at("updates_to_catch_up") == 7);
    check_table(table_of(costs));
}

TEST_CASE("bench times every algorithm on every ground, for people and for scripts",
          "[bench command][bench]") {
    const TemporaryFolder folder;
    const ProgramResult result = run_dibhr(folder, {"bench", "--json", "numbers.json"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const Json json = parsed_json(read_text(folder / "numbers.json"));
    CHECK(json.at("mu").get<double>() == 0.4);
    CHECK(json.at("depth_px").get<double>() == 20.0);
    CHECK(json.at("clock_us").get<double>() > 0.0);
    check_flat(json);
    check_grounds(json);
    check_jumps(json);
    CHECK(json.at("handover").at("cleaning").at("median_ms").get<double>() > 0.0);
    CHECK(json.at("loops").at("haptic").at("ticks").get<int>() > 0);
    check_table(result.output);
    CHECK(contains(result.output, "1 kHz loops"));
}
