// The report for people: aligned tables of plain text.
#pragma once

#include <span>
#include <string>

#include "core/experiment/experiment.hpp"

namespace dibhr {

/// The paper's Table 1 beside ours; `clock_us` is what reading the clock costs.
[[nodiscard]] std::string table_of(std::span<const PathRun> paths, double clock_us);

/// The sweep in short: for each path and algorithm the range of the variation over all frictions
/// and depths, the worst error, and where an algorithm is not rougher than DIBHR.
[[nodiscard]] std::string sweep_table_of(std::span<const SweepPoint> points, double clock_us);

}  // namespace dibhr
