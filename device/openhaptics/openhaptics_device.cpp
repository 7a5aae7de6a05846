// A Touch as a force device.
#include "device/openhaptics/openhaptics_device.hpp"

#include "device/openhaptics/dynamics.hpp"

namespace dibhr::openhaptics {

DeviceSpecification specification_of(const ConnectionOptions& options) {
    DeviceSpecification specification;
    specification.name =
        options.name.empty() ? "3D Systems Touch" : "3D Systems Touch (" + options.name + ")";
    specification.limits = nominal_limits();
    specification.workspace_mm = {160.0, 120.0, 70.0};
    return specification;
}

OpenhapticsDevice::OpenhapticsDevice(const ConnectionOptions& options)
    : ArmDevice(specification_of(options)), driver_(options, buffers()) {}

DeviceState OpenhapticsDevice::state() {
    DeviceState now = state_of(driver_.status());
    now.ages = pose_ages();
    return now;
}

}  // namespace dibhr::openhaptics
