// A force device that the mouse stands in for while it is not ready; of several the one that is.
#pragma once

#include <memory>

#include "core/loop/device.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/inverse3/inverse3_device.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// What touches: HandReading::which.
enum class Touching : std::uint8_t { mouse, falcon, inverse3 };

/// A device touches from when it is ready until it is lost, and then another one that is ready; the
/// mouse while none is. All others rest without force. When the hand changes, the proxy lets go and
/// the force begins from zero (HandReading::taken_over).
class DeviceOrMouse : public Device {
  public:
    /// Those that are looked for; at least one of them.
    DeviceOrMouse(std::unique_ptr<falcon::FalconDevice> falcon,
                  std::unique_ptr<inverse3::Inverse3Device> inverse3);

    /// Of the Falcon, where one is looked for.
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override;
    [[nodiscard]] HandReading unread() const noexcept override;
    HandReading read(const HandContext& context) noexcept override;
    void send(Vec3 force_newton) noexcept override;

    /// Null: it is not looked for.
    [[nodiscard]] falcon::FalconDevice* falcon() noexcept { return falcon_.get(); }
    [[nodiscard]] inverse3::Inverse3Device* inverse3() noexcept { return inverse3_.get(); }
    [[nodiscard]] MouseHand& mouse() noexcept { return mouse_; }

  private:
    [[nodiscard]] HandReading of_mouse(HandReading reading) const noexcept;
    [[nodiscard]] bool in_hand(Touching hand) const noexcept;
    [[nodiscard]] Touching next_hand() const noexcept;

    std::unique_ptr<falcon::FalconDevice> falcon_;
    std::unique_ptr<inverse3::Inverse3Device> inverse3_;
    MouseHand mouse_{};
    Touching touching_{Touching::mouse};
};

}  // namespace dibhr
