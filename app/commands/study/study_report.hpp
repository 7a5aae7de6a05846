// `dibhr study report` of many participants.
#pragma once

#include <filesystem>
#include <vector>

#include "core/study_report/study_report.hpp"

namespace dibhr {

/// Reports on the study files, and those in folders; prints the page's place. The motion of each
/// participant is measured in a process of its own and kept in the report's folder. A file that
/// cannot be read is named and passed over: 1. Throws InputError, also where none can be read.
int report_studies(const std::vector<std::filesystem::path>& given, StudyReportRequest request);

}  // namespace dibhr
