// By what the simulated service can be told from Haply's.
#pragma once

namespace dibhr::inverse3::simulated {

/// What it tells as `project_name` at /version.
inline constexpr const char* kProjectName = "dibhr-simulated-inverse-service";

}  // namespace dibhr::inverse3::simulated
