// Names of the actions of device buttons, and the program's actions that they perform.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "app/settings/keys.hpp"
#include "core/haptics/enum_names.hpp"
#include "device/hand/button_actions.hpp"

namespace dibhr {

/// An action that a button can have.
struct ButtonJob : NamedValue<ButtonAction> {
    std::optional<Action> perform{};  ///< nothing: the device does it, or there is no action
};

/// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const ButtonJob> button_jobs() noexcept;

[[nodiscard]] const char* name_of(ButtonAction action) noexcept;
[[nodiscard]] std::optional<ButtonAction> button_action_named(std::string_view name) noexcept;

}  // namespace dibhr
