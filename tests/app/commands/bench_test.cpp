// `dibhr bench` as people and scripts use it: no row may be lost.
#include <set>
#include <string>
#include <vector>

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

/// With spaces as they come, each one alone.
std::string squeezed(const std::string& text) {
    std::string squeezed;
    for (const char letter : text) {
        if (letter != ' ' || squeezed.empty() || squeezed.back() != ' ') squeezed += letter;
    }
    return squeezed;
}

}  // namespace

TEST_CASE("bench times every algorithm on every ground, for people and for scripts", "[bench]") {
    const TemporaryFolder folder;
    const ProgramResult result = run_dibhr(folder, {"bench", "--json", "numbers.json"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const Json json = Json::parse(read_text(folder / "numbers.json"));

    std::vector<std::string> algorithms;
    for (const Algorithm algorithm : all_algorithms()) algorithms.emplace_back(name_of(algorithm));

    // The keys of 0.1, which scripts read.
    CHECK(json.at("mu").get<double>() == 0.4);
    CHECK(json.at("depth_px").get<double>() == 20.0);
    CHECK(json.at("clock_us").get<double>() > 0.0);
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
    CHECK(json.at("handover").at("cleaning").at("median_ms").get<double>() > 0.0);
    CHECK(json.at("loops").at("haptic").at("ticks").get<int>() > 1000);

    CHECK(names_in(json.at("grounds"), "path") == kRows);
    for (const Json& row : json.at("grounds")) {
        CAPTURE(row.dump());
        const Json& costs = row.at("algorithms");
        REQUIRE(algorithms_in(costs) == algorithms);
        // Where the sample's frames jump, a person's outline leaves the proxy half an image behind.
        if (row.at("ground") != "sample") CHECK(costs[0].at("bounds_met") == 0);
        for (const Json& cost : costs) {
            CHECK(cost.at("update_ns").get<double>() > 0.0);
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

    CHECK(names_in(json.at("jumps"), "jump") == kJumps);
    for (const Json& row : json.at("jumps")) {
        CAPTURE(row.dump());
        REQUIRE(algorithms_in(row.at("algorithms")) == algorithms);
        for (const Json& jump : row.at("algorithms")) {
            CHECK(jump.at("slowest_update").at("max_us") >= jump.at("first_update").at("max_us"));
            CHECK(jump.at("updates_to_catch_up").get<int>() > 1);
            CHECK(jump.at("updates_to_catch_up").get<int>() < 1000);
        }
    }

    const std::string table = squeezed(result.output);
    for (const std::string& row : kRows) {
        CAPTURE(row);
        CHECK(contains(table, row + " "));
    }
    for (const std::string& row : kJumps) {
        CAPTURE(row);
        CHECK(contains(table, row + " "));
    }
    for (const char* part : {"the paper linear 720x486 4.35", "the paper circle 720x486 4.37",
                             "dibhr : pga", "1 kHz loops"}) {
        CAPTURE(part);
        CHECK(contains(table, part));
    }
}
