// Force devices, with the mouse as fallback while none of them is ready.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "device/force_device.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// One device at a time touches: from when it is ready until it is lost. Then another device that
/// is ready takes over, else the mouse. All others get no force. At each change the proxy is
/// released from the surface and the force begins from zero (HandReading::hand_changed).
class DeviceOrMouse : public Device {
  public:
    using Devices = std::vector<std::unique_ptr<ForceDevice>>;

    /// In the order of force_device_kinds(); null: not searched for. At least one is not null.
    explicit DeviceOrMouse(Devices devices);

    /// Of the first device that is not null.
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override;
    [[nodiscard]] HandReading reading_without_surface() const noexcept override;
    HandReading read(const HandContext& context) noexcept override;
    /// The mouse is the hand and rests; a device that becomes ready is read in the next tick.
    [[nodiscard]] bool rests() const noexcept override {
        return touching_ == kMouse && mouse_.rests();
    }
    void send(Vec3 force_newton) noexcept override;

    [[nodiscard]] const Devices& devices() const noexcept { return devices_; }
    [[nodiscard]] MouseHand& mouse() noexcept { return mouse_; }

  private:
    static constexpr std::size_t kMouse = 0;  // HandReading::device_number; devices count from 1

    [[nodiscard]] HandReading of_mouse(HandReading reading) const noexcept;
    [[nodiscard]] bool can_touch(std::size_t device_number) const noexcept;
    [[nodiscard]] std::size_t next_hand() const noexcept;

    Devices devices_;
    MouseHand mouse_{};
    std::vector<HandReading> readings_;  // of this tick, one per device
    std::size_t touching_{kMouse};
};

}  // namespace dibhr
