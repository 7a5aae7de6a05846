// What the service has, for `dibhr devices` and for who insists on an Inverse3: nothing is driven.
#pragma once

#include <string>
#include <vector>

#include "device/inverse3/kept_settings.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

struct SurveyedArm {
    std::string id{};
    bool minverse{false};
    Handedness handedness{Handedness::unknown};
    Stage stage{Stage::looking};
    std::string sentence{};  ///< what is, and what to do next
    std::vector<KeptSetting> kept{};

    [[nodiscard]] bool usable() const noexcept { return stage == Stage::ready; }
};

struct Survey {
    Stage stage{Stage::looking};  ///< of the service; `ready`: it has devices
    std::string sentence{};
    std::string version{};  ///< empty: not told
    std::vector<SurveyedArm> arms{};
    std::vector<GripStatus> grips{};
};

/// Asks for at most 3 s; `options.device` is not looked at.
[[nodiscard]] Survey survey_service(const ConnectionOptions& options);

/// Why the device of `options` cannot be used; empty: it is there, though it may want something of
/// its person.
[[nodiscard]] std::string why_none(const Survey& survey, const std::string& device);

}  // namespace dibhr::inverse3
