// What the state of the force devices means.
#include "app/touching/device_state.hpp"

#include <algorithm>
#include <cstddef>

#include "device/force_devices.hpp"

namespace dibhr {

const DeviceInfo* touching_device(const TouchState& touch) {
    const auto found =
        std::find_if(touch.devices.begin(), touch.devices.end(), [&touch](const DeviceInfo& info) {
            return info.kind + 1 == std::size_t{touch.haptic.hand.device_number};
        });
    return found == touch.devices.end() ? nullptr : &*found;
}

// In a replay no device is read.

bool a_device_touches(const TouchState& touch) {
    const DeviceInfo* const device = touching_device(touch);
    return !touch.replay && device != nullptr && device->state.ready &&
           !touch.haptic.hand.mouse_fallback;
}

bool may_touch(const TouchState& touch) {
    return !touch.replay &&
           std::any_of(touch.devices.begin(), touch.devices.end(), [](const DeviceInfo& info) {
               return !info.answered || info.was_ready || info.state.may_be_ready;
           });
}

bool attached_or_expected(const DeviceInfo& info) {
    return !info.state.absent || info.state.trouble || info.was_ready;
}

std::string touching_text(const TouchState& touch) {
    const DeviceInfo* const device = touching_device(touch);
    if (device == nullptr || touch.haptic.hand.mouse_fallback) return "the mouse, meanwhile";
    return std::string("the ") + force_device_kinds()[device->kind]->short_name;
}

std::string missing_text(const TouchState& touch) {
    if (touch.replay || a_device_touches(touch)) return {};
    for (const DeviceInfo& info : touch.devices) {
        const DeviceState& state = info.state;
        const bool lost = state.absent && (info.was_ready || state.trouble);
        if ((lost || state.needs_person) && !state.sentence.empty()) return state.sentence;
    }
    return {};
}

}  // namespace dibhr
