// The devices of the service, for `dibhr devices` and `--device inverse3`: no force is sent.
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
    std::string sentence{};  ///< the state and the next step, for the user
    std::vector<KeptSetting> kept{};

    [[nodiscard]] bool usable() const noexcept { return stage == Stage::ready; }
};

struct Survey {
    Stage stage{Stage::looking};  ///< of the service; `ready`: it has devices
    std::string sentence{};
    std::string version{};  ///< empty: not known
    std::vector<SurveyedArm> arms{};
    std::vector<GripStatus> grips{};
};

/// Takes at most 3 s; ignores `options.device`.
[[nodiscard]] Survey survey_service(const ConnectionOptions& options);

/// Why `device` cannot be used; empty: it is attached, though the user may have to do something
/// before it is ready.
[[nodiscard]] std::string why_none(const Survey& survey, const std::string& device);

}  // namespace dibhr::inverse3
