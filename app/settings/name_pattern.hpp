// How pictures and clips are called: a pattern of date, file, time and frame.
#pragma once

#include <cstdint>
#include <ctime>
#include <string>

namespace dibhr {

/// Text with %Y %m %d %H %M %S as in dates, %% for a percent sign, {file}, {time} and {frame}.
struct NamePattern {
    std::string text{"dibhr-%Y%m%d-%H%M%S"};

    bool operator==(const NamePattern&) const = default;
};

/// What goes into a name.
struct NameFacts {
    std::tm now{};          ///< local time
    std::string file{};     ///< name without ending of what is shown
    double media_s{0.0};    ///< where that is, 0 or more
    std::int64_t frame{0};  ///< the same, from 1 on
};

/// What a pattern lacks to be one, as the end of a sentence; empty: nothing.
[[nodiscard]] std::string lacking_of(const NamePattern& pattern);

/// A path without ending: "dibhr-20261120-060742", "hand-00m04.631s-000139". Of a pattern that
/// lacks nothing.
[[nodiscard]] std::string name_from(const NamePattern& pattern, const NameFacts& facts);

}  // namespace dibhr
