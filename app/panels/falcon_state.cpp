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

/// What a Falcon can stand at the scale that is chosen.
DeviceLimits falcon_limits(const ViewerState& state) {
    return at_scale(state.device.limits, state.settings.falcon.workspace.scale);
}

}  // namespace

bool needs_its_person(falcon::Stage stage) {
    return stage != Stage::looking && stage != Stage::ready;
}

TouchParameters touch_parameters(const ViewerState& state) {
    TouchParameters parameters = state.settings.touch;
    if (may_touch(state)) {
        parameters.coupling = held_coupling(parameters.coupling, falcon_limits(state));
    }
    return parameters;
}

SafetyLimits safety_limits(const ViewerState& state) {
    // The mouse's hand is as fast at any scale, so that it keeps its limit while it stands in.
    return held_limits({.max_force_newton = state.settings.max_force_newton},
                       touches(state) ? falcon_limits(state) : state.device.limits);
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
