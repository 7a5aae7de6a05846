// What is kept about the Falcon: the constants that sources disagree on, its workspace, its
// buttons.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "app/settings/keys.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/words.hpp"
#include "core/loop/device.hpp"
#include "device/falcon/status.hpp"

namespace dibhr {

/// What a button of the grip can do.
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

struct FalconSettings {
    falcon::ConnectionOptions connection{};  ///< used from the next start of the program
    falcon::Geometry geometry{};
    falcon::Motors motors{};
    WorkspaceOptions workspace{};
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

/// Every number of WorkspaceOptions, falcon::Motors and falcon::Geometry.
[[nodiscard]] std::span<const FalconNumber> falcon_numbers() noexcept;

/// The numbers and the clutch as the device takes them; `centred` is counted by the viewer.
[[nodiscard]] falcon::Tuning tuning_of(const FalconSettings& settings,
                                       std::uint32_t centred) noexcept;

/// Bits of falcon::Button whose button has this job.
[[nodiscard]] std::uint8_t buttons_for(ButtonAction action, const ButtonActions& actions) noexcept;

}  // namespace dibhr
