// Simulates participants once, and takes studies of rising size from them.
#include "core/study_report/study_plan.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/psychophysics/random.hpp"
#include "core/report/report_sentences.hpp"
#include "core/study_report/study_findings.hpp"

namespace dibhr {

namespace {

/// One participant, then as many as signed ranks need, and more.
constexpr std::array<int, 11> kCounts{1, kFewestForRanks, 8, 10, 12, 16, 20, 24, 32, 40, 48};
constexpr double kGoodPrecision = 0.1;

/// The protocol with this block only, at so many repetitions.
Protocol with_one_block(Protocol protocol, std::size_t block, int repetitions) {
    Block kept = protocol.blocks[block];
    (kept.variation.staircase ? kept.variation.tracks : kept.repetitions) = repetitions;
    protocol.blocks = {std::move(kept)};
    protocol.instructions = {};
    protocol.thanks = {};
    return protocol;
}

/// Simulates participants until there are `count`. `number` gives the protocol another seed, and so
/// other orders and other people.
void add_participants(Study& study, const PlanSettings& settings, int number, int count) {
    Protocol protocol = study.protocol;
    protocol.seed = draws_for(settings.seed, {static_cast<std::uint64_t>(number)}).bits();
    for (int who = static_cast<int>(study.participants.size()) + 1; who <= count; ++who)
        study.participants.push_back(
            {.identity = {.number = who}, .answered = answers_of(settings.effect, protocol, who)});
}

/// A finding of one simulated study: whether it was found, or where the threshold is.
struct Outcome {
    bool found{false};
    std::optional<double> threshold{};  ///< NaN or infinite: no bound
};

bool is_of_effect(const std::string& name, const Condition& condition) {
    const std::string with = condition.name + " ";
    return name.starts_with(with) || name.ends_with(" " + condition.name);
}

/// The estimate as reported: the median of several participants; of one its bounded threshold.
double estimate_of(const ThresholdFinding& threshold) {
    const bool alone = threshold.fits.size() == 1;
    return alone ? threshold.participants_mean.value : threshold.median.value;
}

/// Outcomes by the finding's name, without findings that the effect does not concern.
std::map<std::string, Outcome> outcomes_of(const Study& study, const PlanSettings& settings) {
    const BlockFindings found = findings_of(study, {.bootstraps = 0}).front();
    const Block& block = study.protocol.blocks.front();
    const bool leveled = block.variation.staircase || !block.variation.levels.empty();
    const Condition* const preferred =
        settings.effect.prefers.empty() ? nullptr
                                        : study.protocol.condition_named(settings.effect.prefers);
    std::map<std::string, Outcome> outcomes;
    for (const ShareFinding& share : found.shares) {
        const bool of_effect =
            leveled || (preferred != nullptr && is_of_effect(share.name, *preferred));
        if (share.test && of_effect) outcomes[share.name].found = share.adjusted_p < kSignificance;
    }
    for (const ThresholdFinding& threshold : found.thresholds)
        outcomes["threshold of " + threshold.name].threshold = estimate_of(threshold);
    for (const ValueFinding& value : found.values)
        if (value.test) outcomes[value.name].found = value.test->p < kSignificance;
    // Pairs are tested only with enough participants; with fewer the effect counts as not found.
    const std::size_t items = block.items.size();
    const bool paired =
        block.form == TrialForm::rating || (block.form == TrialForm::explore && !leveled);
    for (std::size_t a = 0; paired && a < items; ++a) {
        for (std::size_t b = a + 1; b < items; ++b) {
            const std::string first = item_name(study.protocol, block, a);
            const std::string second = item_name(study.protocol, block, b);
            if (preferred == nullptr || (first != preferred->name && second != preferred->name))
                continue;
            std::string name = first;
            Outcome& outcome = outcomes[name.append(" against ").append(second)];
            for (const PairTest& pair : found.pairs)
                if (pair.first == first && pair.second == second)
                    outcome.found = pair.adjusted_p < kSignificance;
        }
    }
    return outcomes;
}

/// Outcomes of all studies of one size, by finding.
using OutcomesByFinding = std::map<std::string, std::vector<Outcome>>;

PlannedStudies summed(int participants, const std::vector<Outcome>& outcomes, double truth) {
    PlannedStudies planned{.participants = participants, .precision = kNotKnown};
    const auto all = static_cast<double>(outcomes.size());
    std::vector<double> errors;
    for (const Outcome& outcome : outcomes) {
        planned.power += outcome.found ? 1.0 / all : 0.0;
        if (!outcome.threshold) continue;
        const bool bounded = std::isfinite(*outcome.threshold);
        planned.unbounded += bounded ? 0.0 : 1.0 / all;
        errors.push_back(bounded ? std::abs(*outcome.threshold - truth) / truth
                                 : std::numeric_limits<double>::infinity());
    }
    if (errors.empty()) return planned;
    std::sort(errors.begin(), errors.end());
    const auto within = static_cast<std::size_t>(std::ceil(kConfidence * all));
    planned.precision = errors[within - 1];
    return planned;
}

bool is_enough(const PlannedStudies& planned, double power) {
    return planned.of_threshold() ? planned.precision <= kGoodPrecision : planned.power >= power;
}

std::string precision_text(double precision) {
    return std::isfinite(precision) ? percent_text(precision) : "no bound";
}

/// Of a threshold that the largest study does not find.
std::string not_found_text(const PlannedStudies& largest) {
    if (std::isfinite(largest.precision)) return {};
    return "    this design does not find it: of " + counted(largest.participants, "participant") +
           " still " + percent_text(largest.unbounded) +
           " of the studies set no bound to the threshold;\n"
           "    ask at other levels, or more often\n";
}

/// The lines of one block at so many repetitions.
std::vector<PlanLine> lines_of(const Protocol& whole, std::size_t block_number, int repetitions,
                               const PlanSettings& settings,
                               const std::function<void(double)>& progress) {
    const Protocol protocol = with_one_block(whole, block_number, repetitions);
    const Block& block = whole.blocks[block_number];
    std::vector<Study> studies(static_cast<std::size_t>(settings.studies), Study{protocol, {}});
    std::map<std::string, PlanLine> lines;
    for (const int count : kCounts) {
        if (count > settings.most_participants) break;
        OutcomesByFinding by_finding;
        for (int number = 0; number < settings.studies; ++number) {
            // The larger study contains all participants of the smaller one.
            Study& study = studies[static_cast<std::size_t>(number)];
            add_participants(study, settings, number, count);
            for (const auto& [name, outcome] : outcomes_of(study, settings))
                by_finding[name].push_back(outcome);
        }
        // The effect concerns no finding. (One participant alone may have no test yet.)
        if (by_finding.empty() && count >= kFewestForRanks) break;
        bool all_enough = !by_finding.empty();
        for (const auto& [name, outcomes] : by_finding) {
            PlanLine& line = lines[name];
            line.finding = name;
            line.studies.push_back(summed(count, outcomes, settings.effect.threshold));
            const bool of_people = count >= kFewestForRanks || line.studies.back().of_threshold();
            if (line.needed_participants == 0 && of_people &&
                is_enough(line.studies.back(), settings.power))
                line.needed_participants = count;
            all_enough = all_enough && line.needed_participants > 0;
        }
        if (progress) progress(static_cast<double>(count) / settings.most_participants);
        if (all_enough) break;
    }
    double trials = 0.0;
    for (const Study& study : studies)
        trials +=
            static_cast<double>(study.participants.front().answered.size()) / settings.studies;
    std::vector<PlanLine> all;
    for (auto& [name, line] : lines) {
        line.block = block.name;
        line.repetitions = repetitions;
        line.trials = static_cast<int>(std::lround(trials));
        line.as_in_protocol =
            repetitions == (block.variation.staircase ? block.variation.tracks : block.repetitions);
        all.push_back(std::move(line));
    }
    return all;
}

std::vector<int> repetitions_around(const Block& block) {
    const int on_page = block.variation.staircase ? block.variation.tracks : block.repetitions;
    std::vector<int> around;
    if (on_page > 1) around.push_back(on_page / 2);
    around.insert(around.end(), {on_page, 2 * on_page});
    return around;
}

}  // namespace

std::vector<PlanLine> plan_of(const Protocol& protocol, const PlanSettings& settings) {
    if (settings.effect.guesses)
        throw InputError(
            "a participant who guesses has no effect that could be found: state an effect, such as "
            "prefer=CONDITION,share=0.7 or threshold=0.1,slope=20");
    std::vector<std::pair<std::size_t, int>> tasks;
    for (std::size_t block = 0; block < protocol.blocks.size(); ++block) {
        if (protocol.blocks[block].practice) continue;
        for (const int repetitions : repetitions_around(protocol.blocks[block]))
            tasks.emplace_back(block, repetitions);
    }
    std::vector<PlanLine> lines;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        const auto& [block, repetitions] = tasks[k];
        const auto share_done = [&](double share) {
            if (settings.progress)
                settings.progress((static_cast<double>(k) + share) /
                                  static_cast<double>(tasks.size()));
        };
        for (PlanLine& line : lines_of(protocol, block, repetitions, settings, share_done))
            lines.push_back(std::move(line));
    }
    if (lines.empty())
        throw InputError(
            "this effect changes nothing that the protocol asks: for comparisons and "
            "ratings say which condition is preferred, as prefer=NAME,share=0.7, for adjustments "
            "how they scatter, as bias=0.05,noise=0.03");
    return lines;
}

std::string plan_text(const std::vector<PlanLine>& lines, const PlanSettings& settings) {
    std::ostringstream text;
    std::string block;
    bool thresholds = false;
    for (const PlanLine& line : lines) {
        if (line.block != block) text << (block.empty() ? "" : "\n") << line.block << '\n';
        block = line.block;
        text << "  " << line.finding << ", " << counted(line.trials, "trial") << " each"
             << (line.as_in_protocol ? " (as on the page)" : "") << ": ";
        const bool threshold = line.studies.back().of_threshold();
        thresholds = thresholds || threshold;
        if (line.needed_participants > 0)
            text << counted(line.needed_participants, "participant") << '\n';
        else
            text << "more than " << line.studies.back().participants << " participants\n";
        text << "    " << (threshold ? "within" : "found");
        for (const PlannedStudies& planned : line.studies)
            text << "  "
                 << (planned.participants == 1 ? "one alone" : std::to_string(planned.participants))
                 << ": "
                 << (threshold ? precision_text(planned.precision) : percent_text(planned.power));
        text << '\n';
        if (threshold) text << not_found_text(line.studies.back());
    }
    text << "\nOf " << settings.studies
         << " simulated studies each: in how many p < 0.05 (Holm's correction included) finds the "
            "effect;\n"
         << "enough is " << percent_text(settings.power) << ".";
    if (thresholds)
        text << " Of a threshold: within what share of the truth 95 % of the estimates\nlie, "
                "those without a bound being nowhere near it; enough is "
             << percent_text(kGoodPrecision) << ".";
    text << "\nThe plan holds for people as --pilot describes them, and for no others.\n";
    return text.str();
}

}  // namespace dibhr
