// The table of the actions of device buttons.
#include "app/settings/button_action_names.hpp"

#include <array>
#include <cstddef>

namespace dibhr {

namespace {

constexpr std::array<ButtonJob, 9> kButtonJobs{{
    {{ButtonAction::none, "none", "Nothing"}},
    {{ButtonAction::clutch, "clutch", "Hold the point (clutch)"}},
    {{ButtonAction::record, "record", "Record, stop"}, Action::record},
    {{ButtonAction::play_or_pause, "play-or-pause", "Play, pause"}, Action::play_or_pause},
    {{ButtonAction::force_off, "force-off", "Force off"}, Action::force_off},
    {{ButtonAction::toggle_force, "toggle-force", "Force off, on"}, Action::toggle_force},
    {{ButtonAction::centre_workspace, "centre", "Centre the workspace"}, Action::centre_workspace},
    {{ButtonAction::go_to_start, "go-to-start", "To the start"}, Action::go_to_start},
    {{ButtonAction::take_screenshot, "screenshot", "Save a picture"}, Action::take_screenshot},
}};
static_assert(has_all_in_order(kButtonJobs, ButtonAction::take_screenshot));

}  // namespace

std::span<const ButtonJob> button_jobs() noexcept {
    return kButtonJobs;
}

const char* name_of(ButtonAction action) noexcept {
    return entry_of(kButtonJobs, action).name;
}

std::optional<ButtonAction> button_action_named(std::string_view name) noexcept {
    return value_named(kButtonJobs, name);
}

}  // namespace dibhr
