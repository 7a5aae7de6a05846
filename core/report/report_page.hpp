// The report as one HTML page that needs nothing beside it.
#pragma once

#include <string>

#include "core/report/session_report.hpp"

namespace dibhr {

/// HTML5, pictures and style inside, no script; light and dark, on a screen and on paper. Whatever
/// text the session holds is shown as text.
[[nodiscard]] std::string page_of(const SessionReport& report);

}  // namespace dibhr
