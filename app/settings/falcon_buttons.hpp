// What the Falcon's four buttons do: one table drives the settings file, the panel and the viewer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "app/settings/keys.hpp"
#include "core/haptics/words.hpp"

namespace dibhr {

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

/// One thing that a button can do.
struct ButtonJob : Word<ButtonAction> {
    std::optional<Action> perform{};  ///< nothing: the device itself does it, or nobody
};

/// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const ButtonJob> button_jobs() noexcept;

[[nodiscard]] const char* name_of(ButtonAction action) noexcept;
[[nodiscard]] std::optional<ButtonAction> button_action_named(std::string_view name) noexcept;

/// One button of the grip.
struct GripButton {
    std::string_view setting;  ///< in the settings file
    const char* label;         ///< in the panel
    ButtonAction standard;
};

/// In the order of falcon::Status::presses.
inline constexpr std::array kGripButtons{
    GripButton{"button-plus", "Plus (right)", ButtonAction::record},
    GripButton{"button-forward", "Forward (top)", ButtonAction::play_or_pause},
    GripButton{"button-centre", "Centre (logo)", ButtonAction::clutch},
    GripButton{"button-minus", "Minus (left)", ButtonAction::force_off}};
inline constexpr std::size_t kFalconButtons = kGripButtons.size();

using ButtonActions = std::array<ButtonAction, kFalconButtons>;

inline constexpr ButtonActions kStandardButtons = [] {
    ButtonActions actions{};
    for (std::size_t k = 0; k < actions.size(); ++k) actions[k] = kGripButtons[k].standard;
    return actions;
}();

/// Bits of falcon::Button whose button has this job.
[[nodiscard]] std::uint8_t buttons_for(ButtonAction action, const ButtonActions& actions) noexcept;

}  // namespace dibhr
