// What the state of the Falcon means for the force.
#include "app/panels/falcon_state.hpp"

namespace dibhr {

namespace {

using falcon::Stage;

/// It touches, or may begin to before the next picture: that can be a slow one, as the first is.
/// One that was lost comes back without a word.
bool may_touch(const ViewerState& state) {
    if (!state.falcon || state.replay) return false;
    const FalconNews& news = *state.falcon;
    return !news.asked || news.was_ready || news.status.stage == Stage::homing ||
           news.status.stage == Stage::ready;
}

/// It did so in the last tick that is known of.
bool touches(const ViewerState& state) {
    return state.falcon && !state.replay && state.falcon->status.stage == Stage::ready &&
           !state.haptic.hand.stand_in;
}

}  // namespace

bool needs_its_person(falcon::Stage stage) {
    return stage != Stage::looking && stage != Stage::ready;
}

Coupling felt_coupling(const ViewerState& state) {
    const Coupling& wished = state.settings.touch.coupling;
    if (!may_touch(state)) return wished;
    return held_coupling(wished,
                         at_scale(state.device.limits, state.settings.falcon.workspace.scale));
}

bool waits_for_front(const ViewerState& state) {
    return !state.in_front && state.settings.falcon.force_in_front_only && may_touch(state);
}

bool clutched(const ViewerState& state) {
    const unsigned held =
        state.haptic.hand.buttons &
        unsigned{buttons_for(ButtonAction::clutch, state.settings.falcon.buttons)};
    return touches(state) && held != 0;
}

std::string falcon_banner(const ViewerState& state) {
    if (!state.falcon || state.replay) return {};
    if (touches(state) && state.force_enabled && waits_for_front(state)) {
        return "force off: the window is not in front. Click it, and the force rises again";
    }
    const FalconNews& news = *state.falcon;
    const bool lost =
        news.status.stage == Stage::looking && (news.was_ready || news.status.trouble);
    return lost || needs_its_person(news.status.stage) ? news.status.sentence : std::string{};
}

}  // namespace dibhr
