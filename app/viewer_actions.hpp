// What each action of the key table does.
#pragma once

#include "app/keys.hpp"
#include "app/viewer_state.hpp"

namespace dibhr {

void perform(Action action, ViewerState& state, Player& player);

}  // namespace dibhr
