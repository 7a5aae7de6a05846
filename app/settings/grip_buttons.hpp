// What the buttons of a device's grip can do, whichever device it is.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "app/settings/keys.hpp"
#include "core/haptics/words.hpp"
#include "device/hand/buttons.hpp"

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

/// Of every button what it does, bit 0 first.
using ButtonActions = std::array<ButtonAction, kGripButtonCount>;
using GripButtons = std::array<GripButton, kGripButtonCount>;

[[nodiscard]] constexpr ButtonActions standard_actions(const GripButtons& grip) {
    ButtonActions actions{};
    for (std::size_t k = 0; k < actions.size(); ++k) actions[k] = grip[k].standard;
    return actions;
}

/// Bits of the buttons that have this job.
[[nodiscard]] std::uint8_t buttons_for(ButtonAction action, const ButtonActions& actions) noexcept;

/// Which presses have been acted on.
class TakenPresses {
  public:
    /// What those that came since the last call ask for.
    [[nodiscard]] std::vector<Action> take(const ButtonPresses& presses,
                                           const ButtonActions& actions);

  private:
    ButtonPresses taken_{};
};

}  // namespace dibhr
