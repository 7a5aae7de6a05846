// The attached arms, for `dibhr devices` and `--device forcedimension`: no force, and nothing
// moves.
#pragma once

#include <string>
#include <vector>

#include "device/forcedimension/status.hpp"

namespace dibhr::forcedimension {

struct SurveyedArm {
    Status status{};  ///< stage and sentence, too

    [[nodiscard]] bool usable() const noexcept { return status.stage == Stage::ready; }
};

struct Survey {
    std::string library{};   ///< file and version; empty: none is installed, or none can be used
    std::string sentence{};  ///< why there is no arm; empty: there is nothing to say
    bool trouble{false};     ///< the sentence is about something that the user can mend
    std::vector<SurveyedArm> arms{};
};

/// Opens every arm and closes it. Ignores `options.serial`.
[[nodiscard]] Survey survey_arms(const ConnectionOptions& options);

/// Why the arm of this serial cannot be used; empty: it is attached, though the user may have to do
/// something before it is ready.
[[nodiscard]] std::string why_none(const Survey& survey, const std::string& serial);

}  // namespace dibhr::forcedimension
