// A force device that the mouse stands in for while it is not ready.
#include "device/device_or_mouse.hpp"

#include <cassert>
#include <utility>

namespace dibhr {

DeviceOrMouse::DeviceOrMouse(std::unique_ptr<falcon::FalconDevice> falcon,
                             std::unique_ptr<inverse3::Inverse3Device> inverse3)
    : falcon_(std::move(falcon)), inverse3_(std::move(inverse3)) {
    assert(falcon_ || inverse3_);
}

const DeviceSpecification& DeviceOrMouse::specification() const noexcept {
    return falcon_ ? falcon_->specification() : inverse3_->specification();
}

HandReading DeviceOrMouse::unread() const noexcept {
    return of_mouse(mouse_.unread());
}

HandReading DeviceOrMouse::read(const HandContext& context) noexcept {
    // Each is read in every tick, so that it is up to date when its turn comes.
    const HandReading of_falcon = falcon_ ? falcon_->read(context) : HandReading{};
    const HandReading of_inverse3 = inverse3_ ? inverse3_->read(context) : HandReading{};
    const bool changed = std::exchange(touching_, next_hand()) != touching_;
    HandReading reading = touching_ == Touching::falcon     ? of_falcon
                          : touching_ == Touching::inverse3 ? of_inverse3
                                                            : of_mouse(mouse_.read(context));
    reading.which = static_cast<std::uint8_t>(touching_);
    reading.taken_over = reading.taken_over || changed;
    return reading;
}

bool DeviceOrMouse::in_hand(Touching hand) const noexcept {
    if (hand == Touching::falcon) return falcon_ && falcon_->in_hand();
    return hand == Touching::inverse3 && inverse3_ && inverse3_->in_hand();
}

/// Whoever touches goes on while it can.
Touching DeviceOrMouse::next_hand() const noexcept {
    if (in_hand(touching_)) return touching_;
    if (in_hand(Touching::falcon)) return Touching::falcon;
    return in_hand(Touching::inverse3) ? Touching::inverse3 : Touching::mouse;
}

HandReading DeviceOrMouse::of_mouse(HandReading reading) const noexcept {
    reading.stand_in = true;
    reading.limits = mouse_.specification().limits;
    return reading;
}

void DeviceOrMouse::send(Vec3 force_newton) noexcept {
    const auto for_hand = [&](Touching hand) {
        return touching_ == hand ? force_newton : Vec3{0.0};
    };
    if (falcon_) falcon_->send(for_hand(Touching::falcon));
    if (inverse3_) inverse3_->send(for_hand(Touching::inverse3));
    mouse_.send(for_hand(Touching::mouse));
}

}  // namespace dibhr
