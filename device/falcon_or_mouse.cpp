// A Falcon that the mouse stands in for while it is not ready.
#include "device/falcon_or_mouse.hpp"

#include <utility>

namespace dibhr {

FalconOrMouse::FalconOrMouse(falcon::ConnectionOptions options, falcon::FirmwareImage firmware)
    : falcon_(std::move(options), std::move(firmware)) {}

const DeviceSpecification& FalconOrMouse::specification() const noexcept {
    return falcon_.specification();
}

HandReading FalconOrMouse::unread() const noexcept {
    return of_mouse(mouse_.unread());
}

HandReading FalconOrMouse::read(const HandContext& context) noexcept {
    HandReading reading = falcon_.read(context);
    const bool changed = std::exchange(falcon_touches_, falcon_.in_hand()) != falcon_.in_hand();
    if (!falcon_touches_) reading = of_mouse(mouse_.read(context));
    reading.taken_over = reading.taken_over || changed;
    return reading;
}

HandReading FalconOrMouse::of_mouse(HandReading reading) const noexcept {
    reading.stand_in = true;
    reading.limits = mouse_.specification().limits;
    return reading;
}

void FalconOrMouse::send(Vec3 force_newton) noexcept {
    falcon_.send(falcon_touches_ ? force_newton : Vec3{0.0});
    mouse_.send(falcon_touches_ ? Vec3{0.0} : force_newton);
}

}  // namespace dibhr
