// Makes fields of findings, participants, trials and intervals.
#include "core/study_report/study_fields.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/report/report_sentences.hpp"
#include "core/study_report/study_report.hpp"
#include "core/study_report/study_sentences.hpp"

namespace dibhr {

namespace {

constexpr const char* kIntervalHead = "95 % interval";

Json interval_json(double value, const Interval& interval) {
    return {{"value", value},
            {"low", interval.low},
            {"high", interval.high},
            {"confidence", kConfidence}};
}

/// Text as HTML that is not broken into lines.
std::string unbroken(const std::string& text) {
    std::string html = html_text(text);
    for (std::size_t at = 0; (at = html.find(' ', at)) != std::string::npos;)
        html.replace(at, 1, "&nbsp;");
    return html;
}

std::string interval_cell(const Interval& interval) {
    if (std::isinf(interval.low) && std::isinf(interval.high)) return "none";
    return unbroken(end_text(interval.low) + " to " + end_text(interval.high));
}

/// Likewise, of a share.
std::string share_cell(const Interval& interval) {
    return unbroken(percent_text(interval.low) + " to " + percent_text(interval.high));
}

void add_estimate(Fields& row, const char* name, const Estimate& estimate, const std::string& head,
                  const char* interval_head = kIntervalHead) {
    row.add(name, estimate_json(estimate));
    row.show(head, number_cell(estimate.value));
    row.show(interval_head, interval_cell(estimate.interval));
}

std::string test_cell(const TestResult& test) {
    return html_text(test.test) + ", n = " + std::to_string(test.count);
}

std::string p_cell(double p) {
    return unbroken(p_text(p));
}

/// The chosen condition; in free exploration the chosen answer.
std::string chosen_text(const Block& block, const AnsweredTrial& one) {
    if (block.form == TrialForm::explore && one.answer.choice >= 0)
        return block.question.answers[static_cast<std::size_t>(one.answer.choice)];
    return chosen_condition(one);
}

/// Null for nothing.
template <typename Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}

/// An index as a number from 1; null where it is negative.
Json number_from_one(int index) {
    return index < 0 ? Json() : Json(index + 1);
}

/// A mean over the time in contact: scripts read 0 without any, the page shows no value.
void add_in_contact(Fields& row, const FieldName& name, const IntervalMotion& motion, double value,
                    int digits, const std::string& head) {
    row.add(name, value);
    row.show(head, motion.touched() ? number_cell(value, digits) : kNoCell);
}

void add_motion(Fields& row, const IntervalMotion& motion, bool felt = true) {
    const VariationStatistics& turning = motion.turning;
    const auto moves = static_cast<double>(motion.moves);
    const auto updates = static_cast<double>(motion.updates);
    row.fixed("duration_s", motion.duration_s, 1, "time [s]");
    row.add("contact_s", motion.contact_s);
    row.show("in contact", motion.touched() ? percent_text(motion.contact_share()) : "not touched");
    row.add("updates", motion.updates);
    row.add("contact_updates", motion.contact_updates);
    row.add({"", "moves"}, motion.moves);
    row.add({"/moves_per_update", ""}, motion.updates > 0 ? moves / updates : 0.0);
    add_in_contact(row, {"/force_sent_newton/mean", "sent_newton"}, motion, motion.sent_newton, 3,
                   std::string("force ") + (felt ? "sent" : "computed") + ", mean [N]");
    add_in_contact(row, {"/force_sent_newton/peak", "sent_peak_newton"}, motion,
                   motion.sent_peak_newton, 3, "peak [N]");
    row.add({"/force_spring_newton/mean", "spring_newton"}, motion.spring_newton);
    row.add({"/force_spring_newton/peak", "spring_peak_newton"}, motion.spring_peak_newton);
    row.add("path_mm", motion.path_mm);
    add_in_contact(row, "speed_mm_per_s", motion, motion.speed_mm_per_s(), 3, "speed [mm/s]");
    add_in_contact(row, {"/variation_deg/mean", "turning_mean_deg"}, motion, turning.mean_deg, 4,
                   "turning of the force [deg]");
    add_in_contact(row, {"/variation_deg/sd", "turning_sd_deg"}, motion, turning.sd_deg, 4,
                   "sd [deg]");
    row.add({"/variation_deg/pairs", "turning_pairs"}, turning.pairs);
}

Fields interval_fields(const std::string& participant, const IntervalRow& interval) {
    Fields row;
    row.add("participant", participant);
    row.add("trial", interval.trial + 1);
    row.add("interval", interval.interval + 1);
    row.add("condition", interval.condition);
    row.add("practice", interval.practice);
    add_motion(row, interval.motion);
    row.add("value", or_null(interval.value));
    return row;
}

Fields trial_fields(const Protocol& protocol, const StudyIdentity& who, const AnsweredTrial& one) {
    const Trial& trial = one.trial;
    const Block& block = protocol.blocks[static_cast<std::size_t>(trial.block)];
    const StudyItem& item = block.items[static_cast<std::size_t>(trial.item)];
    Fields row;
    row.add("participant", who.participant);
    row.add("number", who.number);
    row.add("pilot", who.pilot);
    row.add("trial", trial.number + 1);
    row.add("block", block.name);
    row.add("position", trial.position + 1);
    row.add("practice", trial.practice);
    row.add("form", name_of(block.form));
    row.add("reference", protocol.conditions[item.reference].name);
    row.add("comparison", protocol.conditions[item.comparison].name);
    row.add("repetition", trial.repetition + 1);
    row.add("target", number_from_one(trial.target));
    row.add("track", number_from_one(trial.track));
    row.add("parameter", block.variation.parameter);
    row.add("level", or_null(trial.level));
    row.add("choice", number_from_one(one.answer.choice));
    row.add("chosen", chosen_text(block, one));
    row.add("answer", or_null(one.answer.number));
    row.add("right", or_null(one.right));
    row.add("reaction_s", one.answer.reaction_s);
    row.add("utc_s", one.utc_s);
    row.add("early", or_null(one.answer.early));
    return row;
}

}  // namespace

Json estimate_json(const Estimate& estimate) {
    Json json = interval_json(estimate.value, estimate.interval);
    json["confidence"] = estimate.confidence;
    json["count"] = estimate.count;
    return json;
}

Json test_json(const std::optional<TestResult>& test) {
    if (!test) return nullptr;
    return {{"test", test->test},
            {"count", test->count},
            {"statistic", test->statistic},
            {"p", test->p},
            {"effect", test->effect}};
}

Fields fields_of(const ShareFinding& share) {
    const bool several = share.participants_mean.count > 1;
    const auto& test = share.test;
    const auto& d_prime = share.d_prime;
    Fields row;
    row.plain("name", share.name, "share");
    row.add("level", or_null(share.level));
    row.add("hits", share.all.hits);
    row.add("trials", share.all.trials);
    row.show("answers", std::to_string(share.all.hits) + " of " + std::to_string(share.all.trials));
    row.add("share", interval_json(share.all.share(), share.interval));
    row.show("of all", unbroken(percent_text(share.all.share())));
    row.show(kIntervalHead, share_cell(share.interval));
    row.add("participants_mean", estimate_json(share.participants_mean));
    row.show("mean over participants",
             several ? percent_text(share.participants_mean.value) : kNoCell);
    row.show(kIntervalHead, several ? share_cell(share.participants_mean.interval) : kNoCell);
    row.add("chance", or_null(share.chance));
    row.add("test", test_json(test));
    row.add("adjusted_p", test ? Json(share.adjusted_p) : Json());
    row.add("d_prime", d_prime ? interval_json(d_prime->d_prime, d_prime->interval) : Json());
    row.show("d'", d_prime ? number_cell(d_prime->d_prime) : kNoCell);
    row.show(kIntervalHead, d_prime ? interval_cell(d_prime->interval) : kNoCell);
    row.show("test against chance", test ? test_cell(*test) : kNoCell);
    row.show("p", test ? p_cell(test->p) : kNoCell);
    row.show("p, Holm", test ? p_cell(share.adjusted_p) : kNoCell);
    row.add("by_participant", json_list(share.by_participant, [](const Count& count) -> Json {
                return {{"hits", count.hits}, {"trials", count.trials}};
            }));
    return row;
}

Fields fields_of(const Study& study, const ParticipantThreshold& one) {
    const PsychometricFit& fit = one.fit;
    const PsychometricFunction& function = fit.function;
    Fields row;
    row.plain("participant", study.participants[one.participant].identity.participant,
              "participant");
    row.add("threshold", interval_json(function.threshold, fit.threshold));
    row.show("threshold", number_cell(function.threshold));
    row.show(kIntervalHead, interval_cell(fit.threshold));
    row.add("scale", interval_json(function.scale, fit.scale));
    row.significant("slope", function.slope(), 3, "slope");
    row.significant("guess", function.guess, 2, "guess rate");
    row.significant("lapse", function.lapse, 2, "lapse rate");
    row.add("deviance", fit.deviance);
    row.significant("fit_p", fit.fit_p, 2, "p of the fit");
    row.plain("trials", fit.trials, "trials");
    row.significant("reversal_mean", one.reversal_mean, 3, "mean of reversals");
    row.add(
        "levels", json_list(one.counts, [](const LevelCount& level) -> Json {
            return {{"level", level.x}, {"hits", level.count.hits}, {"trials", level.count.trials}};
        }));
    return row;
}

Fields fields_of(const ValueFinding& value) {
    Fields row;
    row.plain("name", value.name, "of");
    row.plain("trials", value.trials, "trials");
    add_estimate(row, "mean", value.mean, "mean");
    add_estimate(row, "median", value.median, "median", "interval of the median");
    row.add("test", test_json(value.test));
    row.show("test", value.test ? test_cell(*value.test) : kNoCell);
    row.show("p", value.test ? p_cell(value.test->p) : kNoCell);
    row.add("by_participant", value.by_participant);
    return row;
}

Fields fields_of(const PairTest& pair, const std::string& compared) {
    const std::string of = compared.empty() ? "" : " of the " + html_text(compared);
    Fields row;
    row.plain("first", pair.first, "first");
    row.plain("second", pair.second, "second");
    add_estimate(row, "difference", pair.difference, "mean difference" + of);
    row.add("test", test_json(pair.test));
    row.show("test", test_cell(pair.test));
    row.show("rank-biserial correlation", number_cell(pair.test.effect, 2));
    row.show("p", p_cell(pair.test.p));
    row.add("adjusted_p", pair.adjusted_p);
    row.show("p, Holm", p_cell(pair.adjusted_p));
    return row;
}

Fields fields_of(const MotionFinding& found, bool felt) {
    Fields row;
    row.plain("condition", found.condition, "condition");
    row.plain("intervals", found.intervals, "intervals");
    add_motion(row, found.all, felt);
    row.add({"/participants_mean/contact_share", ""}, estimate_json(found.contact_share));
    row.add({"/participants_mean/force_sent_newton", ""}, estimate_json(found.sent_newton));
    row.add({"/participants_mean/speed_mm_per_s", ""}, estimate_json(found.speed_mm_per_s));
    row.add({"/participants_mean/variation_deg", ""}, estimate_json(found.turning_deg));
    return row;
}

Fields fields_of(const StudyRecord& record, const ParticipantHand& hand) {
    const StudyIdentity& who = record.identity;
    Fields row;
    row.plain("participant", who.participant, "label");
    row.plain("number", who.number, "number");
    row.add("program", who.program);
    row.add("pilot", who.pilot);
    row.add("created_s", who.created_s);
    row.add("finished", record.finished);
    row.plain("trials", record.answered.size(), "trials");
    row.add("device", devices_text(hand));
    row.show("device", hand.devices.empty() ? kNoCell : html_text(devices_text(hand)));
    row.show("finished", record.finished ? "yes" : "no");
    row.show("who", who.pilot.empty() ? "a person" : "simulated: " + html_text(who.pilot));
    row.show("begun", html_text(wall_time_text(who.created_s)));
    row.show("program", html_text(who.program));
    return row;
}

std::string trials_csv(const Study& study) {
    std::string text;
    for (const StudyRecord& record : study.participants) {
        for (const AnsweredTrial& one : record.answered) {
            const Fields row = trial_fields(study.protocol, record.identity, one);
            if (text.empty()) text = row.csv_head + '\n';
            text += row.csv_line + '\n';
        }
    }
    return text;
}

std::string intervals_csv(const Study& study, const std::vector<IntervalRow>& rows) {
    std::string text = interval_fields("", {}).csv_head + '\n';
    for (const IntervalRow& row : rows) {
        const StudyIdentity& who = study.participants[row.participant].identity;
        text += interval_fields(who.participant, row).csv_line + '\n';
    }
    return text;
}

}  // namespace dibhr
