// Gathers answers into counts and values, and measures them.
#include "core/study_report/study_findings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "core/files/plain_text.hpp"
#include "core/psychophysics/staircase.hpp"

namespace dibhr {

namespace {

/// The answers of one participant in a block.
using Answers = std::vector<const AnsweredTrial*>;

/// Counts the answers that `is_one` selects; hits are those that `is_hit` selects.
template <typename IsOne, typename IsHit>
Count count_of(const Answers& own, const IsOne& is_one, const IsHit& is_hit) {
    Count count;
    for (const AnsweredTrial* const one : own) {
        if (!is_one(*one)) continue;
        ++count.trials;
        count.hits += is_hit(*one) ? 1 : 0;
    }
    return count;
}

Count sum_of(const std::vector<Count>& counts) {
    Count all;
    for (const Count& one : counts) {
        all.hits += one.hits;
        all.trials += one.trials;
    }
    return all;
}

/// The answers of a block, participant by participant.
struct BlockAnswers {
    const Study& study;
    std::size_t block{0};
    std::vector<Answers> by_participant{};

    [[nodiscard]] const Block& block_definition() const { return study.protocol.blocks[block]; }

    /// As count_of(), of each participant.
    template <typename IsOne, typename IsHit>
    [[nodiscard]] std::vector<Count> counts(const IsOne& is_one, const IsHit& is_hit) const {
        std::vector<Count> counts;
        for (const Answers& own : by_participant) counts.push_back(count_of(own, is_one, is_hit));
        return counts;
    }

    /// Of all trials.
    template <typename IsHit>
    [[nodiscard]] Count count(const IsHit& is_hit) const {
        return sum_of(counts([](const AnsweredTrial&) { return true; }, is_hit));
    }
};

bool has_answer(const AnsweredTrial& one) {
    return one.answer.choice >= 0 || one.answer.number.has_value();
}

bool chose_first(const AnsweredTrial& one) {
    return one.answer.choice == 0;
}

/// Picks one item's trials.
struct OfItem {
    std::size_t item{0};

    bool operator()(const AnsweredTrial& one) const {
        return static_cast<std::size_t>(one.trial.item) == item;
    }
};

/// Picks one item's trials without a difference (level 0).
auto without_difference(std::size_t item) {
    return
        [item](const AnsweredTrial& one) { return OfItem{item}(one) && *one.trial.level == 0.0; };
}

/// Picks one item's trials with a choice.
auto with_choice(std::size_t item) {
    return [item](const AnsweredTrial& one) { return OfItem{item}(one) && one.answer.choice >= 0; };
}

/// Share of right answers by guessing, with two or three intervals.
double chance_of(TrialForm form) {
    return form == TrialForm::two_interval ? 0.5 : 1.0 / 3.0;
}

Sensitivity sensitivity_of(TrialForm form, Count right) {
    return form == TrialForm::two_interval ? two_interval_sensitivity(right)
                                           : oddity_sensitivity(right);
}

BlockAnswers answers_in(const Study& study, std::size_t block) {
    BlockAnswers all{study, block, {}};
    for (const StudyRecord& record : study.participants) {
        auto& own = all.by_participant.emplace_back();
        for (const AnsweredTrial& one : record.answered)
            if (static_cast<std::size_t>(one.trial.block) == block) own.push_back(&one);
    }
    return all;
}

std::vector<double> finite_only(std::span<const double> values) {
    std::vector<double> kept;
    for (const double value : values)
        if (std::isfinite(value)) kept.push_back(value);
    return kept;
}

Interval clamped(const Interval& interval, double low, double high) {
    return {std::clamp(interval.low, low, high), std::clamp(interval.high, low, high)};
}

ShareFinding share_finding(std::string name, std::vector<Count> counts,
                           std::optional<double> chance) {
    ShareFinding found{
        .name = std::move(name), .by_participant = std::move(counts), .chance = chance};
    std::vector<double> shares;
    for (const Count& count : found.by_participant)
        if (count.trials > 0) shares.push_back(count.share());
    found.all = sum_of(found.by_participant);
    found.interval = exact_interval(found.all);
    found.participants_mean = mean_of(shares);
    const bool alike = shares.size() > 1 && std::isinf(found.participants_mean.interval.low);
    // Where all shares are equal, only the variation of trials gives an interval.
    found.participants_mean.interval =
        alike ? found.interval : clamped(found.participants_mean.interval, 0.0, 1.0);
    return found;
}

/// By ranks only where each share has enough participants: all tests of a block are of one kind, so
/// that they can be compared.
void test_together(std::vector<ShareFinding>& shares) {
    const bool by_ranks = std::all_of(shares.begin(), shares.end(), [](const ShareFinding& share) {
        return !share.chance || with_trials(share.by_participant) >= kFewestForRanks;
    });
    std::vector<double> p;
    for (ShareFinding& share : shares) {
        if (!share.chance) continue;
        share.test = chance_test(share.by_participant, *share.chance, by_ranks);
        p.push_back(share.test->p);
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    std::size_t k = 0;
    for (ShareFinding& share : shares)
        if (share.test) share.adjusted_p = adjusted[k++];
}

std::string condition_name(const Protocol& protocol, std::size_t condition) {
    return protocol.conditions[condition].name;
}

/// Shares where no parameter varies: which of two was chosen, and whether the odd one was found.
void add_plain_choices(const BlockAnswers& answers, BlockFindings& found) {
    const Block& block = answers.block_definition();
    const Protocol& protocol = answers.study.protocol;
    for (std::size_t item = 0; item < block.items.size(); ++item) {
        const bool oddity = block.form == TrialForm::three_interval;
        const StudyItem& pair = block.items[item];
        if (!oddity && pair.reference == pair.comparison) {
            found.remarks.push_back("Both intervals of " + item_name(protocol, block, item) +
                                    " are alike: which was chosen says nothing.");
            continue;
        }
        // The reference is named first, as on the page: "dibhr rather than pga".
        const std::string name = oddity
                                     ? "found: " + item_name(protocol, block, item)
                                     : condition_name(protocol, pair.reference) + " rather than " +
                                           condition_name(protocol, pair.comparison);
        const auto hit = [oddity](const AnsweredTrial& one) {
            return (one.answer.choice == one.trial.target) == oddity;
        };
        ShareFinding& share = found.shares.emplace_back(
            share_finding(name, answers.counts(with_choice(item), hit), chance_of(block.form)));
        share.d_prime = sensitivity_of(block.form, share.all);
    }
}

std::string level_name(const Variation& vary, double level) {
    return vary.parameter + " " + short_text(vary.reference, 4) + (level < 0.0 ? " - " : " + ") +
           short_text(std::abs(level), 4);
}

/// Share right at each constant level.
void add_levels(const BlockAnswers& answers, BlockFindings& found) {
    const Block& block = answers.block_definition();
    const bool yes_no = block.form == TrialForm::explore;
    for (std::size_t item = 0; item < block.items.size(); ++item) {
        const Count false_alarms = sum_of(answers.counts(without_difference(item), chose_first));
        for (const double level : block.variation.levels) {
            const auto at_level = [&](const AnsweredTrial& one) {
                return OfItem{item}(one) && one.trial.level == level && (yes_no || one.right);
            };
            const auto hit = [yes_no](const AnsweredTrial& one) {
                return yes_no ? chose_first(one) : *one.right;
            };
            const std::vector<Count> counts = answers.counts(at_level, hit);
            if (with_trials(counts) == 0) continue;
            const std::string of = block.items.size() > 1
                                       ? ", " + item_name(answers.study.protocol, block, item)
                                       : std::string();
            ShareFinding share = share_finding(
                (yes_no ? block.question.answers.front() + ": " : std::string("right: ")) +
                    level_name(block.variation, level) + of,
                counts, yes_no ? std::nullopt : std::optional(chance_of(block.form)));
            share.level = level;
            if (!yes_no)
                share.d_prime = sensitivity_of(block.form, share.all);
            else if (false_alarms.trials > 0 && level > 0.0)
                share.d_prime = yes_no_sensitivity(share.all, false_alarms).sensitivity;
            found.shares.push_back(std::move(share));
        }
    }
}

/// A participant's guess rate: given by the form; of yes and no measured in the trials at level 0.
double guess_rate(const Block& block, const Answers& own, std::size_t item) {
    if (block.form != TrialForm::explore) return chance_of(block.form);
    const Count caught = count_of(own, without_difference(item), chose_first);
    constexpr double kMostGuessed = 0.9;
    return caught.trials > 0 ? std::min(caught.share(), kMostGuessed) : 0.0;
}

/// Whether the trial has a difference to find. Of yes and no, a level below 0 has none: "no" is
/// right there.
bool has_difference(const Block& block, const AnsweredTrial& one) {
    const double level = *one.trial.level;
    return block.form == TrialForm::explore ? level > 0.0 : level != 0.0;
}

/// Right (or yes) at each size of the difference. No answer in time is a miss.
LevelCounts counts_by_size(const Block& block, const Answers& own, std::size_t item) {
    LevelCounts counts;
    for (const AnsweredTrial* const one : own) {
        if (!OfItem{item}(*one) || !has_difference(block, *one)) continue;
        add_answer(counts, std::abs(*one->trial.level), one->right.value_or(false));
    }
    std::ranges::sort(counts, {}, &LevelCount::x);
    return counts;
}

/// Mean over a participant's tracks, of the last six reversals of each.
double mean_of_reversals(const Block& block, const Answers& own, std::size_t item) {
    constexpr int kReversals = 6;
    std::vector<double> means;
    for (int track = 0; track < block.variation.tracks; ++track) {
        Staircase staircase(*block.variation.staircase);
        for (const AnsweredTrial* const one : own)
            if (OfItem{item}(*one) && one->trial.track == track)
                staircase.answer(one->right.value_or(false));
        const double mean = reversal_mean(staircase.trials(), kReversals);
        if (std::isfinite(mean)) means.push_back(mean);
    }
    return mean_of(means).value;
}

void add_all(LevelCounts& all, const LevelCounts& some) {
    for (const LevelCount& level : some)
        for (int k = 0; k < level.count.trials; ++k) add_answer(all, level.x, k < level.count.hits);
}

/// A curve of two parameters needs two levels, and some answers more than it has parameters.
bool can_be_fitted(const LevelCounts& counts) {
    constexpr int kFewestTrials = 10;
    const int trials =
        std::accumulate(counts.begin(), counts.end(), 0,
                        [](int sum, const LevelCount& level) { return sum + level.count.trials; });
    return counts.size() >= 2 && trials >= kFewestTrials;
}

PsychometricFit fit_of(const LevelCounts& counts, const FitSettings& settings,
                       const Simulate& simulate, std::uint64_t seed) {
    if (settings.bootstraps > 0) return fitted(counts, settings, simulate, seed);
    return fitted_roughly(counts, settings);
}

/// Combines all fits.
void summarize(ThresholdFinding& finding) {
    if (!finding.all.empty()) finding.lowest = finding.all.front().x;
    for (const LevelCount& level : finding.all) {
        finding.lowest = std::min(finding.lowest, level.x);
        finding.highest = std::max(finding.highest, level.x);
    }
    std::vector<double> thresholds;
    std::vector<double> or_sides;
    for (const ParticipantThreshold& one : finding.fits) {
        thresholds.push_back(one.fit.function.threshold);
        or_sides.push_back(one.threshold_or_infinite());
        finding.unbounded += one.bounded() ? 0 : 1;
        finding.below += std::isinf(or_sides.back()) && or_sides.back() < 0.0 ? 1 : 0;
        finding.above += std::isinf(or_sides.back()) && or_sides.back() > 0.0 ? 1 : 0;
    }
    if (finding.unbounded > 0) thresholds.clear();
    finding.participants_mean = mean_of(thresholds);
    finding.median = median_of(or_sides);
}

ThresholdFinding threshold_of(const BlockAnswers& answers, std::size_t item,
                              const AnalysisSettings& settings, BlockFindings& found) {
    const Block& block = answers.block_definition();
    const Variation& vary = block.variation;
    const std::string of = item_name(answers.study.protocol, block, item);
    ThresholdFinding finding{
        .name = vary.parameter + ", " + of,
        .item = item,
        .parameter = vary.parameter,
        .reference = vary.reference,
        .settings = {.curve = settings.curve, .bootstraps = settings.bootstraps}};
    for (std::size_t participant = 0; participant < answers.by_participant.size(); ++participant) {
        const auto& own = answers.by_participant[participant];
        const LevelCounts counts = counts_by_size(block, own, item);
        add_all(finding.all, counts);
        const StudyRecord& record = answers.study.participants[participant];
        if (!can_be_fitted(counts)) {
            found.remarks.push_back(record.identity.participant + " has too few answers of " + of +
                                    " for a psychometric function.");
            continue;
        }
        finding.settings.guess = guess_rate(block, own, item);
        const Simulate simulate =
            vary.staircase ? same_staircases(*vary.staircase, vary.tracks) : same_levels(counts);
        const auto seed =
            static_cast<std::uint64_t>(record.identity.number) * 1000 + answers.block * 100 + item;
        finding.fits.push_back({participant, counts,
                                fit_of(counts, finding.settings, simulate, seed),
                                vary.staircase ? mean_of_reversals(block, own, item) : kNotKnown});
    }
    summarize(finding);
    return finding;
}

/// Adds remarks on trials that are in no threshold, and on a guess rate that was not measured.
void remark_on_levels(const BlockAnswers& answers, BlockFindings& found) {
    const Block& block = answers.block_definition();
    const bool yes_no = block.form == TrialForm::explore;
    const int nothing =
        answers.count([](const AnsweredTrial& one) { return *one.trial.level == 0.0; }).hits;
    const int below =
        answers.count([](const AnsweredTrial& one) { return *one.trial.level < 0.0; }).hits;
    if (!yes_no && nothing > 0) {
        found.not_counted = nothing;
        found.remarks.push_back(std::to_string(nothing) + " of the " +
                                std::to_string(found.trials) +
                                " trials had no difference (level 0): no answer to them is right "
                                "or wrong, so they count in no share and no threshold.");
    }
    if (yes_no && below > 0)
        found.remarks.push_back(
            std::to_string(below) + " of the " + std::to_string(found.trials) +
            " trials had less of it than the reference (a level below 0): their shares of yes are "
            "shown, but they count in no threshold, guess rate or d'.");
    if (yes_no && nothing == 0)
        found.remarks.emplace_back(
            "No trial was without a difference (level 0), so the guess rate is taken as 0. For "
            "people who say yes without a difference, the threshold then comes out too low.");
}

/// Adds a remark where participants gave different numbers of answers, because each still counts as
/// one. The trials of staircases always differ.
void remark_on_answers(const BlockAnswers& answers, BlockFindings& found) {
    if (answers.block_definition().variation.staircase) return;
    std::size_t most = 0;
    for (const auto& own : answers.by_participant) most = std::max(most, own.size());
    std::vector<std::string> fewer;
    for (std::size_t participant = 0; participant < answers.by_participant.size(); ++participant) {
        const std::size_t count = answers.by_participant[participant].size();
        if (count > 0 && count < most)
            fewer.push_back(answers.study.participants[participant].identity.participant + " " +
                            std::to_string(count));
    }
    if (!fewer.empty())
        found.remarks.push_back("Not all gave the same number of answers here (the most " +
                                std::to_string(most) + "; " + listed(fewer) +
                                "): in means, medians and tests over participants each participant "
                                "still counts as one.");
}

/// Each participant's mean of what `value` gives for the trials that `is_one` picks; `tested`:
/// against 0.
template <typename IsOne, typename Value>
ValueFinding value_finding(const BlockAnswers& answers, std::string name, const IsOne& is_one,
                           const Value& value, bool tested = false) {
    ValueFinding found{.name = std::move(name)};
    std::vector<double> all;
    for (const auto& own : answers.by_participant) {
        std::vector<double> values;
        for (const AnsweredTrial* const one : own)
            if (is_one(*one) && has_answer(*one)) values.push_back(value(*one));
        all.insert(all.end(), values.begin(), values.end());
        found.by_participant.push_back(mean_of(values).value);
    }
    found.trials = static_cast<int>(all.size());
    std::vector<double> each = finite_only(found.by_participant);
    if (each.size() == 1) each = all;
    found.mean = mean_of(each);
    found.median = median_of(each);
    if (tested && std::isfinite(found.mean.interval.low)) found.test = one_sample_t_test(each);
    return found;
}

void add_adjustments(const BlockAnswers& answers, BlockFindings& found) {
    const Block& block = answers.block_definition();
    for (std::size_t item = 0; item < block.items.size(); ++item) {
        const Variation& vary = block.variation;
        const auto off = [&vary](const AnsweredTrial& one) {
            return *one.answer.number - vary.reference;
        };
        found.values.push_back(value_finding(answers,
                                             item_name(answers.study.protocol, block, item) + ", " +
                                                 vary.parameter + " less " +
                                                 short_text(vary.reference, 4),
                                             OfItem{item}, off, true));
    }
}

/// Compares the conditions by their values, within each participant.
void compare_conditions(BlockFindings& found) {
    const std::vector<ValueFinding>& values = found.values;
    if (values.size() < 2) return;
    std::vector<std::vector<double>> rows;
    for (std::size_t participant = 0; participant < values.front().by_participant.size();
         ++participant) {
        std::vector<double> row;
        for (const ValueFinding& value : values) row.push_back(value.by_participant[participant]);
        if (finite_only(row).size() == row.size()) rows.push_back(std::move(row));
    }
    if (static_cast<int>(rows.size()) < kFewestForRanks) {
        found.remarks.push_back("Conditions are not tested against each other: signed ranks need " +
                                std::to_string(kFewestForRanks) + " participants, there are " +
                                std::to_string(rows.size()) + ".");
        return;
    }
    if (values.size() > 2) found.overall = friedman_test(rows);
    std::vector<double> p;
    for (std::size_t a = 0; a < values.size(); ++a) {
        for (std::size_t b = a + 1; b < values.size(); ++b) {
            std::vector<double> differences;
            for (const auto& row : rows) differences.push_back(row[a] - row[b]);
            found.pairs.push_back({values[a].name, values[b].name, mean_of(differences),
                                   signed_rank_test(differences)});
            p.push_back(found.pairs.back().test.p);
        }
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    for (std::size_t k = 0; k < adjusted.size(); ++k) found.pairs[k].adjusted_p = adjusted[k];
}

void add_ratings(const BlockAnswers& answers, BlockFindings& found) {
    const Block& block = answers.block_definition();
    for (std::size_t item = 0; item < block.items.size(); ++item) {
        found.values.push_back(
            value_finding(answers, item_name(answers.study.protocol, block, item), OfItem{item},
                          [](const AnsweredTrial& one) { return *one.answer.number; }));
    }
    compare_conditions(found);
}

/// How often each condition got each answer; compares conditions by their first answer.
void add_answers(const BlockAnswers& answers, BlockFindings& found) {
    const Block& block = answers.block_definition();
    for (std::size_t item = 0; item < block.items.size(); ++item) {
        const std::string of = item_name(answers.study.protocol, block, item);
        // With two answers, the share of the second follows from the first.
        const std::size_t count = block.question.answers.size();
        for (std::size_t answer = 0; answer < (count == 2 ? 1 : count); ++answer) {
            found.shares.push_back(share_finding(
                block.question.answers[answer] + ": " + of,
                answers.counts(with_choice(item),
                               [answer](const AnsweredTrial& one) {
                                   return static_cast<std::size_t>(one.answer.choice) == answer;
                               }),
                std::nullopt));
        }
        found.values.push_back(
            value_finding(answers, of, with_choice(item),
                          [](const AnsweredTrial& one) { return chose_first(one) ? 1.0 : 0.0; }));
    }
    compare_conditions(found);
    found.compared = "share of " + in_quotes(block.question.answers.front());
    for (PairTest& pair : found.pairs)
        pair.difference.interval = clamped(pair.difference.interval, -1.0, 1.0);
    found.values.clear();  // the shares show them
}

Estimate median_reaction(const BlockAnswers& answers) {
    std::vector<double> medians;
    for (const auto& own : answers.by_participant) {
        std::vector<double> times;
        for (const AnsweredTrial* const one : own)
            if (has_answer(*one)) times.push_back(one->answer.reaction_s);
        if (!times.empty()) medians.push_back(median_of(times).value);
    }
    return median_of(medians);
}

BlockFindings block_findings(const Study& study, std::size_t block,
                             const AnalysisSettings& settings) {
    const BlockAnswers answers = answers_in(study, block);
    const Block& block_definition = answers.block_definition();
    const Count answered = answers.count(has_answer);
    BlockFindings found{
        .block = block, .trials = answered.trials, .unanswered = answered.trials - answered.hits};
    if (found.trials == 0) return found;
    const bool adaptive = block_definition.variation.staircase.has_value();
    const bool leveled = adaptive || !block_definition.variation.levels.empty();
    if (block_definition.form == TrialForm::adjust) {
        add_adjustments(answers, found);
    } else if (block_definition.form == TrialForm::rating) {
        add_ratings(answers, found);
    } else if (!leveled) {
        block_definition.form == TrialForm::explore ? add_answers(answers, found)
                                                    : add_plain_choices(answers, found);
    } else {
        remark_on_levels(answers, found);
        if (!adaptive) add_levels(answers, found);
        for (std::size_t item = 0; item < block_definition.items.size(); ++item)
            found.thresholds.push_back(threshold_of(answers, item, settings, found));
    }
    remark_on_answers(answers, found);
    test_together(found.shares);
    found.reaction_s = median_reaction(answers);
    return found;
}

}  // namespace

bool ParticipantThreshold::bounded() const noexcept {
    // Weibull's has no level below 0: there 0 is no bound.
    const bool low = std::isfinite(fit.threshold.low) &&
                     (fit.function.curve != Curve::weibull || fit.threshold.low > 0.0);
    return low && std::isfinite(fit.threshold.high);
}

double ParticipantThreshold::threshold_or_infinite() const noexcept {
    const double threshold = fit.function.threshold;
    if (bounded() || counts.empty()) return threshold;
    const auto [low, high] = std::ranges::minmax_element(counts, {}, &LevelCount::x);
    constexpr double kOutside = std::numeric_limits<double>::infinity();
    return threshold < low->x ? -kOutside : threshold > high->x ? kOutside : threshold;
}

int with_trials(const std::vector<Count>& by_participant) {
    return static_cast<int>(std::count_if(by_participant.begin(), by_participant.end(),
                                          [](const Count& one) { return one.trials > 0; }));
}

std::string item_name(const Protocol& protocol, const Block& block, std::size_t item) {
    const StudyItem& pair = block.items[item];
    const std::string reference = condition_name(protocol, pair.reference);
    return pair.reference == pair.comparison
               ? reference
               : reference + " against " + condition_name(protocol, pair.comparison);
}

TestResult chance_test(const std::vector<Count>& by_participant, double chance, bool by_ranks) {
    const Count all = sum_of(by_participant);
    std::vector<double> differences;
    for (const Count& count : by_participant)
        if (count.trials > 0) differences.push_back(count.share() - chance);
    if (by_ranks) return signed_rank_test(differences);
    return {.test = "binomial, mid-p, of all trials",
            .count = static_cast<int>(differences.size()),
            .statistic = static_cast<double>(all.hits),
            .p = binomial_test(all, chance).mid_p,
            .effect = all.trials > 0 ? all.share() - chance : 0.0};
}

std::vector<BlockFindings> findings_of(const Study& study, const AnalysisSettings& settings) {
    std::vector<BlockFindings> all;
    const std::size_t blocks = study.protocol.blocks.size();
    for (std::size_t block = 0; block < blocks; ++block) {
        if (!study.protocol.blocks[block].practice)
            all.push_back(block_findings(study, block, settings));
        if (settings.progress)
            settings.progress(static_cast<double>(block + 1) / static_cast<double>(blocks));
    }
    return all;
}

}  // namespace dibhr
