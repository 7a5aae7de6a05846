// The table of what a button can do.
#include "app/settings/falcon_buttons.hpp"

#include <algorithm>

namespace dibhr {
namespace {

constexpr std::array kJobs{
    ButtonJob{ButtonAction::none, "none", "Nothing", {}},
    ButtonJob{ButtonAction::clutch, "clutch", "Hold the point (clutch)", {}},
    ButtonJob{ButtonAction::record, "record", "Record, stop", Action::record},
    ButtonJob{ButtonAction::play_or_pause, "play-or-pause", "Play, pause", Action::play_or_pause},
    ButtonJob{ButtonAction::force_off, "force-off", "Force off", Action::force_off},
    ButtonJob{ButtonAction::toggle_force, "toggle-force", "Force off, on", Action::toggle_force},
    ButtonJob{ButtonAction::centre_workspace, "centre", "Centre the hand",
              Action::centre_workspace},
    ButtonJob{ButtonAction::go_to_start, "go-to-start", "To the start", Action::go_to_start},
    ButtonJob{ButtonAction::take_screenshot, "screenshot", "Save a picture",
              Action::take_screenshot},
};

}  // namespace

std::span<const ButtonJob> button_jobs() noexcept {
    return kJobs;
}

const char* name_of(ButtonAction action) noexcept {
    return kJobs[static_cast<std::size_t>(action)].name.data();
}

std::optional<ButtonAction> button_action_named(std::string_view name) noexcept {
    const auto* const job = std::find_if(kJobs.begin(), kJobs.end(),
                                         [name](const ButtonJob& one) { return one.name == name; });
    if (job == kJobs.end()) return {};
    return job->action;
}

std::uint8_t buttons_for(ButtonAction action, const ButtonActions& actions) noexcept {
    std::uint8_t bits = 0;
    for (std::size_t k = 0; k < actions.size(); ++k) {
        if (actions[k] == action) bits = static_cast<std::uint8_t>(bits | 1U << k);
    }
    return bits;
}

}  // namespace dibhr
