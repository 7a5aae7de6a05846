// The table of findings, and what is concluded from it.
#include "core/video/depth/findings.hpp"

#include <algorithm>
#include <vector>

#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

const DepthStatement kDark{.near = NearLevels::dark};
const DepthStatement kBright{.near = NearLevels::bright};
const DepthStatement kMillimetres{.unit = DepthUnit::mm, .scale = 1.0};
const DepthStatement kDisparity{.unit = DepthUnit::disparity};

Finding row(const DepthStatement& statement, double sureness,
            Evidence evidence = Evidence::numbers) {
    return {statement, evidence, sureness, "a reason"};
}

double share_of_dark(const Findings& findings) {
    double share = 0.0;
    for (const DepthHypothesis& kind : weigh(findings))
        if (kind.near == NearLevels::dark) share += kind.probability;
    return share;
}

struct Concluded {
    DepthMeaning meaning{};
    DepthConclusion conclusion{};
};

Concluded concluded(const Findings& findings, const RankedStatements& persons = {}) {
    Concluded result;
    result.conclusion = conclude(persons, findings, result.meaning);
    return result;
}

}  // namespace

TEST_CASE("without findings bright and dark are as likely as each other", "[findings]") {
    CHECK_THAT(share_of_dark({}), WithinAbs(0.5, 1e-9));
    double sum = 0.0;
    for (const DepthHypothesis& kind : weigh({})) sum += kind.probability;
    CHECK_THAT(sum, WithinAbs(1.0, 1e-9));
}

TEST_CASE("one finding alone has its own sureness", "[findings]") {
    const double sureness = GENERATE(0.05, 0.5, 0.72, 0.995);
    CHECK_THAT(share_of_dark({row(kDark, sureness)}), WithinAbs(sureness, 1e-9));
    CHECK_THAT(share_of_dark({row(kBright, sureness)}), WithinAbs(1.0 - sureness, 1e-9));
    for (const DepthHypothesis& kind : weigh({row(kDisparity, sureness)}))
        if (kind.unit == DepthUnit::disparity)
            CHECK_THAT(kind.probability, WithinAbs(sureness, 1e-9));
}

TEST_CASE("findings that agree make each other surer, equal ones that disagree cancel",
          "[findings]") {
    CHECK_THAT(share_of_dark({row(kDark, 0.8), row(kDark, 0.8)}), WithinAbs(16.0 / 17.0, 1e-9));
    CHECK_THAT(share_of_dark({row(kDark, 0.8), row(kBright, 0.8)}), WithinAbs(0.5, 1e-9));
    CHECK(share_of_dark({row(kMillimetres, 0.8)}) > 0.8);  // for distances are near where dark
}

TEST_CASE("a kind of values that only a finding states is possible, too", "[findings]") {
    const DepthStatement odd{.unit = DepthUnit::m, .scale = 0.00025};
    const DepthHypothesis best = weigh({row(odd, 0.995, Evidence::metadata)}).front();
    CHECK(best.unit == DepthUnit::m);
    CHECK(best.scale == 0.00025);
    CHECK_THAT(best.probability, WithinAbs(0.995, 1e-9));
    CHECK(weigh({row({.unit = DepthUnit::m}, 0.995)}).front().scale == 1.0);
}

TEST_CASE("millimetres and metres of the same length are the same values", "[findings]") {
    const DepthStatement in_m{.unit = DepthUnit::m, .scale = 0.0002};
    const DepthStatement in_mm{.unit = DepthUnit::mm, .scale = 0.2};
    const Findings both{row(in_m, 0.97, Evidence::layout), row(in_mm, 0.97, Evidence::layout)};
    CHECK(weigh(both).front().probability > 0.99);
    const auto [meaning, conclusion] = concluded({row(in_m, 0.97, Evidence::layout)});
    CHECK(meaning.unit.value == DepthUnit::m);
    CHECK(meaning.scale.value == 0.0002);
    const auto [own, ignored] =
        concluded({row(in_m, 0.97, Evidence::layout)}, {{Origin::panel, {.unit = DepthUnit::mm}}});
    CHECK_THAT(own.scale.value, WithinAbs(0.2, 1e-12));
    CHECK(state_same_values(in_m, in_mm));
    CHECK(state_same_values({.unit = DepthUnit::m}, {.unit = DepthUnit::mm, .scale = 1000.0}));
    CHECK_FALSE(state_same_values(in_m, {.unit = DepthUnit::m}));
    CHECK_FALSE(state_same_values({.unit = DepthUnit::levels}, {.unit = DepthUnit::mm}));
    CHECK_FALSE(state_same_values({.scale = 1.0}, {.scale = 1.0}));
}

TEST_CASE("a fact is found where it is sure enough, else it is assumed", "[findings]") {
    const double sureness = GENERATE(0.89, 0.91);
    CAPTURE(sureness);
    const auto [meaning, conclusion] =
        concluded({row(kMillimetres, sureness), row({.no_data = std::vector{7.0}}, sureness)});
    const Origin origin = sureness < 0.9 ? Origin::assumed : Origin::found;
    CHECK(meaning.unit == Known<DepthUnit>{DepthUnit::mm, origin});
    CHECK(meaning.no_data == Known<std::vector<double>>{{7.0}, origin});
    CHECK_THAT(conclusion.sure, WithinAbs(sureness, 1e-9));
    CHECK(conclusion.alternatives.empty() == (sureness > 0.9));
}

TEST_CASE("what is not sure has two to four answers, the likeliest first", "[findings]") {
    const auto [meaning, conclusion] = concluded({row(kDark, 0.6)});
    REQUIRE(conclusion.alternatives.size() >= 2);
    CHECK(conclusion.alternatives.size() <= 4);
    CHECK(conclusion.alternatives.front().statement.near == meaning.near.value);
    CHECK(conclusion.alternatives.front().statement.unit == meaning.unit.value);
    CHECK(conclusion.alternatives.front().statement.scale == meaning.scale.value);
    double last = 1.0;
    for (const DepthAlternative& other : conclusion.alternatives) {
        CHECK(other.probability <= last);
        last = other.probability;
        CHECK((other.statement.near && other.statement.unit && other.statement.scale));
    }
}

TEST_CASE("numbers that may be millimetres or metres have both among their answers", "[findings]") {
    const auto alternatives =
        concluded({row({.scale = 1.0}, 0.99), row({.unit = DepthUnit::m}, 0.15),
                   row(kMillimetres, 0.85), row(kDark, 0.74), row(kBright, 0.89)})
            .conclusion.alternatives;
    CHECK(alternatives.size() == 4);
    for (const DepthUnit unit : {DepthUnit::mm, DepthUnit::m})
        CHECK(std::any_of(alternatives.begin(), alternatives.end(),
                          [unit](const auto& answer) { return answer.statement.unit == unit; }));
}

TEST_CASE("near, and unit with scale, are each as sure as all answers that share them",
          "[findings]") {
    const DepthConclusion weak = concluded({row(kDark, 0.6)}).conclusion;
    CHECK_THAT(weak.near_sure, WithinAbs(0.6, 1e-9));
    CHECK(weak.sure < weak.near_sure);
    CHECK(weak.sure < weak.unit_sure);
    const DepthConclusion stated =
        concluded({row(kDark, 0.6)}, {{Origin::panel, kDark}}).conclusion;
    CHECK_THAT(stated.near_sure, WithinAbs(1.0, 1e-9));
}

TEST_CASE("the surest finding counts for facts that are not weighed", "[findings]") {
    const auto [meaning, conclusion] =
        concluded({row({.code = DepthCode::hue}, 0.85, Evidence::appearance),
                   row({.code = DepthCode::grey}, 0.99, Evidence::metadata),
                   row({.packing = DepthPacking::tracks}, 0.6)});
    CHECK(meaning.code == Known<DepthCode>{DepthCode::grey, Origin::found});
    CHECK(meaning.packing == Known<DepthPacking>{DepthPacking::tracks, Origin::assumed});
    CHECK(conclusion.findings.size() == 3);
}

TEST_CASE("what sure findings state by more than a look is said once, with where it is from",
          "[findings]") {
    Findings findings{row(kMillimetres, 0.995, Evidence::metadata),
                      row(kDark, 0.995, Evidence::layout), row(kDark, 0.97, Evidence::name)};
    findings[1].reason = "a layout";
    CHECK(concluded(findings).meaning.found_in == "a reason, a layout");
    CHECK(origins_of({row(kDark, 0.85, Evidence::magic), row(kDark, 0.99, Evidence::numbers),
                      row({}, 0.995, Evidence::magic)})
              .empty());
}

TEST_CASE("what a person states beats every finding, and nobody is asked again", "[findings]") {
    const Findings sure{row(kMillimetres, 0.999, Evidence::metadata)};
    const auto [turned, conclusion] = concluded(sure, {{Origin::panel, kBright}});
    CHECK(turned.near == Known<NearLevels>{NearLevels::bright, Origin::panel});
    CHECK(turned.unit.value == DepthUnit::mm);  // of metadata that is right in all but one fact
    CHECK(conclusion.alternatives.empty());
    CHECK(conclusion.findings.front().evidence == Evidence::person);
    CHECK(conclusion.findings.front().reason == "panel");

    const auto [levels, ignored] =
        concluded(sure, {{Origin::sidecar, {.unit = DepthUnit::levels}}});
    CHECK(levels.unit == Known<DepthUnit>{DepthUnit::levels, Origin::sidecar});
    CHECK(ignored.alternatives.empty());

    const auto [scaled, other] = concluded(sure, {{Origin::command_line, {.scale = 0.25}}});
    CHECK(scaled.scale == Known<double>{0.25, Origin::command_line});
    CHECK(scaled.unit.value == DepthUnit::mm);
    CHECK(other.sure > 0.9);
}

TEST_CASE("a row that it is no depth lowers every meaning, and none that a person states",
          "[findings]") {
    Findings findings{row({.near = NearLevels::bright, .unit = DepthUnit::levels}, 0.99),
                      row({}, 0.85, Evidence::appearance)};
    CHECK(concluded(findings).conclusion.alternatives.empty());
    findings[1].about = kNoDepth;
    const auto [meaning, conclusion] = concluded(findings);
    CHECK(conclusion.doubt == "a reason");
    CHECK(conclusion.sure < kSureEnough);
    CHECK(conclusion.sure > 0.5);  // somebody named it depth
    CHECK(conclusion.alternatives.size() >= 2);
    CHECK(meaning.near == Known<NearLevels>{NearLevels::bright, Origin::assumed});
    for (const DepthStatement& stated :
         {kBright, kMillimetres, DepthStatement{.code = DepthCode::grey}})
        CHECK(concluded(findings, {{Origin::panel, stated}}).conclusion.doubt.empty());
}

TEST_CASE("a person's near tells of the unit where only the numbers speak of it", "[findings]") {
    const Findings weak{row({.unit = DepthUnit::levels}, 0.6), row(kDisparity, 0.5)};
    CHECK(concluded(weak, {{Origin::panel, kDark}}).meaning.unit.value != DepthUnit::disparity);
}
