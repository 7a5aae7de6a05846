// A Touch as a force device, with a thread of its own that follows its maker's library.
#pragma once

#include "device/arm_device.hpp"
#include "device/openhaptics/driver_thread.hpp"
#include "device/openhaptics/settings.hpp"
#include "device/openhaptics/status.hpp"

namespace dibhr::openhaptics {

/// Name, limits and nominal dynamics of a Touch, whether or not one is attached. The limits of the
/// open device come with its poses, lower with warm motors.
[[nodiscard]] DeviceSpecification specification_of(const ConnectionOptions& options = {});

/// Its facts: "driver", "library-version", "model", "serial".
[[nodiscard]] DeviceState state_of(const Status& status);

/// Loads the library, opens the device and waits until it is calibrated, on a thread of its own;
/// poses and forces are exchanged with the library's servo thread. The destructor takes the force
/// off, switches the force output off, and closes the device.
class OpenhapticsDevice final : public ArmDevice<OpenhapticsSettings, Tuning> {
  public:
    explicit OpenhapticsDevice(const ConnectionOptions& options);

    // For the window thread:

    [[nodiscard]] Status status() const { return driver_.status(); }
    [[nodiscard]] DeviceState state() override;

  private:
    Driver driver_;
};

}  // namespace dibhr::openhaptics
