// The Haply Inverse3 as a device: its limits, and the map between its axes and the hand's.
#include "device/inverse3/inverse3_device.hpp"

#include <utility>

#include "device/inverse3/dynamics.hpp"
#include "device/inverse3/frame.hpp"

namespace dibhr::inverse3 {

namespace {

// README.md, Safety numbers.
constexpr double kMaxForce_newton = 10.0;  // peak; the lasting limit is Tuning::max_force_newton
constexpr double kMaxStiffness_newton_per_mm = 1.0;
constexpr double kMetre_mm = 1000.0;

}  // namespace

DeviceSpecification specification_of(const ConnectionOptions& options) {
    DeviceSpecification specification;
    specification.name =
        options.device.empty() ? "Haply Inverse3" : "Haply Inverse3 (" + options.device + ")";
    specification.limits.max_force_newton = kMaxForce_newton;
    specification.limits.max_stiffness_newton_per_mm = kMaxStiffness_newton_per_mm;
    specification.limits.dynamics = kAssumedDynamics;
    specification.workspace_mm = {460.0, 510.0, 230.0};
    return specification;
}

Vec3 Tuning::hand_mm(Vec3 position_m) const noexcept {
    return ImageTilt(tilt_deg).hand_from_service(position_m * kMetre_mm - centre_mm);
}

Vec3 Tuning::arm_newton(Vec3 hand_newton) const noexcept {
    return ImageTilt(tilt_deg).service_from_hand(hand_newton);
}

double Tuning::delay_s(int exchange_ms) noexcept {
    return delay_s_of(exchange_ms);
}

Inverse3Device::Inverse3Device(ConnectionOptions options)
    : ArmDevice(specification_of(options)), driver_(std::move(options), *buffers()) {}

DeviceState Inverse3Device::state() {
    DeviceState now = state_of(driver_.status(), recent_ages());
    now.ages = pose_ages();
    return now;
}

}  // namespace dibhr::inverse3
