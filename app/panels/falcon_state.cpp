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

const DeviceLimits& limits_of_hand(const ViewerState& state) {
    const auto& now = state.haptic.hand.limits;
    return now ? *now : state.device.limits;
}

Coupling asked_coupling(const ViewerState& state) {
    const Settings& settings = state.settings;
    const Coupling& chosen = settings.touch.coupling;
    if (state.replay || !settings.stability || !settings.damping_as_needed) return chosen;
    const DeviceLimits& hand = limits_of_hand(state);
    const double felt_stiffness = held_coupling(chosen, hand).stiffness_newton_per_mm;
    return stable_coupling(chosen, felt_stiffness, hand.dynamics);
}

Coupling felt_coupling(const ViewerState& state) {
    const Coupling asked = asked_coupling(state);
    if (!may_touch(state)) return asked;
    return held_coupling(asked,
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

bool in_sight(const ViewerState& state) {
    if (!state.falcon) return false;
    const FalconNews& news = *state.falcon;
    return news.status.stage != Stage::looking || news.status.trouble || news.was_ready ||
           !state.haptic.hand.stand_in;
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
