// Every form that people bring depth in is felt right, or the opening asks, or it is refused with a
// way. DIBHR_ZOO_REPORT=FILE has the table of all written there.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "tests/core/video/zoo/judge.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using zoo::Outcome;
using zoo::Verdict;

namespace {

constexpr double kLeastRight = 0.85;

zoo::Forms all_forms() {
    zoo::Forms all;
    for (const auto& forms :
         {zoo::forms_of_datasets(), zoo::forms_of_devices(), zoo::forms_of_estimators(),
          zoo::forms_of_numbers(), zoo::forms_of_heights(), zoo::forms_of_videos()})
        all.insert(all.end(), forms.begin(), forms.end());
    return all;
}

/// Opened once for all cases.
const std::vector<Verdict>& verdicts() {
    static const std::vector<Verdict> all = [] {
        std::vector<Verdict> judged;
        for (const zoo::Form& form : all_forms()) judged.push_back(zoo::judge(form));
        return judged;
    }();
    return all;
}

std::size_t count_of(Outcome outcome) {
    return static_cast<std::size_t>(
        std::count_if(verdicts().begin(), verdicts().end(),
                      [=](const Verdict& verdict) { return verdict.outcome == outcome; }));
}

std::string cell(double number, int digits) {
    return std::isfinite(number) ? number_text(number, digits) : "";
}

std::string row_of(const Verdict& verdict) {
    std::string remark = verdict.remark;
    std::replace(remark.begin(), remark.end(), '|', '/');
    return "| " + verdict.form + " | " + zoo::name_of(verdict.outcome) + " | " +
           cell(verdict.correlation, 4) + " | " + cell(verdict.bend_pct, 1) + " | " +
           cell(verdict.scale_pct, 2) + " | " + cell(verdict.timing_frames, 2) + " | " + remark +
           " |\n";
}

/// A page of Markdown.
std::string report() {
    std::string page = "# Forms of depth\n\n" + std::to_string(verdicts().size()) + " forms: ";
    for (const Outcome outcome : {Outcome::right, Outcome::asked, Outcome::refused, Outcome::wrong})
        page += (outcome == Outcome::right ? "" : ", ") + std::to_string(count_of(outcome)) + " " +
                zoo::name_of(outcome);
    page +=
        ".\n\n| form | outcome | rank correlation | bend [%] | scale error [%] | timing error "
        "[frames] | remark |\n| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const Verdict& verdict : verdicts()) page += row_of(verdict);
    return page;
}

}  // namespace

TEST_CASE("no form is opened silently wrong", "[zoo]") {
    if (const char* const file = std::getenv("DIBHR_ZOO_REPORT")) write_text(file, report());
    std::string lines;
    for (const Verdict& verdict : verdicts())
        if (verdict.outcome == Outcome::wrong) lines += verdict.form + ": " + verdict.remark + "\n";
    INFO(lines);
    CHECK(count_of(Outcome::wrong) == 0);
}

TEST_CASE("most forms are felt right without asking", "[zoo]") {
    CHECK(static_cast<double>(count_of(Outcome::right)) >=
          kLeastRight * static_cast<double>(verdicts().size()));
}

TEST_CASE("the zoo holds each form once", "[zoo]") {
    std::set<std::string> names;
    for (const zoo::Form& form : all_forms()) {
        CAPTURE(form.name);
        CHECK(names.insert(form.name).second);
    }
    CHECK(names.size() >= 100);
}
