// The actions that the buttons of any force device can have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "device/hand/buttons.hpp"

namespace dibhr {

/// Which values of a setting protect the hand less than the default: they need consent.
enum class WeakerWhen : std::uint8_t { higher, lower, other };
struct Protection {
    WeakerWhen weaker_when;
    const char* what;  ///< name shown to the user: "Falcon's gear"
};

/// Action of a device's button.
enum class ButtonAction {
    none,
    clutch,
    record,
    play_or_pause,
    force_off,
    toggle_force,
    centre_workspace,
    go_to_start,
    take_screenshot
};

/// One button of a device; empty `setting`: the device does not have this button.
struct DeviceButton {
    std::string_view setting{};  ///< in the settings file
    const char* label{""};       ///< in the panel
    ButtonAction standard{ButtonAction::none};
    std::optional<Protection> protection{};
};

/// The action of every button, bit 0 first.
using ButtonActions = std::array<ButtonAction, kDeviceButtonCount>;
using DeviceButtons = std::array<DeviceButton, kDeviceButtonCount>;

[[nodiscard]] constexpr ButtonActions standard_actions(const DeviceButtons& grip) noexcept {
    ButtonActions actions{};
    for (std::size_t k = 0; k < actions.size(); ++k) actions[k] = grip[k].standard;
    return actions;
}

/// Bits of the buttons that have this action.
[[nodiscard]] constexpr std::uint8_t buttons_for(ButtonAction action,
                                                 const ButtonActions& actions) noexcept {
    std::uint8_t bits = 0;
    for (std::size_t k = 0; k < actions.size(); ++k) {
        if (actions[k] == action) bits = static_cast<std::uint8_t>(bits | 1U << k);
    }
    return bits;
}

}  // namespace dibhr
