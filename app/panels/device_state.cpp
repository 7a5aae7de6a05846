// What the state of the force devices means for the force.
#include "app/panels/device_state.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "device/device_or_mouse.hpp"

namespace dibhr {

namespace {

/// What counts of a device's news, whichever device it is.
struct Seen {
    Touching as{};
    bool asked{false};
    bool was_ready{false};
    bool ready{false};
    bool may_be_ready{false};  ///< before the next picture
    bool absent{false};        ///< none is there
    bool needs_person{false};
    bool trouble{false};
    const std::string* sentence{nullptr};
};

using AllSeen = std::array<std::optional<Seen>, 2>;

Seen seen(const FalconNews& news) {
    using falcon::Stage;
    const Stage stage = news.status.stage;
    const bool ready = stage == Stage::ready;
    return {Touching::falcon,
            news.asked,
            news.was_ready,
            ready,
            ready || stage == Stage::homing,
            stage == Stage::looking,
            needs_its_person(stage),
            news.status.trouble,
            &news.status.sentence};
}

Seen seen(const Inverse3News& news) {
    using inverse3::Stage;
    const Stage stage = news.status.stage;
    const bool absent = stage == Stage::looking || stage == Stage::no_device;
    return {Touching::inverse3,      news.asked, news.was_ready,          stage == Stage::ready,
            !news.status.id.empty(), absent,     needs_its_person(stage), news.status.trouble,
            &news.status.sentence};
}

/// In a replay no device is there.
AllSeen all_seen(const ViewerState& state) {
    AllSeen all;
    if (state.replay) return all;
    if (state.falcon) all[0] = seen(*state.falcon);
    if (state.inverse3) all[1] = seen(*state.inverse3);
    return all;
}

/// A device touches, or may begin to before the next picture: that can be a slow one, as the first
/// is. One that was lost comes back without a word.
bool may_touch(const ViewerState& state) {
    const AllSeen all = all_seen(state);
    return std::any_of(all.begin(), all.end(), [](const std::optional<Seen>& one) {
        return one && (!one->asked || one->was_ready || one->may_be_ready);
    });
}

Touching touching(const ViewerState& state) {
    return static_cast<Touching>(state.haptic.hand.which);
}

/// It did so in the last tick that is known of.
bool touches(const ViewerState& state, const Seen& one) {
    return one.ready && !state.haptic.hand.stand_in && touching(state) == one.as;
}

bool a_device_touches(const ViewerState& state) {
    const AllSeen all = all_seen(state);
    return std::any_of(all.begin(), all.end(),
                       [&](const std::optional<Seen>& one) { return one && touches(state, *one); });
}

bool in_sight(const ViewerState& state, const Seen& one) {
    return !one.absent || one.trouble || one.was_ready || touches(state, one);
}

/// What that device lacks; empty: nothing that has to be said.
std::string banner_of(const Seen& one) {
    const bool lost = one.absent && (one.was_ready || one.trouble);
    return lost || one.needs_person ? *one.sentence : std::string{};
}

double scale_of_hand(const ViewerState& state) {
    const bool inverse3_alone = state.inverse3 && !state.falcon;
    return inverse3_alone || touching(state) == Touching::inverse3
               ? state.settings.inverse3.tuning.workspace.scale
               : state.settings.falcon.workspace.scale;
}

}  // namespace

bool needs_its_person(falcon::Stage stage) {
    return stage != falcon::Stage::looking && stage != falcon::Stage::ready;
}

bool needs_its_person(inverse3::Stage stage) {
    using inverse3::Stage;
    return stage != Stage::looking && stage != Stage::no_device && stage != Stage::ready;
}

const DeviceLimits& limits_of_hand(const ViewerState& state) {
    const auto& now = state.haptic.hand.limits;
    return now ? *now : state.device.limits;
}

HapticSettings asked_settings(const ViewerState& state) {
    HapticSettings asked{
        .parameters = state.settings.touch,
        .limits = {.max_force_newton = state.settings.max_force_newton,
                   .stability = state.settings.stability},
        .force_enabled = state.force_enabled && !waits_for_front(state),
        .bump = state.bump,
    };
    asked.parameters.coupling = asked_coupling(state);
    return asked;
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
    // The loop knows the device's delay, too.
    if (a_device_touches(state)) return held_coupling(asked, limits_of_hand(state));
    return held_coupling(asked, at_scale(state.device.limits, scale_of_hand(state)));
}

bool waits_for_front(const ViewerState& state) {
    return !state.in_front && state.settings.falcon.force_in_front_only && may_touch(state);
}

bool clutched(const ViewerState& state) {
    if (!a_device_touches(state)) return false;
    const Settings& settings = state.settings;
    const ButtonActions& buttons =
        touching(state) == Touching::inverse3 ? settings.inverse3.buttons : settings.falcon.buttons;
    return (state.haptic.hand.buttons & unsigned{buttons_for(ButtonAction::clutch, buttons)}) != 0;
}

bool falcon_in_sight(const ViewerState& state) {
    return state.falcon && in_sight(state, seen(*state.falcon));
}

bool inverse3_in_sight(const ViewerState& state) {
    return state.inverse3 && in_sight(state, seen(*state.inverse3));
}

bool without_pose(const ViewerState& state) {
    return a_device_touches(state);
}

const char* touching_text(const ViewerState& state) {
    if (state.haptic.hand.stand_in) return "the mouse, meanwhile";
    return touching(state) == Touching::inverse3 ? "the Inverse3" : "the Falcon";
}

std::string device_banner(const ViewerState& state) {
    if (state.force_enabled && a_device_touches(state) && waits_for_front(state)) {
        return "force off: the window is not in front. Click it, and the force rises again";
    }
    // Where one touches, nothing is lacking.
    if (a_device_touches(state)) return {};
    for (const std::optional<Seen>& one : all_seen(state)) {
        if (!one) continue;
        if (std::string banner = banner_of(*one); !banner.empty()) return banner;
    }
    return {};
}

}  // namespace dibhr
