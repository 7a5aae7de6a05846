// The Haply Inverse3 as a force device, with a thread of its own for the service.
#pragma once

#include "device/arm_device.hpp"
#include "device/hand/pose_ages.hpp"
#include "device/inverse3/driver.hpp"
#include "device/inverse3/settings.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// Name, limits and assumed dynamics of an Inverse3, whether or not one is attached.
[[nodiscard]] DeviceSpecification specification_of(const ConnectionOptions& options = {});

/// The state without the pose ages since the start. `recent`: ages of about the last second. Its
/// facts: "dialect", "id", "preset-read", "service".
[[nodiscard]] DeviceState state_of(const Status& status, const PoseAges& recent = {});

/// Searches for the service from construction on, and again whenever it is lost; chooses a device,
/// and then exchanges one message and one state at a time. `ready` needs a device that is
/// calibrated, powered, not used by another program and takes forces. All but read() and send()
/// happens on the network thread. The destructor sends a zero force and closes the connection.
class Inverse3Device final : public ArmDevice<Inverse3Settings, Tuning> {
  public:
    explicit Inverse3Device(ConnectionOptions options);

    // For the window thread:

    [[nodiscard]] Status status() const { return driver_.status(); }
    [[nodiscard]] DeviceState state() override;

  private:
    Driver driver_;  // last: its thread uses the buffers
};

}  // namespace dibhr::inverse3
