// What a session holds besides its ticks: parameters, media files, marks. For writing and reading.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/haptics/parameter_table.hpp"
#include "core/haptics/safety.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

/// Name/value pairs that describe a session.
using SessionFacts = std::map<std::string, std::string>;

/// Of the machine: "machine-cpu", "machine-kernel" and "machine-system"; what cannot be found out
/// is left out.
[[nodiscard]] SessionFacts machine_facts();

/// A file that was touched, and its content. Path empty: none.
struct SessionMedia {
    std::filesystem::path file{};  ///< absolute
    std::uint64_t bytes{0};
    std::string sha256{};  ///< empty: the recording ended before it was known
};

/// Everything a person can tune that a force depends on.
struct SessionParameters {
    std::uint64_t version{0};  ///< ticks refer to it
    TouchParameters touch{};
    SafetyLimits limits{};
    bool force_enabled{true};
    SessionMedia bump{};         ///< for writing, the file suffices
    std::int64_t first_tick{0};  ///< set by reading back
};

/// Every number of them, in the order of the columns of table `parameters`: visit(column, number).
template <typename Visit>
void visit_numbers(SessionParameters& parameters, const Visit& visit) {
    for (const TouchNumber& number : touch_numbers()) {
        visit(number.column, number.in(parameters.touch));
    }
    SafetyLimits& limits = parameters.limits;
    visit(std::string_view("max_force_newton"), limits.max_force_newton);
    visit(std::string_view("max_change_newton_per_ms"), limits.max_change_newton_per_ms);
    visit(std::string_view("ramp_s"), limits.ramp_s);
    visit(std::string_view("max_tick_s"), limits.max_tick_s);
    visit(std::string_view("max_goal_speed_mm_per_ms"), limits.max_goal_speed_mm_per_ms);
}

/// What frames were made of.
struct SessionSource {
    FrameSource source{};
    SessionMedia colour{}, depth{};
    std::int64_t first_tick{0};
};

/// A moment a person marked while recording.
struct SessionMark {
    double t_s{0.0};  ///< on the ticks' clock
    std::string tag{};
    std::string text{};
};

}  // namespace dibhr
