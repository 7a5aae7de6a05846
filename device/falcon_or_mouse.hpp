// A Falcon that the mouse stands in for while it is not ready.
#pragma once

#include "core/loop/device.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// The Falcon touches while it is ready; else the mouse does. When the hand changes, the proxy lets
/// go and the force begins from zero (HandReading::taken_over).
class FalconOrMouse final : public Device {
  public:
    FalconOrMouse(falcon::ConnectionOptions options, falcon::FirmwareImage firmware);

    [[nodiscard]] const DeviceSpecification& specification() const noexcept override;
    [[nodiscard]] HandReading unread() const noexcept override;
    HandReading read(const HandContext& context) noexcept override;
    void send(Vec3 force_newton) noexcept override;

    [[nodiscard]] falcon::FalconDevice& falcon() noexcept { return falcon_; }
    [[nodiscard]] MouseHand& mouse() noexcept { return mouse_; }

  private:
    [[nodiscard]] HandReading of_mouse(HandReading reading) const noexcept;

    falcon::FalconDevice falcon_;
    MouseHand mouse_{};
    bool falcon_touches_{false};
};

}  // namespace dibhr
