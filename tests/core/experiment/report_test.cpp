// The report: the paper beside ours, in aligned tables and in JSON.
#include <string>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/experiment/report.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using dibhr::test::contains;

namespace {

std::vector<PathRun> short_runs() {
    std::vector<PathRun> paths{linear_path(0.4, 20.0, 400), circle_path(0.4, 20.0, 400)};
    for (PathRun& path : paths) {
        run_algorithms(path, paper_plane(), all_algorithms(), Timing::careful);
    }
    return paths;
}

/// Every bracket closed, every quote a pair: the minimum that a reader of JSON needs.
bool is_balanced(const std::string& json) {
    std::string open;
    bool in_text = false;
    for (std::size_t k = 0; k < json.size(); ++k) {
        const char c = json[k];
        if (c == '"' && (k == 0 || json[k - 1] != '\\')) in_text = !in_text;
        if (in_text) continue;
        if (c == '{' || c == '[') open += c;
        if (c == '}' || c == ']') {
            if (open.empty() || open.back() != (c == '}' ? '{' : '[')) return false;
            open.pop_back();
        }
    }
    return open.empty() && !in_text;
}

std::size_t times_in(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

}  // namespace

TEST_CASE("the paper's table has its nine entries and none for the god-object", "[report]") {
    int entries = 0;
    for (const char* path : {"linear", "circle", "human"}) {
        for (const Algorithm algorithm : all_algorithms()) {
            if (paper_result(path, algorithm)) ++entries;
        }
        CHECK_FALSE(paper_result(path, Algorithm::god_object));
    }
    CHECK(entries == 9);
    CHECK(paper_result("circle", Algorithm::dibhr)->variation_mean_deg == 0.53);
}

TEST_CASE("the table says mu, depth, source, the clock's cost and the paper's numbers",
          "[report]") {
    const std::string table = table_of(short_runs(), 0.025);
    for (const char* part : {"mu 0.4", "depth 20 px", "4961 px/s", "0.025 us", "188.61", "47.40",
                             "0.528 (0)", "exact answer", "god-object", "max px"}) {
        CHECK(contains(table, part));
    }
    CHECK(times_in(table, "  dibhr ") == 4);
}

TEST_CASE("no line of the tables is wider than a terminal of 110 columns", "[report]") {
    const SweepRange range{{0.4}, {20.0}, 300};
    for (const std::string& text : {table_of(short_runs(), 0.025),
                                    sweep_table_of(run_sweep(range, all_algorithms()), 0.025)}) {
        for (std::size_t begin = 0; begin < text.size();) {
            const auto end = text.find('\n', begin);
            REQUIRE(end != std::string::npos);
            INFO(text.substr(begin, end - begin));
            CHECK(end - begin <= 110);
            begin = end + 1;
        }
    }
}

TEST_CASE("the JSON holds every path and algorithm under names that stay", "[report]") {
    auto paths = short_runs();
    paths[0].source = "a \"quoted\"\nname \\ ";
    const std::string json = json_of(paths, 0.025);
    INFO(json);
    CHECK(is_balanced(json));
    CHECK(times_in(json, "\"algorithm\": ") == 2 * all_algorithms().size());
    for (const char* name : {"clock_us",
                             "path",
                             "source",
                             "mu",
                             "depth_px",
                             "updates",
                             "reversal_updates",
                             "settling_updates",
                             "exact_variation_deg",
                             "time_us",
                             "whole_run",
                             "whole_update",
                             "waited_share",
                             "p999",
                             "moves_per_update",
                             "bounds_met",
                             "variation_deg",
                             "mean_without_reversals",
                             "max_rad",
                             "contact_updates",
                             "paper"}) {
        CHECK(contains(json, "\"" + std::string(name) + "\": "));
    }
    CHECK(contains(json, "a \\\"quoted\\\"\\nname \\\\ "));
}

TEST_CASE("the sweep's JSON holds every point and where nothing is rougher than DIBHR",
          "[report]") {
    const SweepRange range{{0.4}, {5.0, 20.0}, 300};
    const auto points = run_sweep(range, all_algorithms());
    const std::string json = sweep_json_of(points, range.updates, 0.025);
    CHECK(is_balanced(json));
    CHECK(times_in(json, "\"median_us\": ") == points.size());
    CHECK(contains(json, "\"not_rougher_than_dibhr\": ["));
    CHECK(contains(sweep_table_of(points, 0.025), "rougher"));
}
