// A study's report in sentences: what each number is, what may be concluded, and what may not.
#pragma once

#include <string>
#include <vector>

#include "core/study_report/study_report.hpp"

namespace dibhr {

/// An end of an interval: "0.31", "not bounded".
[[nodiscard]] std::string end_text(double end);

/// "0.42 (95 % interval 0.31 to 0.55)".
[[nodiscard]] std::string estimate_text(double value, const Interval& interval,
                                        double confidence = kConfidence);

/// "p = 0.013", "p < 0.001"
[[nodiscard]] std::string p_text(double p);

/// One paragraph: who took part in what.
[[nodiscard]] std::string summary_of(const StudyReport& report);

/// Of one block: what its answers show, and what they leave open.
[[nodiscard]] std::vector<std::string> conclusions_of(const StudyReport& report,
                                                      const BlockFindings& block);

/// What limits all of it: pilots, few participants, unfinished studies, many tests.
[[nodiscard]] std::vector<std::string> limits_of(const StudyReport& report);

/// How the numbers were computed, with sources; only what the report has.
[[nodiscard]] std::vector<Definition> methods_of(const StudyReport& report);

/// "Novint Falcon 1234, mouse"; empty: no interval was recorded.
[[nodiscard]] std::string devices_text(const ParticipantHand& hand);

}  // namespace dibhr
