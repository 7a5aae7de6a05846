// The report's numbers for scripts: JSON with names that stay, units in them.
#include <cmath>
#include <string>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/study_report/study_report.hpp"
#include "core/study_report/study_words.hpp"

namespace dibhr {

namespace {

constexpr int kStudyReportVersion = 1;  // changes when a name changes its meaning or goes

Json interval_json(double value, const Interval& interval, double confidence) {
    return {{"value", value},
            {"low", interval.low},
            {"high", interval.high},
            {"confidence", confidence}};
}

Json estimate_json(const Estimate& estimate) {
    Json json = interval_json(estimate.value, estimate.interval, estimate.confidence);
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

Json count_json(const Count& count) {
    return {{"hits", count.hits}, {"trials", count.trials}};
}

Json share_json(const ShareFinding& share) {
    Json json{{"name", utf8_text(share.name)},
              {"level", share.level ? Json(*share.level) : Json()},
              {"hits", share.all.hits},
              {"trials", share.all.trials},
              {"share", interval_json(share.all.share(), share.interval, kConfidence)},
              {"participants_mean", estimate_json(share.across)},
              {"chance", share.chance ? Json(*share.chance) : Json()},
              {"test", test_json(share.test)},
              {"adjusted_p", share.test ? Json(share.adjusted_p) : Json()},
              {"d_prime", nullptr},
              {"by_participant", json_list(share.by_participant, count_json)}};
    if (share.d_prime)
        json["d_prime"] =
            interval_json(share.d_prime->d_prime, share.d_prime->interval, kConfidence);
    return json;
}

Json fit_json(const Study& study, const ParticipantThreshold& one) {
    const PsychometricFit& fit = one.fit;
    return {{"participant", study.participants[one.participant].identity.participant},
            {"threshold", interval_json(fit.function.threshold, fit.threshold, kConfidence)},
            {"scale", interval_json(fit.function.scale, fit.scale, kConfidence)},
            {"slope", fit.function.slope()},
            {"guess", fit.function.guess},
            {"lapse", fit.function.lapse},
            {"deviance", fit.deviance},
            {"fit_p", fit.fit_p},
            {"trials", fit.trials},
            {"reversal_mean", one.reversal_mean},
            {"levels", json_list(one.counts, [](const LevelCount& level) -> Json {
                 return {{"level", level.x},
                         {"hits", level.count.hits},
                         {"trials", level.count.trials}};
             })}};
}

Json threshold_json(const Study& study, const ThresholdFinding& finding) {
    return {{"name", utf8_text(finding.name)},
            {"parameter", finding.parameter},
            {"reference", finding.reference},
            {"curve", name_of(finding.settings.curve)},
            {"bootstraps", finding.settings.bootstraps},
            {"most_lapse", finding.settings.most_lapse},
            {"participants_mean", estimate_json(finding.across)},
            {"participants_median", finding.median.value},
            {"participants_median_interval",
             {{"low", finding.median.interval.low},
              {"high", finding.median.interval.high},
              {"confidence", finding.median.confidence},
              {"count", finding.median.count}}},
            {"levels", {{"lowest", finding.lowest}, {"highest", finding.highest}}},
            {"below_levels", finding.below},
            {"above_levels", finding.above},
            {"unbounded", finding.unbounded},
            {"fits", json_list(finding.fits, [&study](const ParticipantThreshold& one) {
                 return fit_json(study, one);
             })}};
}

Json value_json(const ValueFinding& value) {
    return {{"name", utf8_text(value.name)},     {"trials", value.trials},
            {"mean", estimate_json(value.mean)}, {"median", estimate_json(value.median)},
            {"test", test_json(value.test)},     {"by_participant", value.by_participant}};
}

Json pair_json(const PairTest& pair) {
    return {{"first", utf8_text(pair.first)},
            {"second", utf8_text(pair.second)},
            {"difference", estimate_json(pair.difference)},
            {"test", test_json(pair.test)},
            {"adjusted_p", pair.adjusted_p}};
}

Json texts_json(const std::vector<std::string>& texts) {
    return json_list(texts, [](const std::string& text) -> Json { return utf8_text(text); });
}

Json block_json(const StudyReport& report, const BlockFindings& found) {
    const Block& block = report.study.protocol.blocks[found.block];
    return {{"name", utf8_text(block.name)},
            {"form", name_of(block.form)},
            {"trials", found.trials},
            {"unanswered", found.unanswered},
            {"not_counted", found.not_counted},
            {"reaction_s", estimate_json(found.reaction_s)},
            {"shares", json_list(found.shares, share_json)},
            {"thresholds", json_list(found.thresholds,
                                     [&report](const ThresholdFinding& finding) {
                                         return threshold_json(report.study, finding);
                                     })},
            {"values", json_list(found.values, value_json)},
            {"compared", utf8_text(found.compared)},
            {"overall", test_json(found.overall)},
            {"pairs", json_list(found.pairs, pair_json)},
            {"conclusions", texts_json(conclusions_of(report, found))}};
}

Json motion_json(const MotionFinding& found) {
    const IntervalMotion& all = found.all;
    return {
        {"condition", utf8_text(found.condition)},
        {"intervals", found.intervals},
        {"duration_s", all.duration_s},
        {"contact_s", all.contact_s},
        {"updates", all.updates},
        {"contact_updates", all.contact_updates},
        {"moves_per_update",
         all.updates > 0 ? static_cast<double>(all.moves) / static_cast<double>(all.updates) : 0.0},
        {"force_sent_newton", {{"mean", all.sent_newton}, {"peak", all.sent_peak_newton}}},
        {"force_spring_newton", {{"mean", all.spring_newton}, {"peak", all.spring_peak_newton}}},
        {"path_mm", all.path_mm},
        {"speed_mm_per_s", all.speed_mm_per_s()},
        {"variation_deg",
         {{"mean", all.turning.mean_deg},
          {"sd", all.turning.sd_deg},
          {"pairs", all.turning.pairs}}},
        {"participants_mean",
         {{"contact_share", estimate_json(found.contact_share)},
          {"force_sent_newton", estimate_json(found.sent_newton)},
          {"speed_mm_per_s", estimate_json(found.speed_mm_per_s)},
          {"variation_deg", estimate_json(found.turning_deg)}}}};
}

Json participant_json(const StudyRecord& record) {
    return {{"participant", record.identity.participant},
            {"number", record.identity.number},
            {"program", utf8_text(record.identity.program)},
            {"pilot", utf8_text(record.identity.pilot)},
            {"created_s", record.identity.created_s},
            {"finished", record.finished},
            {"trials", record.answered.size()}};
}

}  // namespace

std::string json_of(const StudyReport& report) {
    const Study& study = report.study;
    return json_text({{"report_version", kStudyReportVersion},
                      {"program", report.program},
                      {"protocol",
                       {{"title", utf8_text(study.protocol.title)},
                        {"version", study.protocol.version},
                        {"seed", study.protocol.seed},
                        {"name", utf8_text(study.participants.front().identity.protocol_name)},
                        {"sha256", study.protocol.sha256}}},
                      {"participants", json_list(study.participants, participant_json)},
                      {"summary", summary_of(report)},
                      {"limits", texts_json(limits_of(report))},
                      {"blocks", json_list(report.blocks,
                                           [&report](const BlockFindings& found) {
                                               return block_json(report, found);
                                           })},
                      {"motion", json_list(report.motion, motion_json)}});
}

}  // namespace dibhr
