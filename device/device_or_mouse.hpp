// Force devices that the mouse stands in for while none is ready.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "device/force_device.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// A device touches from when it is ready until it is lost, and then another one that is ready; the
/// mouse while none is. All others rest without force. When the hand changes, the proxy lets go and
/// the force begins from zero (HandReading::taken_over).
class DeviceOrMouse : public Device {
  public:
    using Devices = std::vector<std::unique_ptr<ForceDevice>>;

    /// In the order of force_device_kinds(), null where none is looked for; at least one is.
    explicit DeviceOrMouse(Devices devices);

    /// Of the first device that is looked for.
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override;
    [[nodiscard]] HandReading unread() const noexcept override;
    HandReading read(const HandContext& context) noexcept override;
    void send(Vec3 force_newton) noexcept override;

    [[nodiscard]] const Devices& devices() const noexcept { return devices_; }
    [[nodiscard]] MouseHand& mouse() noexcept { return mouse_; }

  private:
    static constexpr std::size_t kMouse = 0;  // HandReading::which; a device's is its place, from 1

    [[nodiscard]] HandReading of_mouse(HandReading reading) const noexcept;
    [[nodiscard]] bool in_hand(std::size_t which) const noexcept;
    [[nodiscard]] std::size_t next_hand() const noexcept;

    Devices devices_;
    MouseHand mouse_{};
    std::vector<HandReading> readings_;  // of this tick, one a device
    std::size_t touching_{kMouse};
};

}  // namespace dibhr
