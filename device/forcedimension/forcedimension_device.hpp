// A Force Dimension arm as a force device, with a thread of its own for its maker's library.
#pragma once

#include "device/arm_device.hpp"
#include "device/forcedimension/driver.hpp"
#include "device/forcedimension/settings.hpp"
#include "device/forcedimension/status.hpp"

namespace dibhr::forcedimension {

/// Name, limits and nominal dynamics of the strongest arm, whether or not one is attached. Those of
/// the attached arm come with its poses.
[[nodiscard]] DeviceSpecification specification_of(const ConnectionOptions& options = {});

/// The state without the pose ages since the start. `recent`: ages of about the last second. Its
/// facts: "controller", "library", "serial", "type", "watchdog-ms".
[[nodiscard]] DeviceState state_of(const Status& status, const PoseAges& recent = {});

/// Searches for an arm from construction on, and again whenever it is lost. All but read() and
/// send() happens on a thread of its own. The destructor stops the arm.
class ForceDimensionDevice final : public ArmDevice<ForceDimensionSettings, Tuning> {
  public:
    /// `found`: as load_calls() returns it.
    ForceDimensionDevice(ConnectionOptions options, FoundCalls found);

    // For the window thread:

    [[nodiscard]] Status status() const { return driver_.status(); }
    [[nodiscard]] DeviceState state() override;
    void agree_to(std::uint64_t offer) override { driver_.agree_to(offer); }

  private:
    Driver driver_;
};

}  // namespace dibhr::forcedimension
