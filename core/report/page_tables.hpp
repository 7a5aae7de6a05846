// The tables of the report's page, each a heading and what is under it.
#pragma once

#include <string>

#include "core/report/session_report.hpp"

namespace dibhr {

/// Empty for a session without contact.
[[nodiscard]] std::string episodes_section(const SessionReport& report);
/// Empty for a session without marks.
[[nodiscard]] std::string marks_section(const SessionReport& report);
[[nodiscard]] std::string parameters_section(const SessionReport& report);
[[nodiscard]] std::string files_section(const SessionReport& report);
[[nodiscard]] std::string facts_section(const SessionReport& report);
[[nodiscard]] std::string definitions_section();

}  // namespace dibhr
