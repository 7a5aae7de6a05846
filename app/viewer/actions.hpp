// What each action of the key table does.
#pragma once

#include "app/panels/viewer_state.hpp"
#include "app/settings/keys.hpp"
#include "core/replay/session_player.hpp"

namespace dibhr {

void perform(Action action, ViewerState& state, Player& player);

/// What moves a replay, and nothing else; false when the action is not about that.
bool perform_in_replay(Action action, SessionPlayer& replay);

}  // namespace dibhr
