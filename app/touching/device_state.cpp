// What the state of the force devices means.
#include "app/touching/device_state.hpp"

#include <algorithm>
#include <array>
#include <optional>

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
AllSeen all_seen(const TouchState& touch) {
    AllSeen all;
    if (touch.replay) return all;
    if (touch.falcon) all[0] = seen(*touch.falcon);
    if (touch.inverse3) all[1] = seen(*touch.inverse3);
    return all;
}

/// It did so in the last tick that is known of.
bool touches(const TouchState& touch, const Seen& one) {
    return one.ready && !touch.haptic.hand.stand_in && touching(touch) == one.as;
}

bool in_sight(const TouchState& touch, const Seen& one) {
    return !one.absent || one.trouble || one.was_ready || touches(touch, one);
}

}  // namespace

Touching touching(const TouchState& touch) {
    return static_cast<Touching>(touch.haptic.hand.which);
}

bool a_device_touches(const TouchState& touch) {
    const AllSeen all = all_seen(touch);
    return std::any_of(all.begin(), all.end(),
                       [&](const std::optional<Seen>& one) { return one && touches(touch, *one); });
}

bool may_touch(const TouchState& touch) {
    const AllSeen all = all_seen(touch);
    return std::any_of(all.begin(), all.end(), [](const std::optional<Seen>& one) {
        return one && (!one->asked || one->was_ready || one->may_be_ready);
    });
}

bool needs_its_person(falcon::Stage stage) {
    return stage != falcon::Stage::looking && stage != falcon::Stage::ready;
}

bool needs_its_person(inverse3::Stage stage) {
    using inverse3::Stage;
    return stage != Stage::looking && stage != Stage::no_device && stage != Stage::ready;
}

bool falcon_in_sight(const TouchState& touch) {
    return touch.falcon && in_sight(touch, seen(*touch.falcon));
}

bool inverse3_in_sight(const TouchState& touch) {
    return touch.inverse3 && in_sight(touch, seen(*touch.inverse3));
}

const char* touching_text(const TouchState& touch) {
    if (touch.haptic.hand.stand_in) return "the mouse, meanwhile";
    return touching(touch) == Touching::inverse3 ? "the Inverse3" : "the Falcon";
}

std::string lacking_text(const TouchState& touch) {
    if (a_device_touches(touch)) return {};
    for (const std::optional<Seen>& one : all_seen(touch)) {
        if (!one) continue;
        const bool lost = one->absent && (one->was_ready || one->trouble);
        if ((lost || one->needs_person) && !one->sentence->empty()) return *one->sentence;
    }
    return {};
}

}  // namespace dibhr
