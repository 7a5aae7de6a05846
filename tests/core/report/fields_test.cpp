// A value that a report describes stands in its JSON, its CSV and its table.
#include <limits>
#include <string>
#include <vector>

#include "core/report/fields.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

Fields described(double value) {
    Fields row;
    row.plain("who", "a \"b\" <c>", "person");
    row.plain("count", 12, "trials");
    row.fixed({"/force/mean", "mean_newton"}, value, 3, "mean [N]");
    row.significant({"/force/peak", "peak_newton"}, value, 2, "peak [N]");
    row.add("right", true);
    row.add("choice", nullptr);
    row.add({"/in_json", ""}, 1);
    row.add({"", "in_csv"}, 2);
    row.show("both", "1&nbsp;of&nbsp;2");
    return row;
}

}  // namespace

TEST_CASE("each value that is described is in JSON, CSV and the table, once and in order",
          "[report]") {
    const Fields row = described(0.25);
    CHECK(json_line(row.json) ==
          R"({"who":"a \"b\" <c>","count":12,"force":{"mean":0.25,"peak":0.25},"right":true,)"
          R"("choice":null,"in_json":1})");
    CHECK(row.csv_head == "who,count,mean_newton,peak_newton,right,choice,in_csv");
    CHECK(row.csv_line == "\"a \"\"b\"\" <c>\",12,0.25,0.25,1,,2");
    CHECK(row.heads == Cells{"person", "trials", "mean [N]", "peak [N]", "both"});
    CHECK(row.cells ==
          Cells{"a &quot;b&quot; &lt;c&gt;", "12", "0.250", "0.25", "1&nbsp;of&nbsp;2"});
}

TEST_CASE("a table has its heads once, a row for each thing, and is none without a thing",
          "[report]") {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const std::string table = table_of(std::vector<double>{0.5, unknown}, described);
    CHECK(table ==
          table_of(described(0.5).heads, {described(0.5).cells, described(unknown).cells}));
    CHECK(described(unknown).cells.at(3) == "&ndash;");
    CHECK(table_of(std::vector<double>{}, described).empty());
}
