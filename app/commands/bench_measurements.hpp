// What `dibhr bench` measures, as plain data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/haptics/algorithm.hpp"
#include "core/metrics/force_variation.hpp"

namespace dibhr {

/// One of the paper's runs on one flat image, two depth images blended.
struct UpdateRun {
    Algorithm algorithm{};
    std::string path{};  ///< "linear" or "circle"
    int columns{0};
    int rows{0};
    UpdateTiming timing{};
};

/// A goal that jumps from one corner of the image to the opposite one.
struct TeleportRun {
    std::string where{};  ///< "contact": along the surface; "air": just above it
    int columns{0};
    int rows{0};
    SampleStatistics update_us{};
};

/// From the player's thread to the tick.
struct HandoverRun {
    int columns{0};
    int rows{0};
    SampleStatistics cleaning_ms{};
    SampleStatistics cleaned_to_touchable_us{};  ///< until a tick that asks gets the new frame
    SampleStatistics swap_us{};                  ///< what taking it costs that tick
};

/// Two 1 kHz loops run at the same time on this machine: one that does nothing, and the haptic loop
/// on a playing video.
struct LoopRun {
    struct Lateness {
        std::uint64_t ticks{0};
        std::uint64_t late_ticks{0};
        double p99_us{0.0};
        double worst_us{0.0};
    };
    double seconds{0.0};
    Lateness empty{};
    Lateness haptic{};
};

struct BenchResults {
    double mu{0.4};
    double depth_px{20.0};
    double clock_us{0.0};  ///< part of every update's time
    std::vector<UpdateRun> updates{};
    std::vector<TeleportRun> teleports{};
    HandoverRun handover{};
    LoopRun loop{};
};

[[nodiscard]] std::vector<UpdateRun> measure_updates(const BenchResults& settings, int columns,
                                                     int rows);
[[nodiscard]] std::vector<TeleportRun> measure_teleports(const BenchResults& settings, int columns,
                                                         int rows);
[[nodiscard]] HandoverRun measure_handover(int columns, int rows);
[[nodiscard]] LoopRun measure_loops(double seconds);

}  // namespace dibhr
