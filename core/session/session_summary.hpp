// What a session file holds, in a few words: `dibhr info`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace dibhr {

struct SessionSummary {
    std::int64_t rows{0};
    double duration_s{0.0};                      ///< from the first tick to the last
    std::map<std::string, std::string> facts{};  ///< the session table
};

/// Reads a session file and leaves it as it is, also while it is being recorded. Throws InputError.
[[nodiscard]] SessionSummary summarise_session(const std::filesystem::path& file);

}  // namespace dibhr
