// What is kept about the Falcon: the constants that sources disagree on, its workspace, its
// buttons.
#pragma once

#include <span>
#include <string_view>

#include "app/settings/falcon_buttons.hpp"
#include "core/haptics/parameters.hpp"
#include "core/loop/device.hpp"
#include "device/falcon/options.hpp"

namespace dibhr {

struct FalconSettings {
    falcon::ConnectionOptions connection{};  ///< used from the next start of the program
    falcon::Geometry geometry{};
    falcon::Motors motors{};
    falcon::WorkspaceOptions workspace{};
    ButtonActions buttons{kStandardButtons};
    bool force_in_front_only{true};  ///< no force while people work in another window
};

/// What a number is about: a heading of the panel.
enum class FalconTopic { workspace, motors, geometry };

/// One number people tune. Its default is what FalconSettings{} holds.
struct FalconNumber {
    FalconTopic topic;
    std::string_view name;  ///< "thigh", in the settings file
    const char* label;      ///< "Thigh (a)", for the panel
    const char* format;     ///< printf format of the panel, with the unit
    double shown;           ///< panel units in a stored one: 1000 for metres shown as millimetres
    double lowest;          ///< stored unit; every value of the range is safe
    double highest;
    const char* help;  ///< meaning, and where the default comes from
    double& (*in)(FalconSettings&);
};

/// Every number of falcon::WorkspaceOptions, falcon::Motors and falcon::Geometry.
[[nodiscard]] std::span<const FalconNumber> falcon_numbers() noexcept;

/// The numbers and the clutch as the device takes them; `centred` is counted by the viewer.
[[nodiscard]] falcon::Tuning tuning_of(const FalconSettings& settings,
                                       std::uint32_t centred) noexcept;

}  // namespace dibhr
