// Every friction with every depth: where the variation of the force comes from.
#pragma once

#include <span>
#include <vector>

#include "core/experiment/experiment.hpp"

namespace dibhr {

/// What is swept. The paper states neither; these ranges hold what a hand and a device do.
struct SweepRange {
    std::vector<double> mus{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
    std::vector<double> depths_px{2.0, 5.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0};
    int updates{kExperimentUpdates};  ///< of each path
};

/// Runs linear and circle for all of them; the points in order of path, mu, depth, algorithm.
[[nodiscard]] std::vector<SweepPoint> run_sweep(const SweepRange& range,
                                                std::span<const Algorithm> algorithms,
                                                const Progress& progress = {});

/// Where an algorithm's force is not rougher than DIBHR's: what the sweep is to show never happens.
/// Compares the variation while sliding; empty when no point is of DIBHR.
[[nodiscard]] std::vector<SweepPoint> not_rougher_than_dibhr(std::span<const SweepPoint> points);

}  // namespace dibhr
