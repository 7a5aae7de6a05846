// What the jobs of a grip's buttons are called, and what they ask of the program.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

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

/// A button of a grip that went down.
struct GripPress {
    int button{0};  ///< of the device, from 0
    ButtonAction action{ButtonAction::none};
    std::uint32_t times{1};
    std::chrono::steady_clock::time_point at{};  ///< the last time
};

/// Which presses have been acted on.
class TakenPresses {
  public:
    /// Adds those that came since the last call, the lowest button first.
    void take(const ButtonPresses& presses, const ButtonPressTimes& at,
              const ButtonActions& actions, std::vector<GripPress>& into);

  private:
    ButtonPresses taken_{};
};

}  // namespace dibhr
