// Weighs findings on near, unit and scale, and takes the surest finding on each other fact.
#include "core/video/depth/findings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr std::array<std::string_view, 8> kEvidenceNames{
    "person", "magic", "metadata", "layout", "code", "name", "appearance", "numbers"};

/// How usual each kind of values is among the files that people bring. Bright and dark have half
/// each, so that evidence on near alone counts for no unit.
constexpr std::array<DepthHypothesis, 8> kUsualKinds{{
    {NearLevels::bright, DepthUnit::levels, 1.0, 0.25},
    {NearLevels::bright, DepthUnit::disparity, 1.0, 0.25},
    {NearLevels::dark, DepthUnit::levels, 1.0, 0.2},
    {NearLevels::dark, DepthUnit::mm, 1.0, 0.1},
    {NearLevels::dark, DepthUnit::m, 1.0, 0.1},
    {NearLevels::dark, DepthUnit::m, 1.0 / 256.0, 0.04},
    {NearLevels::dark, DepthUnit::mm, 0.2, 0.03},
    {NearLevels::dark, DepthUnit::mm, 10.0, 0.03},
}};
constexpr double kShareOfOthers = 0.04;  ///< of a kind that only a finding states

/// How sure it is that the unit fits a person's "near": somebody may also turn what feels wrong.
constexpr double kNearFitsUnit = 0.97;

constexpr std::size_t kMostAlternatives = 4;
constexpr double kLeastLikely = 0.02;  ///< less likely kinds are not offered

bool same_scale(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::abs(b);
}

/// The scale in another unit, where both are of distances; else the same.
double scale_in(DepthUnit unit, DepthUnit stated, double scale) {
    if (unit == stated || !is_distance(unit) || !is_distance(stated)) return scale;
    return scale * one_in_mm(stated) / one_in_mm(unit);
}

/// Whether values of one unit and scale are those of the other.
bool same_values(DepthUnit unit, double scale, DepthUnit other, double other_scale) {
    return (unit == other || (is_distance(unit) && is_distance(other))) &&
           same_scale(scale_in(other, unit, scale), other_scale);
}

bool same_kind(const DepthHypothesis& a, const DepthHypothesis& b) {
    return a.near == b.near && same_values(a.unit, a.scale, b.unit, b.scale);
}

std::optional<double> stated_scale(const DepthStatement& statement) {
    if (!statement.scale && statement.unit && is_distance(*statement.unit)) return 1.0;
    return statement.scale;
}

bool agrees(const DepthHypothesis& kind, const DepthStatement& statement) {
    const double scale = stated_scale(statement).value_or(kind.scale);
    return statement.near.value_or(kind.near) == kind.near &&
           (statement.unit ? same_values(*statement.unit, scale, kind.unit, kind.scale)
                           : same_scale(scale, kind.scale));
}

bool is_on_kind(const DepthStatement& statement) {
    return statement.near || statement.unit || statement.scale;
}

/// Adds the kinds that a statement names and the table does not hold.
void add_kinds(const DepthStatement& statement, std::vector<DepthHypothesis>& kinds) {
    if (!statement.unit) return;
    for (const NearLevels near : kNearLevels) {
        const bool is_natural = *statement.unit == DepthUnit::levels ||
                                (near == NearLevels::dark) == is_distance(*statement.unit);
        if (statement.near ? *statement.near != near : !is_natural) continue;
        const DepthHypothesis kind{near, *statement.unit, stated_scale(statement).value_or(1.0),
                                   kShareOfOthers};
        const auto same = std::find_if(kinds.begin(), kinds.end(),
                                       [&](const auto& other) { return same_kind(kind, other); });
        if (same == kinds.end()) {
            kinds.push_back(kind);
        } else {  // in the unit that is stated
            same->unit = kind.unit;
            same->scale = kind.scale;
        }
    }
}

/// Makes the sum of the probabilities 1, and sorts the likeliest first.
void normalise(std::vector<DepthHypothesis>& kinds) {
    double sum = 0.0;
    for (const DepthHypothesis& kind : kinds) sum += kind.probability;
    for (DepthHypothesis& kind : kinds) kind.probability /= sum;
    std::stable_sort(kinds.begin(), kinds.end(),
                     [](const auto& a, const auto& b) { return a.probability > b.probability; });
}

/// Adds what one finding tells to the logarithms of the probabilities.
void add_evidence(const Finding& finding, const std::vector<DepthHypothesis>& kinds,
                  std::vector<double>& logs) {
    constexpr double kLeast = 1e-4;  // nothing outweighs all other findings together
    double share = 0.0;
    for (const DepthHypothesis& kind : kinds)
        if (agrees(kind, finding.statement)) share += kind.probability;
    if (!(share > 0.0 && share < 1.0)) return;
    const double sureness = std::clamp(finding.sureness, kLeast, 1.0 - kLeast);
    for (std::size_t k = 0; k < kinds.size(); ++k)
        logs[k] += agrees(kinds[k], finding.statement) ? std::log(sureness / share)
                                                       : std::log((1.0 - sureness) / (1.0 - share));
}

/// Origin of a fact of that probability.
Origin origin_of(double probability) {
    return probability >= kSureEnough ? Origin::found : Origin::assumed;
}

/// Takes each fact of the surest finding that states it; of equally sure ones the first.
void take_surest(const Findings& findings, DepthMeaning& meaning) {
    std::vector<const Finding*> rising;
    for (auto finding = findings.rbegin(); finding != findings.rend(); ++finding)
        rising.push_back(&*finding);
    std::stable_sort(rising.begin(), rising.end(),
                     [](const Finding* a, const Finding* b) { return a->sureness < b->sureness; });
    for (const Finding* const finding : rising) {
        const Origin origin = origin_of(finding->sureness);
        visit_facts(finding->statement, meaning,
                    [origin](const char* /*name*/, const auto& stated, auto& fact) {
                        if (stated) fact = {*stated, origin};
                    });
    }
}

/// What persons state, each fact by the strongest voice.
DepthStatement merged(const RankedStatements& persons) {
    DepthStatement all;
    for (const auto& [origin, statement] : persons) all.fill_in(statement);
    return all;
}

/// The scale that metadata, a layout or a name states, in that unit; else 1.
double scale_beside_numbers(const Findings& findings, DepthUnit unit) {
    for (const Finding& finding : findings)
        if (finding.evidence != Evidence::numbers && finding.statement.scale &&
            finding.sureness >= kSureEnough)
            return scale_in(unit, finding.statement.unit.value_or(unit), *finding.statement.scale);
    return 1.0;
}

/// Why the pictures may be no depth; null: no row says so, or a person states what the levels are.
const Finding* doubt_on_depth(const DepthStatement& stated, const Findings& findings) {
    if (stated.near || stated.unit || stated.range || stated.code) return nullptr;
    const auto found = std::find_if(findings.begin(), findings.end(),
                                    [](const Finding& row) { return row.about == kNoDepth; });
    return found == findings.end() ? nullptr : &*found;
}

/// The probability that pictures are depth: somebody named or gave them as depth, and they look
/// like something else.
double probability_of_depth(const Finding& doubt) {
    const double depth = kSurenessOfName * (1.0 - doubt.sureness);
    const double other = (1.0 - kSurenessOfName) * doubt.sureness;
    return depth / (depth + other);
}

/// The kinds that what persons state allows, with their probabilities.
std::vector<DepthHypothesis> possible_kinds(const DepthStatement& stated, Findings findings) {
    if (stated.near)
        findings.push_back({{.near = stated.near}, Evidence::person, kNearFitsUnit, {}});
    std::vector<DepthHypothesis> kinds = weigh(findings);
    if (stated.unit)
        std::erase_if(kinds, [&](const auto& kind) { return kind.unit != *stated.unit; });
    std::optional<double> scale = stated.scale;
    if (stated.unit && !scale) scale = scale_beside_numbers(findings, *stated.unit);
    std::vector<DepthHypothesis> possible;
    for (DepthHypothesis kind : kinds) {
        kind.near = stated.near.value_or(kind.near);
        kind.scale = scale.value_or(kind.scale);
        const auto same = std::find_if(possible.begin(), possible.end(),
                                       [&](const auto& other) { return same_kind(kind, other); });
        if (same == possible.end())
            possible.push_back(kind);
        else
            same->probability += kind.probability;
    }
    normalise(possible);
    return possible;
}

/// The probability of all kinds that are the same as the likeliest one by `is_same`.
template <typename IsSame>
double probability_of(const std::vector<DepthHypothesis>& kinds, const IsSame& is_same) {
    double sum = 0.0;
    for (const DepthHypothesis& kind : kinds)
        if (is_same(kind, kinds.front())) sum += kind.probability;
    return sum;
}

bool same_near(const DepthHypothesis& a, const DepthHypothesis& b) {
    return a.near == b.near;
}

/// Sets near, unit and scale where no person states them.
void set_kind(const std::vector<DepthHypothesis>& kinds, const DepthStatement& stated,
              DepthMeaning& meaning) {
    const DepthHypothesis& best = kinds.front();
    if (!stated.unit)
        meaning.unit = {best.unit,
                        origin_of(probability_of(
                            kinds, [](const auto& a, const auto& b) { return a.unit == b.unit; }))};
    if (!stated.scale)
        meaning.scale = {best.scale, stated.unit ? meaning.unit.origin
                                                 : origin_of(probability_of(
                                                       kinds, [](const auto& a, const auto& b) {
                                                           return same_scale(a.scale, b.scale);
                                                       }))};
    if (stated.near) return;
    const bool falls = meaning.range.value.near > meaning.range.value.far;
    if (meaning.unit.value == DepthUnit::levels && stated.range)
        meaning.near = {falls ? NearLevels::bright : NearLevels::dark, meaning.range.origin};
    else if (meaning.unit.value != DepthUnit::levels && stated.unit)
        meaning.near = {best.near, meaning.unit.origin};
    else
        meaning.near = {best.near, origin_of(probability_of(kinds, same_near))};
}

/// Where one of the answers is numbers in millimetres or in metres, the other is one, too, if it is
/// likely enough: in place of the last one.
void offer_other_unit(const std::vector<DepthHypothesis>& kinds,
                      std::vector<DepthAlternative>& all) {
    const auto is_plain = [](DepthUnit unit, double scale) {
        return is_distance(unit) && same_scale(scale, 1.0);
    };
    const auto offered = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end() - 1, [&](const DepthAlternative& answer) {
            return is_plain(*answer.statement.unit, *answer.statement.scale);
        }));
    const auto other =
        std::find_if(kinds.begin() + static_cast<std::ptrdiff_t>(all.size()), kinds.end(),
                     [&](const DepthHypothesis& kind) { return is_plain(kind.unit, kind.scale); });
    if (offered != 1 || other == kinds.end() || other->probability < kLeastLikely) return;
    all.back() = {{.near = other->near, .unit = other->unit, .scale = other->scale},
                  other->probability};
}

std::vector<DepthAlternative> alternatives_of(const std::vector<DepthHypothesis>& kinds) {
    std::vector<DepthAlternative> all;
    if (kinds.front().probability >= kSureEnough) return all;
    for (const DepthHypothesis& kind : kinds) {
        const bool is_likely = kind.probability >= kLeastLikely || all.size() < 2;
        if (all.size() == kMostAlternatives || !is_likely) break;
        all.push_back(
            {{.near = kind.near, .unit = kind.unit, .scale = kind.scale}, kind.probability});
    }
    if (all.size() == kMostAlternatives) offer_other_unit(kinds, all);
    if (all.size() < 2) all.clear();
    return all;
}

}  // namespace

std::string_view name_of(Evidence value) noexcept {
    return kEvidenceNames[static_cast<std::size_t>(value)];
}

Finding finding_of_metadata(const DepthStatement& statement, const std::string& reason) {
    return {statement, Evidence::metadata, kSurenessOfMetadata, reason};
}

bool state_same_values(const DepthStatement& one, const DepthStatement& other) {
    if (!one.unit || !other.unit) return false;
    return same_values(*one.unit, stated_scale(one).value_or(1.0), *other.unit,
                       stated_scale(other).value_or(1.0));
}

std::vector<DepthHypothesis> weigh(const Findings& findings) {
    std::vector<DepthHypothesis> kinds(kUsualKinds.begin(), kUsualKinds.end());
    for (const Finding& finding : findings)
        if (finding.sureness > 0.5) add_kinds(finding.statement, kinds);
    normalise(kinds);
    std::vector<double> logs;
    logs.reserve(kinds.size());
    for (const DepthHypothesis& kind : kinds) logs.push_back(std::log(kind.probability));
    for (const Finding& finding : findings)
        if (is_on_kind(finding.statement)) add_evidence(finding, kinds, logs);
    const double most = *std::max_element(logs.begin(), logs.end());
    for (std::size_t k = 0; k < kinds.size(); ++k) kinds[k].probability = std::exp(logs[k] - most);
    normalise(kinds);
    return kinds;
}

DepthMeaning meaning_by(const DepthAlternative& answer, DepthMeaning meaning) {
    DepthStatement whole = answer.statement;
    whole.range = answer.range;
    merge_by_priority({{Origin::assumed, whole}}, meaning);
    return meaning;
}

DepthStatement sure_facts(const RankedStatements& persons, const Findings& findings, double least) {
    DepthStatement all = merged(persons);
    for (const Finding& finding : findings)
        if (finding.sureness >= least) all.fill_in(finding.statement);
    return all;
}

std::string origins_of(const Findings& findings) {
    std::vector<std::string> reasons;
    for (const Finding& finding : findings) {
        const bool looks = finding.evidence >= Evidence::appearance;
        const bool is_new =
            std::find(reasons.begin(), reasons.end(), finding.reason) == reasons.end();
        if (!looks && is_new && finding.sureness >= kSureEnough &&
            finding.statement != DepthStatement{})
            reasons.push_back(finding.reason);
    }
    return listed(reasons);
}

DepthConclusion conclude(const RankedStatements& persons, const Findings& findings,
                         DepthMeaning& meaning) {
    DepthConclusion conclusion;
    for (const auto& [origin, statement] : persons)
        if (!(statement == DepthStatement{}))
            conclusion.findings.push_back(
                {statement, Evidence::person, 1.0, std::string(name_of(origin))});
    conclusion.findings.insert(conclusion.findings.end(), findings.begin(), findings.end());
    meaning.found_in = origins_of(findings);
    take_surest(findings, meaning);
    merge_by_priority(persons, meaning);
    const DepthStatement stated = merged(persons);
    std::vector<DepthHypothesis> kinds = possible_kinds(stated, findings);
    if (const Finding* const doubt = doubt_on_depth(stated, findings)) {
        conclusion.doubt = doubt->reason;
        for (DepthHypothesis& kind : kinds) kind.probability *= probability_of_depth(*doubt);
    }
    set_kind(kinds, stated, meaning);
    conclusion.sure = kinds.front().probability;
    conclusion.near_sure = probability_of(kinds, same_near);
    conclusion.unit_sure = probability_of(kinds, [](const auto& a, const auto& b) {
        return a.unit == b.unit && same_scale(a.scale, b.scale);
    });
    if (!stated.near && !stated.unit && !stated.range)
        conclusion.alternatives = alternatives_of(kinds);
    return conclusion;
}

}  // namespace dibhr
