// What the jobs of a grip's buttons are called, and what they ask of the program.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "app/settings/keys.hpp"
#include "core/haptics/words.hpp"
#include "device/hand/grip_buttons.hpp"

namespace dibhr {

/// One thing that a button can do.
struct ButtonJob : Word<ButtonAction> {
    std::optional<Action> perform{};  ///< nothing: the device itself does it, or nobody
};

/// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const ButtonJob> button_jobs() noexcept;

[[nodiscard]] const char* name_of(ButtonAction action) noexcept;
[[nodiscard]] std::optional<ButtonAction> button_action_named(std::string_view name) noexcept;

}  // namespace dibhr
