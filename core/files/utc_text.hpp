// The wall time as text.
#pragma once

#include <string>

namespace dibhr {

/// A wall time since 1970 as "2026-05-31T12:00:00Z".
[[nodiscard]] std::string utc_text(double utc_s);

}  // namespace dibhr
