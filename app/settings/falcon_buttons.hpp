// What the Falcon's four buttons do: one table drives the settings file, the panel and the viewer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "app/settings/keys.hpp"

namespace dibhr {

/// In the order of the grip's buttons in falcon::Status::presses: plus, forward, centre, minus.
inline constexpr std::size_t kFalconButtons = 4;

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
struct ButtonJob {
    ButtonAction action;
    std::string_view name;          ///< "play-or-pause", in the settings file
    const char* label;              ///< "Play, pause", in the panel
    std::optional<Action> perform;  ///< nothing: the device itself does it, or nobody
};

/// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const ButtonJob> button_jobs() noexcept;

[[nodiscard]] const char* name_of(ButtonAction action) noexcept;
[[nodiscard]] std::optional<ButtonAction> button_action_named(std::string_view name) noexcept;

using ButtonActions = std::array<ButtonAction, kFalconButtons>;

/// Plus: record; forward: play, pause; centre: clutch; minus: force off.
inline constexpr ButtonActions kStandardButtons{ButtonAction::record, ButtonAction::play_or_pause,
                                                ButtonAction::clutch, ButtonAction::force_off};

/// Bits of falcon::Button whose button has this job.
[[nodiscard]] std::uint8_t buttons_for(ButtonAction action, const ButtonActions& actions) noexcept;

}  // namespace dibhr
