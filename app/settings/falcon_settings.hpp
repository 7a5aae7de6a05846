// What is kept about the Falcon: the constants that sources disagree on, its workspace, its
// buttons.
#pragma once

#include <cstdint>
#include <span>

#include "app/settings/device_number.hpp"
#include "app/settings/grip_buttons.hpp"
#include "device/falcon/status.hpp"

namespace dibhr {

/// In the order of falcon::Status::presses.
inline constexpr GripButtons kFalconGrip{
    {{"button-plus", "Plus (right)", ButtonAction::record},
     {"button-forward", "Forward (top)", ButtonAction::play_or_pause},
     {"button-centre", "Centre (logo)", ButtonAction::clutch},
     {"button-minus", "Minus (left)", ButtonAction::force_off}}};

struct FalconSettings {
    falcon::ConnectionOptions connection{};  ///< used from the next start of the program
    falcon::Geometry geometry{};
    falcon::Motors motors{};
    WorkspaceOptions workspace{};
    ButtonActions buttons{standard_actions(kFalconGrip)};
};

/// What a number is about: a heading of the panel.
enum class FalconTopic { workspace, motors, geometry };

using FalconNumber = DeviceNumber<FalconSettings, FalconTopic>;

/// Every number of WorkspaceOptions, falcon::Motors and falcon::Geometry.
[[nodiscard]] std::span<const FalconNumber> falcon_numbers() noexcept;

/// The numbers and the clutch as the device takes them; `centred` is counted by the viewer.
[[nodiscard]] falcon::Tuning tuning_of(const FalconSettings& settings,
                                       std::uint32_t centred) noexcept;

}  // namespace dibhr
