// A Force Dimension arm as a device: its limits, and the map between its axes and the hand's.
#include "device/forcedimension/forcedimension_device.hpp"

#include <utility>

#include "device/forcedimension/models.hpp"

namespace dibhr::forcedimension {

namespace {

constexpr double kMetre_mm = 1000.0;

}  // namespace

DeviceSpecification specification_of(const ConnectionOptions& options) {
    DeviceSpecification specification;
    specification.name =
        options.serial.empty() ? "Force Dimension" : "Force Dimension (" + options.serial + ")";
    specification.limits = strongest_limits();
    specification.workspace_mm = {150.0, 150.0, 150.0};
    return specification;
}

// The arm's axes are x towards the user, y right, z up: README.md, Axes.
Vec3 Tuning::hand_mm(Vec3 position_m) const noexcept {
    return Vec3{position_m.y, position_m.z, position_m.x} * kMetre_mm - centre_mm;
}

Vec3 Tuning::arm_newton(Vec3 hand_newton) const noexcept {
    return {hand_newton.z, hand_newton.x, hand_newton.y};
}

/// One and a half exchanges, and half a tick.
double Tuning::delay_s(int exchange_ms) noexcept {
    return 1e-3 * (1.5 * exchange_ms + 0.5);
}

ForceDimensionDevice::ForceDimensionDevice(ConnectionOptions options, FoundCalls found)
    : ArmDevice(specification_of(options)),
      driver_(std::move(options), std::move(found), buffers()) {}

DeviceState ForceDimensionDevice::state() {
    DeviceState now = state_of(driver_.status(), recent_ages());
    now.ages = pose_ages();
    return now;
}

}  // namespace dibhr::forcedimension
