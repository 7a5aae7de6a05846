// The report's numbers for scripts: JSON with stable names, units in them.
#include <cstddef>
#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/study_report/study_fields.hpp"
#include "core/study_report/study_report.hpp"
#include "core/study_report/study_sentences.hpp"

namespace dibhr {

namespace {

constexpr int kStudyReportVersion = 1;  // changes when a name is removed or changes its meaning

/// The fields of one thing.
constexpr auto kObject = [](const auto& one) { return fields_of(one).json; };

Json threshold_json(const Study& study, const ThresholdFinding& finding) {
    return {{"name", utf8_text(finding.name)},
            {"parameter", finding.parameter},
            {"reference", finding.reference},
            {"curve", name_of(finding.settings.curve)},
            {"bootstraps", finding.settings.bootstraps},
            {"most_lapse", finding.settings.most_lapse},
            {"participants_mean", estimate_json(finding.participants_mean)},
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
                 return fields_of(study, one).json;
             })}};
}

Json texts_json(const std::vector<std::string>& texts) {
    return json_list(texts, [](const std::string& text) -> Json { return utf8_text(text); });
}

Json participants_json(const StudyReport& report) {
    Json list = Json::array();
    for (std::size_t k = 0; k < report.study.participants.size(); ++k)
        list.push_back(fields_of(report.study.participants[k], report.hands[k]).json);
    return list;
}

Json block_json(const StudyReport& report, const BlockFindings& found) {
    const Block& block = report.study.protocol.blocks[found.block];
    return {{"name", utf8_text(block.name)},
            {"form", name_of(block.form)},
            {"trials", found.trials},
            {"unanswered", found.unanswered},
            {"not_counted", found.not_counted},
            {"reaction_s", estimate_json(found.reaction_s)},
            {"shares", json_list(found.shares, kObject)},
            {"thresholds", json_list(found.thresholds,
                                     [&report](const ThresholdFinding& finding) {
                                         return threshold_json(report.study, finding);
                                     })},
            {"values", json_list(found.values, kObject)},
            {"compared", utf8_text(found.compared)},
            {"overall", test_json(found.overall)},
            {"pairs", json_list(found.pairs,
                                [&found](const PairTest& pair) {
                                    return fields_of(pair, found.compared).json;
                                })},
            {"conclusions", texts_json(conclusions_of(report, found))}};
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
                      {"participants", participants_json(report)},
                      {"summary", summary_of(report)},
                      {"limits", texts_json(limits_of(report))},
                      {"blocks", json_list(report.blocks,
                                           [&report](const BlockFindings& found) {
                                               return block_json(report, found);
                                           })},
                      {"motion", json_list(report.motion, [&report](const MotionFinding& found) {
                           return fields_of(found, report.forces_were_felt()).json;
                       })}});
}

}  // namespace dibhr
