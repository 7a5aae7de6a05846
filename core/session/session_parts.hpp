// What a session holds besides its ticks: parameters, media files, marks. For writing and reading.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

/// Name/value pairs that describe a session.
using SessionFacts = std::map<std::string, std::string>;

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
