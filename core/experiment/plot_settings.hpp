// The line under a plot's title: what the path was run with.
#pragma once

#include <string>

#include "core/experiment/experiment.hpp"

namespace dibhr {

/// Friction, depth and where the goals come from.
[[nodiscard]] std::string settings_of(const PathRun& path);

}  // namespace dibhr
