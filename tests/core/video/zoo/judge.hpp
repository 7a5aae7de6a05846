// Opens what a form brings as its owner would, and compares what is felt with the truth.
#pragma once

#include <limits>
#include <string>

#include "tests/core/video/zoo/zoo.hpp"

namespace dibhr::test::zoo {

/// `asked`: the opening offers answers, and one of them is right; `refused`: with a sentence that says what it is.
enum class Outcome { right, asked, refused, wrong };

[[nodiscard]] std::string name_of(Outcome outcome);

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// The worst of three frames, and of ten times.
struct Verdict {
    std::string form{};
    Outcome outcome{Outcome::wrong};
    double correlation{kNotMeasured};    ///< of ranks: elevation with nearness
    double bend_pct{kNotMeasured};       ///< of the elevations from a line, of their range
    double scale_pct{kNotMeasured};      ///< error of the distances
    double timing_frames{kNotMeasured};  ///< of depth or colour
    std::string remark{};                ///< why it is wrong, or how it is refused
};

/// Writes the form's files into a temporary folder.
[[nodiscard]] Verdict judge(const Form& form);

}  // namespace dibhr::test::zoo
