// Force devices, with the mouse as fallback while none of them is ready.
#include "device/device_or_mouse.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace dibhr {

DeviceOrMouse::DeviceOrMouse(Devices devices)
    : devices_(std::move(devices)), readings_(devices_.size()) {
    assert(std::any_of(devices_.begin(), devices_.end(),
                       [](const auto& one) { return one != nullptr; }));
}

const DeviceSpecification& DeviceOrMouse::specification() const noexcept {
    return (*std::find_if(devices_.begin(), devices_.end(),
                          [](const auto& one) { return one != nullptr; }))
        ->specification();
}

HandReading DeviceOrMouse::reading_without_surface() const noexcept {
    return of_mouse(mouse_.reading_without_surface());
}

HandReading DeviceOrMouse::read(const HandContext& context) noexcept {
    // Each device is read in every tick, so that its pose is new when it takes over.
    for (std::size_t k = 0; k < devices_.size(); ++k) {
        if (devices_[k]) readings_[k] = devices_[k]->read(context);
    }
    const std::size_t before = std::exchange(touching_, next_hand());
    if (touching_ == kMouse && touching_ != before) mouse_.forget_clicks();
    HandReading reading =
        touching_ == kMouse ? of_mouse(mouse_.read(context)) : readings_[touching_ - 1];
    reading.device_number = static_cast<std::uint8_t>(touching_);
    reading.hand_changed = reading.hand_changed || touching_ != before;
    return reading;
}

bool DeviceOrMouse::can_touch(std::size_t device_number) const noexcept {
    return device_number != kMouse && devices_[device_number - 1] &&
           devices_[device_number - 1]->can_touch();
}

/// The device that touches keeps touching while it can.
std::size_t DeviceOrMouse::next_hand() const noexcept {
    if (can_touch(touching_)) return touching_;
    std::size_t device_number = 1;
    while (device_number <= devices_.size() && !can_touch(device_number)) ++device_number;
    return device_number <= devices_.size() ? device_number : kMouse;
}

HandReading DeviceOrMouse::of_mouse(HandReading reading) const noexcept {
    reading.mouse_fallback = true;
    reading.limits = mouse_.specification().limits;
    return reading;
}

void DeviceOrMouse::send(Vec3 force_newton) noexcept {
    const auto for_hand = [&](std::size_t device_number) {
        return touching_ == device_number ? force_newton : Vec3{0.0};
    };
    for (std::size_t k = 0; k < devices_.size(); ++k) {
        if (devices_[k]) devices_[k]->send(for_hand(k + 1));
    }
    mouse_.send(for_hand(kMouse));
}

}  // namespace dibhr
