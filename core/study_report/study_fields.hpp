// The values of a study's report as fields: for its JSON, its CSV and its page.
#pragma once

#include <optional>
#include <string>

#include "core/files/json.hpp"
#include "core/report/fields.hpp"
#include "core/study_report/study_findings.hpp"
#include "core/study_report/study_motion.hpp"

namespace dibhr {

[[nodiscard]] Fields fields_of(const ShareFinding& share);
[[nodiscard]] Fields fields_of(const Study& study, const ParticipantThreshold& one);
[[nodiscard]] Fields fields_of(const ValueFinding& value);
/// `compared`: BlockFindings::compared.
[[nodiscard]] Fields fields_of(const PairTest& pair, const std::string& compared);
/// `felt`: no participant used the mouse, so that every force was sent to a device.
[[nodiscard]] Fields fields_of(const MotionFinding& found, bool felt);
[[nodiscard]] Fields fields_of(const StudyRecord& record, const ParticipantHand& hand);

/// `{"value", "low", "high", "confidence", "count"}`.
[[nodiscard]] Json estimate_json(const Estimate& estimate);
/// `{"test", "count", "statistic", "p", "effect"}`, or null.
[[nodiscard]] Json test_json(const std::optional<TestResult>& test);

}  // namespace dibhr
