// The name by which the simulated service can be distinguished from Haply's.
#pragma once

namespace dibhr::inverse3::simulated {

/// The simulated service's `project_name` at /version.
inline constexpr const char* kProjectName = "dibhr-simulated-inverse-service";

}  // namespace dibhr::inverse3::simulated
