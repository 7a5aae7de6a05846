// What `dibhr bench` measures of the algorithms: their updates on every ground, and what a goal
// that jumps costs them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "core/haptics/parameters.hpp"
#include "core/metrics/force_variation.hpp"

namespace dibhr {

/// One algorithm along one path.
struct UpdateCost {
    Algorithm algorithm{Algorithm::dibhr};
    double update_ns{0.0};         ///< an update's share of a run timed as a whole, no clock in it
    double moves{0.0};             ///< of an update
    SampleStatistics single_us{};  ///< of single updates; each includes one reading of the clock
    std::uint64_t bounds_met{0};

    [[nodiscard]] double move_ns() const noexcept { return update_ns / moves; }
};

struct PathCost {
    std::string ground{};
    std::string path{};
    int columns{0};
    int rows{0};
    double depth_px{0.0};
    std::vector<UpdateCost> algorithms{};  ///< in the order of all_algorithms()

    /// What DIBHR takes of the time of PGA.
    [[nodiscard]] double dibhr_to_pga() const;
};

/// One algorithm after a goal that jumped. An update does a bounded number of moves, so the proxy
/// is there some updates later.
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

/// For people: a row for each ground and path, a column for each algorithm.
[[nodiscard]] std::string table_of(const UpdateCosts& costs);

/// Adds "coplanar_crossing_ns", "grounds" and "jumps", and, of the flat image alone, "updates" and
/// "teleports".
void add_to_json(const UpdateCosts& costs, Json& json);

/// The statistics with `unit` in their keys: "median_us".
[[nodiscard]] Json json_of(const SampleStatistics& statistics, const std::string& unit);

}  // namespace dibhr
