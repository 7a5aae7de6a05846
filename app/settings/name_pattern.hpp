// Names of pictures and clips: a pattern with date, file, time and frame.
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

/// The values of the placeholders.
struct NameFacts {
    std::tm now{};          ///< local time
    std::string file{};     ///< name of the shown file, without extension
    double media_s{0.0};    ///< playing position, 0 or more
    std::int64_t frame{0};  ///< shown frame, from 1 on
};

/// What is wrong with a pattern, as the end of a sentence; empty: valid.
[[nodiscard]] std::string problem_of(const NamePattern& pattern);

/// A path without extension: "dibhr-20261120-060742", "hand-00m04.631s-000139". The pattern must be
/// valid.
[[nodiscard]] std::string name_from(const NamePattern& pattern, const NameFacts& facts);

}  // namespace dibhr
