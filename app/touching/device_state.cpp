// What the state of the force devices means.
#include "app/touching/device_state.hpp"

#include <algorithm>
#include <cstddef>

#include "device/force_devices.hpp"

namespace dibhr {

const DeviceNews* touching_device(const TouchState& touch) {
    const auto found =
        std::find_if(touch.devices.begin(), touch.devices.end(), [&touch](const DeviceNews& news) {
            return news.kind + 1 == std::size_t{touch.haptic.hand.which};
        });
    return found == touch.devices.end() ? nullptr : &*found;
}

// In a replay no device is read.

bool a_device_touches(const TouchState& touch) {
    const DeviceNews* const device = touching_device(touch);
    return !touch.replay && device != nullptr && device->state.ready && !touch.haptic.hand.stand_in;
}

bool may_touch(const TouchState& touch) {
    return !touch.replay &&
           std::any_of(touch.devices.begin(), touch.devices.end(), [](const DeviceNews& news) {
               return !news.asked || news.was_ready || news.state.may_be_ready;
           });
}

bool in_sight(const DeviceNews& news) {
    return !news.state.absent || news.state.trouble || news.was_ready;
}

std::string touching_text(const TouchState& touch) {
    const DeviceNews* const device = touching_device(touch);
    if (device == nullptr || touch.haptic.hand.stand_in) return "the mouse, meanwhile";
    return std::string("the ") + force_device_kinds()[device->kind]->called;
}

std::string lacking_text(const TouchState& touch) {
    if (touch.replay || a_device_touches(touch)) return {};
    for (const DeviceNews& news : touch.devices) {
        const DeviceState& state = news.state;
        const bool lost = state.absent && (news.was_ready || state.trouble);
        if ((lost || state.needs_person) && !state.sentence.empty()) return state.sentence;
    }
    return {};
}

}  // namespace dibhr
