// The measurements of `dibhr bench` on algorithms: their updates on every ground, and their updates
// after a jump of the goal.
#pragma once

#include <string>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/files/json.hpp"

namespace dibhr {

struct PathCost {
    std::string ground{};
    std::string path{};
    int columns{0};
    int rows{0};
    double depth_px{0.0};
    std::vector<RunFigures> algorithms{};  ///< in the order of all_algorithms()
    TimeTaken timed{};

    /// Time of a DIBHR update divided by that of a PGA update.
    [[nodiscard]] double dibhr_to_pga() const;
};

/// One algorithm after a jump of the goal. An update makes a bounded number of moves, so the proxy
/// arrives some updates later.
struct CatchUpCost {
    Algorithm algorithm{Algorithm::dibhr};
    SampleStatistics first_us{};    ///< of the updates in which the goal jumps
    SampleStatistics slowest_us{};  ///< of each jump's slowest update
    int most_updates{0};            ///< until the proxy has caught up
};

struct JumpCost {
    std::string ground{};
    std::string jump{};
    int columns{0};
    int rows{0};
    std::vector<CatchUpCost> algorithms{};
};

struct UpdateCosts {
    double clock_us{0.0};     ///< part of every single update's time
    double crossing_ns{0.0};  ///< from a TRIANGLE to the next one of its plane
    std::vector<PathCost> paths{};
    std::vector<JumpCost> jumps{};
};

/// Throws InputError when the built-in sample cannot be read.
[[nodiscard]] UpdateCosts measure_updates();

/// A text table: a row for each ground and path, a column for each algorithm.
[[nodiscard]] std::string table_of(const UpdateCosts& costs);

/// Adds "coplanar_crossing_ns", "grounds" and "jumps", and, of the flat image alone, "updates" and
/// "teleports".
void add_to_json(const UpdateCosts& costs, Json& json);

/// The statistics with `unit` in their keys: "median_us".
[[nodiscard]] Json json_of(const SampleStatistics& statistics, const std::string& unit);

}  // namespace dibhr
