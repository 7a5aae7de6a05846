// What the state of the force devices means.
#include "app/touching/device_state.hpp"

namespace dibhr {

namespace {

template <typename News>
bool is_ready(const News& news) {
    return news.status.stage == decltype(news.status.stage)::ready;
}

/// None is there.
bool is_absent(const FalconNews& news) {
    return news.status.stage == falcon::Stage::looking;
}
bool is_absent(const Inverse3News& news) {
    using inverse3::Stage;
    return news.status.stage == Stage::looking || news.status.stage == Stage::no_device;
}

/// Before the next picture.
bool may_be_ready(const FalconNews& news) {
    return is_ready(news) || news.status.stage == falcon::Stage::homing;
}
bool may_be_ready(const Inverse3News& news) {
    return !news.status.id.empty();
}

/// It did so in the last tick that is known of.
template <typename News>
bool touches(const TouchState& touch, const News& news, Touching as) {
    return is_ready(news) && !touch.haptic.hand.stand_in && touching(touch) == as;
}

template <typename News>
bool in_sight(const TouchState& touch, const News& news, Touching as) {
    return !is_absent(news) || news.status.trouble || news.was_ready || touches(touch, news, as);
}

/// Whether that is so of a device. In a replay none is there.
template <typename Is>
bool any_device(const TouchState& touch, Is is) {
    if (touch.replay) return false;
    return (touch.falcon && is(*touch.falcon, Touching::falcon)) ||
           (touch.inverse3 && is(*touch.inverse3, Touching::inverse3));
}

}  // namespace

Touching touching(const TouchState& touch) {
    return static_cast<Touching>(touch.haptic.hand.which);
}

bool a_device_touches(const TouchState& touch) {
    return any_device(touch,
                      [&](const auto& news, Touching as) { return touches(touch, news, as); });
}

bool may_touch(const TouchState& touch) {
    return any_device(touch, [](const auto& news, Touching) {
        return !news.asked || news.was_ready || may_be_ready(news);
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
    return touch.falcon && in_sight(touch, *touch.falcon, Touching::falcon);
}

bool inverse3_in_sight(const TouchState& touch) {
    return touch.inverse3 && in_sight(touch, *touch.inverse3, Touching::inverse3);
}

const char* touching_text(const TouchState& touch) {
    if (touch.haptic.hand.stand_in) return "the mouse, meanwhile";
    return touching(touch) == Touching::inverse3 ? "the Inverse3" : "the Falcon";
}

std::string lacking_text(const TouchState& touch) {
    if (a_device_touches(touch)) return {};
    std::string text;
    static_cast<void>(any_device(touch, [&text](const auto& news, Touching) {
        const bool lost = is_absent(news) && (news.was_ready || news.status.trouble);
        if (lost || needs_its_person(news.status.stage)) text = news.status.sentence;
        return !text.empty();
    }));
    return text;
}

}  // namespace dibhr
