// The sentences of a study's report.
#include "core/study_report/study_sentences.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include "core/files/plain_text.hpp"
#include "core/psychophysics/staircase.hpp"
#include "core/report/report_sentences.hpp"

namespace dibhr {

namespace {

/// A threshold or an end of its interval; outside the levels only the side is given.
std::string threshold_text(const ThresholdFinding& finding, double value) {
    if (std::isnan(value)) return "not known";
    if (std::isfinite(value)) return short_text(value, 3);
    return value < 0.0 ? "below " + short_text(finding.lowest, 3)
                       : "above " + short_text(finding.highest, 3);
}

std::string levels_text(const ThresholdFinding& finding) {
    return short_text(finding.lowest, 3) + " to " + short_text(finding.highest, 3);
}

std::string participants_text(int count) {
    return counted(count, "participant");
}

std::string test_text(const TestResult& test) {
    return test.test + ", " + p_text(test.p);
}

std::string corrected(double p, double adjusted_p) {
    return p_text(adjusted_p) != p_text(p)
               ? ", " + p_text(adjusted_p) + " among the tests of this block (Holm)"
               : std::string();
}

/// The participants for whom a finding is valid.
std::string people(int count) {
    return count == 1 ? "this one participant" : "these " + std::to_string(count) + " participants";
}

std::string share_sentence(const ShareFinding& share) {
    const int who = with_trials(share.by_participant);
    const bool of_people = share.test && share.test->test.starts_with("Wilcoxon");
    std::string text = share.name + ": " + percent_text(share.all.share()) + " of " +
                       counted(share.all.trials, "answer") + " (95 % interval " +
                       percent_text(share.interval.low) + " to " +
                       percent_text(share.interval.high) + ").";
    if (!share.test) return text;
    text += " Against chance (" + percent_text(*share.chance) + "): " + test_text(*share.test) +
            corrected(share.test->p, share.adjusted_p) + ".";
    if (share.adjusted_p < kSignificance) {
        if (of_people)
            return text + " Chance alone seldom gives this: people like these " +
                   std::to_string(who) + " participants notice a difference.";
        return text + " Chance alone seldom gives this: " + people(who) +
               (who == 1 ? " notices" : " together notice") +
               " a difference. So few participants cannot tell whether other people do.";
    }
    // The shares that the answers do not exclude; of people in general where the test allows it.
    const Interval& agrees = of_people ? share.participants_mean.interval : share.interval;
    const std::string range = percent_text(agrees.low) + " to " + percent_text(agrees.high);
    if (!agrees.holds(*share.chance))
        return text + " The test does not show a difference, although chance lies outside the " +
               "interval of " + range + ": more participants would tell.";
    return text + " This does not show a difference, nor that there is none: any share from " +
           range + " would agree with these answers.";
}

/// How many thresholds lie outside the levels, or are not bounded.
std::string unbounded_text(const ThresholdFinding& finding) {
    std::string text;
    const std::string levels = " the levels that were tested (" + levels_text(finding) + ")";
    if (finding.below > 0)
        text += " Below" + levels + ": " + participants_text(finding.below) + ".";
    if (finding.above > 0)
        text += " Above" + levels + ", or guessing: " + participants_text(finding.above) + ".";
    const auto people = static_cast<int>(finding.fits.size());
    if (finding.unbounded == people)
        text += " Nobody's answers bound the threshold.";
    else if (finding.unbounded > 0)
        text += " The answers of " + std::to_string(finding.unbounded) + " of the " +
                std::to_string(people) +
                " do not bound the threshold. A mean of the others would not stand for people in "
                "general, so none is given.";
    return text;
}

std::string group_text(const ThresholdFinding& finding) {
    const auto people = static_cast<int>(finding.fits.size());
    const Estimate& median = finding.median;
    if (!std::isfinite(median.value)) {
        const bool beside = std::isinf(median.value);
        return ": not found. " +
               (beside ? "The median over " + participants_text(people) + " lies " +
                             threshold_text(finding, median.value) + "."
                       : "It has no median.") +
               unbounded_text(finding);
    }
    std::string text =
        ": median over " + participants_text(people) + " " + threshold_text(finding, median.value);
    if (people < kFewestForRanks)
        text += " (no interval: it takes " + participants_text(kFewestForRanks) + ")";
    else
        text += " (" + short_text(100.0 * median.confidence, 3) + " % interval " +
                threshold_text(finding, median.interval.low) + " to " +
                threshold_text(finding, median.interval.high) + ")";
    if (std::isfinite(finding.participants_mean.value))
        text += ", mean " +
                estimate_text(finding.participants_mean.value, finding.participants_mean.interval);
    return text + "." + unbounded_text(finding);
}

std::string few_trials_text(const ThresholdFinding& finding) {
    const auto fewest = std::ranges::min_element(
        finding.fits, {}, [](const ParticipantThreshold& one) { return one.fit.trials; });
    if (fewest->fit.trials >= kFewestTrialsOfThreshold) return {};
    return " An interval of " + std::to_string(fewest->fit.trials) +
           " trials covers the threshold less often than in 95 % of studies (of 12 trials in some "
           "85 to 95 %): it takes " +
           std::to_string(kFewestTrialsOfThreshold) + " at the least.";
}

std::string threshold_sentence(const ThresholdFinding& finding, const Study& study) {
    if (finding.fits.empty()) return finding.name + ": too few answers for a threshold.";
    const std::string what =
        "Threshold of " + finding.name + ", a difference from " + short_text(finding.reference, 4);
    if (finding.fits.size() == 1) {
        const ParticipantThreshold& one = finding.fits.front();
        std::string text = what + ": " +
                           estimate_text(one.fit.function.threshold, one.fit.threshold) + " in " +
                           std::to_string(one.fit.trials) + " trials of " +
                           study.participants[one.participant].identity.participant + "." +
                           few_trials_text(finding);
        if (!one.bounded())
            text +=
                " An interval without bound means that the answers do not say where the "
                "threshold is; they may be guesses.";
        return text + " It says nothing about other people.";
    }
    return what + group_text(finding) + few_trials_text(finding);
}

std::string poor_fit_sentence(const ThresholdFinding& finding, const Study& study) {
    std::vector<std::string> who;
    for (const ParticipantThreshold& one : finding.fits)
        if (one.fit.fit_p < kSignificance)
            who.push_back(study.participants[one.participant].identity.participant);
    // One in twenty fits so badly by chance.
    if (who.empty() || (finding.fits.size() >= 20 && who.size() * 20 <= finding.fits.size()))
        return {};
    return "The curve does not fit the answers of " + listed(who) +
           " (deviance, p < 0.05): take that threshold with care.";
}

std::string value_sentence(const ValueFinding& value) {
    const bool known = std::isfinite(value.mean.value);
    if (!known) return value.name + ": no answers.";
    std::string text = value.name + ": mean " +
                       estimate_text(value.mean.value, value.mean.interval) + ", median " +
                       short_text(value.median.value, 3) + ", of " +
                       counted(value.trials, "trial") + ".";
    if (value.test) {
        text += " Against no difference: " + test_text(*value.test) + ".";
        text += value.test->p < kSignificance
                    ? " What was set equal differs from the reference."
                    : " This does not show that what was set equal differs from the reference, nor "
                      "that it does not; the interval says how far it may.";
    }
    return text;
}

std::string pair_sentence(const PairTest& pair, const std::string& compared) {
    std::string text = pair.first + " against " + pair.second + ": mean difference " +
                       (compared.empty() ? "" : "of the " + compared + " ") +
                       estimate_text(pair.difference.value, pair.difference.interval) + "; " +
                       test_text(pair.test) + corrected(pair.test.p, pair.adjusted_p) + ".";
    return text + (pair.adjusted_p < kSignificance
                       ? " People like these participants tell the two apart in this."
                       : " This shows no difference, nor that there is none.");
}

/// What must be known before any number is read.
std::string pilots_text(const Study& study) {
    std::vector<std::string> simulated;
    for (const StudyRecord& record : study.participants)
        if (!record.identity.pilot.empty()) simulated.push_back(record.identity.participant);
    if (simulated.empty()) return {};
    if (simulated.size() == study.participants.size())
        return "Simulated: no person has answered, and nothing here speaks of people. ";
    return "Warning: " + listed(simulated) + (simulated.size() == 1 ? " is" : " are") +
           " simulated, and every number below is of these and of people together: report on the "
           "people's files alone. ";
}

void add_mouse_limits(const StudyReport& report, std::vector<std::string>& limits) {
    std::vector<std::string> only;
    std::vector<std::string> at_times;
    for (std::size_t k = 0; k < report.hands.size(); ++k) {
        if (!report.hands[k].used_mouse()) continue;
        (report.hands[k].used_only_mouse() ? only : at_times)
            .push_back(report.study.participants[k].identity.participant);
    }
    if (!only.empty())
        limits.push_back("With the mouse, and so without feeling any force: " + listed(only) +
                         ". These answers are of what was seen and heard, and the forces in this "
                         "report were computed, but sent to no device.");
    if (!at_times.empty())
        limits.push_back("At times with the mouse, and then without feeling any force: " +
                         listed(at_times) + ".");
}

/// "this device (mouse)", "these devices (Novint Falcon 12, mouse)".
std::string devices_used(const StudyReport& report) {
    std::set<std::string> names;
    for (const ParticipantHand& hand : report.hands)
        for (const auto& [name, ticks] : hand.devices) names.insert(name);
    if (names.empty()) return "the device that was used";
    return (names.size() == 1 ? "this device (" : "these devices (") +
           listed({names.begin(), names.end()}) + ")";
}

}  // namespace

std::string end_text(double end) {
    return std::isfinite(end) ? short_text(end, 3) : "not bounded";
}

std::string estimate_text(double value, const Interval& interval, double confidence) {
    if (std::isinf(interval.low) && std::isinf(interval.high))
        return end_text(value) + " (no interval)";
    return end_text(value) + " (" + short_text(100.0 * confidence, 3) + " % interval " +
           end_text(interval.low) + " to " + end_text(interval.high) + ")";
}

std::string p_text(double p) {
    return p < 0.001 ? "p < 0.001" : "p = " + short_text(p, p < 0.1 ? 2 : 3);
}

std::string summary_of(const StudyReport& report) {
    const Study& study = report.study;
    std::size_t trials = 0;
    std::size_t practice = 0;
    int answering = 0;
    std::vector<std::string> without_answer;
    for (const StudyRecord& record : study.participants) {
        const auto of_practice = static_cast<std::size_t>(std::ranges::count_if(
            record.answered, [](const AnsweredTrial& one) { return one.trial.practice; }));
        trials += record.answered.size();
        practice += of_practice;
        if (record.answered.size() > of_practice)
            ++answering;
        else
            without_answer.push_back(record.identity.participant);
    }
    std::string text = pilots_text(study) + participants_text(answering) + " gave " +
                       counted(static_cast<std::int64_t>(trials - practice), "answer");
    if (practice > 0) text += ", after " + std::to_string(practice) + " for practice";
    text += ".";
    if (!without_answer.empty())
        text += " No answer that counts is of " + listed(without_answer) + ".";
    return text;
}

std::vector<std::string> conclusions_of(const StudyReport& report, const BlockFindings& block) {
    std::vector<std::string> sentences;
    for (const ShareFinding& share : block.shares) sentences.push_back(share_sentence(share));
    for (const ThresholdFinding& threshold : block.thresholds) {
        sentences.push_back(threshold_sentence(threshold, report.study));
        if (std::string poor = poor_fit_sentence(threshold, report.study); !poor.empty())
            sentences.push_back(std::move(poor));
    }
    for (const ValueFinding& value : block.values) sentences.push_back(value_sentence(value));
    if (block.overall)
        sentences.push_back(
            "All conditions together" +
            (block.compared.empty() ? "" : ", by the " + block.compared) + ": " +
            test_text(*block.overall) +
            (block.overall->p < kSignificance
                 ? ": they are not all alike."
                 : ": nothing shows that they are not all alike; the pairs below are "
                   "then not to be read as findings."));
    for (const PairTest& pair : block.pairs)
        sentences.push_back(pair_sentence(pair, block.compared));
    if (block.unanswered > 0)
        sentences.push_back(
            counted(block.unanswered, "trial") +
            " had no answer in time; where something is right, they count as wrong.");
    const Variation& vary = report.study.protocol.blocks[block.block].variation;
    const bool adjusted = report.study.protocol.blocks[block.block].form == TrialForm::adjust;
    const double middle = (vary.lowest + vary.highest) / 2.0;
    if (adjusted && std::abs(middle - vary.reference) > 0.01 * (vary.highest - vary.lowest))
        sentences.push_back(
            "The range of the adjustment is not even around the reference: a participant who turns "
            "at random ends, on average, " +
            short_text(middle - vary.reference, 3) + " from it.");
    sentences.insert(sentences.end(), block.remarks.begin(), block.remarks.end());
    return sentences;
}

std::vector<std::string> limits_of(const StudyReport& report) {
    const Study& study = report.study;
    std::vector<std::string> limits;
    if (study.has_pilots())
        limits.emplace_back(
            "Answers of a simulated participant are among these: they say nothing about people.");
    const auto count = study.participants.size();
    if (static_cast<int>(count) < kFewestForRanks)
        limits.push_back("With " + counted(static_cast<std::int64_t>(count), "participant") +
                         " everything said here is of " + people(static_cast<int>(count)) +
                         ": it takes " + std::to_string(kFewestForRanks) +
                         " or more to say something about people in general.");
    std::vector<std::string> unfinished;
    std::vector<std::string> later;
    std::set<std::string> programs;
    for (const StudyRecord& record : study.participants) {
        if (!record.warning.empty()) later.push_back(record.identity.participant);
        if (!record.finished) unfinished.push_back(record.identity.participant);
        programs.insert(record.identity.program);
    }
    if (!unfinished.empty())
        limits.push_back("Not finished: " + listed(unfinished) + ". What they answered is in.");
    if (!later.empty())
        limits.push_back("Made by a newer dibhr: " + listed(later) +
                         ". What is new in these files is not in this report.");
    if (programs.size() > 1)
        limits.push_back("Made with different versions of the program: " +
                         listed({programs.begin(), programs.end()}) + ".");
    if (report.intervals.empty())
        limits.emplace_back("No trial's session was recorded: there are no forces or motions.");
    add_mouse_limits(report, limits);
    limits.push_back("What holds here holds for " + devices_used(report) +
                     ", these videos and these settings; a difference that was felt is not by "
                     "itself a better or worse one.");
    return limits;
}

std::string devices_text(const ParticipantHand& hand) {
    std::vector<std::string> devices;
    for (const auto& [name, ticks] : hand.devices) devices.push_back(device_text(name, ticks));
    return listed(devices);
}

std::vector<Definition> methods_of(const StudyReport& report) {
    bool shares = false;
    bool chance = false;
    bool thresholds = false;
    bool values = false;
    bool pairs = false;
    for (const BlockFindings& block : report.blocks) {
        shares = shares || !block.shares.empty();
        thresholds = thresholds || !block.thresholds.empty();
        values = values || !block.values.empty();
        pairs = pairs || !block.pairs.empty();
        for (const ShareFinding& share : block.shares) chance = chance || share.test.has_value();
    }
    std::vector<Definition> methods;
    if (shares)
        methods.push_back(
            {"interval of a share",
             "Exact, of all trials together (Clopper and Pearson 1934). It takes each trial as one "
             "draw: where participants differ from each other it is too narrow for people in "
             "general. That of the mean over participants (Student's t of their shares, within 0 "
             "and 100 %; of shares that are all the same the exact one) takes each person as "
             "one."});
    if (chance)
        methods.push_back(
            {"test against chance",
             "Where each share of the block is of " + std::to_string(kFewestForRanks) +
                 " participants or more, signed ranks of their shares (Wilcoxon 1945), exact; else "
                 "the binomial distribution of all trials, mid-p (Lancaster 1961). Two-sided; 5 % "
                 "of studies of people who guess come out below 0.05, or fewer."});
    if (shares)
        methods.push_back(
            {"d'",
             "Distance of what is felt in its own standard deviations: two intervals sqrt(2) z of "
             "the share right (Macmillan and Creelman 2005); three intervals by comparing "
             "differences (Ennis 1993); yes and no z of hits less z of false alarms (Hautus "
             "1995). The value is of (hits + 1/2) / (trials + 1), so that it is finite for all "
             "right, too; of two and three intervals the interval is the exact one of the share, "
             "carried over without that correction."});
    if (thresholds)
        methods.push_back(
            {"threshold",
             std::string("Where half of what is neither guessed nor lapsed is right: of a ") +
                 name_of(report.analysis.curve) +
                 " function fitted by maximum likelihood. Guess rate: 1/2 of two intervals, 1/3 of "
                 "three, of yes and no the share of yes where there was nothing. Lapse rate: "
                 "fitted, from 0 to 0.06 (Wichmann and Hill 2001). Intervals: profile likelihood, "
                 "its critical value by a parametric bootstrap of " +
                 std::to_string(report.analysis.bootstraps) +
                 " studies, but no lower than 3.5. Of several participants the "
                 "median (order statistics), in which those whose answers set no bound and whose "
                 "most likely threshold lies outside the levels count as below or above them; "
                 "the mean (Student's t) only where all are bounded."});
    if (values)
        methods.push_back(
            {"means and medians",
             "Each participant's mean first; then mean (Student's t) and median (order statistics) "
             "over participants, of a single participant over the trials. An adjustment against "
             "its reference: one-sample t test; none of values that are all the same."});
    if (pairs)
        methods.push_back(
            {"conditions against each other",
             "Each participant against itself: Wilcoxon's signed ranks, exact, with Holm's "
             "correction over the pairs of the block; three conditions and more first together "
             "(Friedman 1937)."});
    if (!report.intervals.empty())
        methods.push_back(
            {"turning of the force",
             "Angle between the force's directions in one update and the next, both in contact: "
             "mean over all pairs of updates, as dibhr experiment has it with reversals."});
    return methods;
}

}  // namespace dibhr
