// The goals of a recorded session, to run them through other algorithms.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/haptics/vec.hpp"

namespace dibhr {

/// Where the hand was in one tick, and which moment of the depth video it touched.
struct RecordedGoal {
    Vec3 goal{0.0};  ///< grid space
    std::int64_t frame{0};
    double blend{0.0};  ///< 0: that frame, 1: the one after it
};

struct RecordedGoals {
    std::map<std::string, std::string> facts{};  ///< the session table
    std::vector<RecordedGoal> goals{};           ///< in order of time
};

/// The ticks from `lead_in` before the first one in contact on, at most `count`; ticks without a
/// finite goal are left out. Throws InputError for a file that is no session, and one without a
/// tick in contact.
[[nodiscard]] RecordedGoals read_session_goals(const std::filesystem::path& file, int lead_in,
                                               int count);

}  // namespace dibhr
