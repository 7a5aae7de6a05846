// The Novint Falcon as a device: what the haptic thread does with the newest reply.
#include "device/falcon/falcon_device.hpp"

#include <chrono>
#include <utility>

namespace dibhr::falcon {

namespace {

using Clock = std::chrono::steady_clock;

// README.md, Safety numbers.
constexpr std::chrono::milliseconds kOldestReply{20};
constexpr double kMaxForce_newton = 8.0;
constexpr double kMaxStiffness_newton_per_mm = 1.0;
constexpr DeviceDynamics kDynamics{
    .mass_kg = 0.1, .friction_newton_s_per_m = 0.5, .resolution_mm = 0.06, .delay_s = 0.002};
/// Delay from reading a pose until its force acts [s]: one and a half exchanges and half a tick.
constexpr double delay_s_of(int exchange_ms) noexcept {
    return 1e-3 * (1.5 * exchange_ms + 0.5);
}
constexpr double kMetre_mm = 1000.0;

Vec3 centre_of(const WorkspaceOptions& workspace) noexcept {
    return {0.0, 0.0, workspace.centre_z_mm / kMetre_mm};
}

}  // namespace

DeviceSpecification specification_of(const ConnectionOptions& options) {
    DeviceSpecification specification;
    specification.name =
        options.serial.empty() ? "Novint Falcon" : "Novint Falcon (" + options.serial + ")";
    specification.limits.max_force_newton = kMaxForce_newton;
    specification.limits.max_stiffness_newton_per_mm = kMaxStiffness_newton_per_mm;
    specification.limits.dynamics = kDynamics;
    return specification;
}

FalconDevice::FalconDevice(ConnectionOptions options, FirmwareImage firmware,
                           std::string firmware_trouble)
    : GripDevice(specification_of(options)),
      firmware_(firmware.name),
      firmware_trouble_(std::move(firmware_trouble)),
      driver_(std::move(options), std::move(firmware), buffers_) {}

DeviceState FalconDevice::state() {
    DeviceState now = state_of(driver_.status());
    now.firmware->name = firmware_;
    now.firmware->trouble = firmware_trouble_;
    return now;
}

std::string FalconDevice::use_firmware(const std::filesystem::path& file) {
    FirmwareImage image = keep_firmware(file);
    firmware_ = image.name;
    firmware_trouble_.clear();
    driver_.use_firmware(std::move(image));
    return firmware_;
}

HandReading FalconDevice::read(const HandContext& context) noexcept {
    take_tuning();
    const TimedReply& newest = buffers_.replies.front();
    if (take_epoch(newest.epoch)) position_m_.reset();  // the counters have jumped
    reply_number_ = newest.number;

    std::optional<Vec3> grip_mm;
    if (can_touch() && Clock::now() - newest.at < kOldestReply && find_pose(newest.reply.encoder))
        grip_mm = *position_m_ * kMetre_mm;
    HandReading reading =
        reading_at(grip_mm, newest.reply.buttons,
                   at_delay(specification().limits, delay_s_of(newest.exchange_ms)), context);
    if (grip_mm) {
        reading.own_force_newton =
            grid_axes(Workspace::boundary_force(*grip_mm, tuned().workspace));
    }
    return reading;
}

bool FalconDevice::find_pose(const Counts& encoder) noexcept {
    const Geometry& geometry = tuned().geometry;
    const Vec3 near = position_m_.value_or(centre_of(tuned().workspace));
    const auto found = position_with(angles_of_counts(encoder, geometry), near, geometry);
    const auto jacobian_there = found ? jacobian_at(*found, geometry) : std::nullopt;
    if (!jacobian_there) return false;
    position_m_ = *found;
    jacobian_ = *jacobian_there;
    return true;
}

void FalconDevice::send(Vec3 force_newton) noexcept {
    TimedCommand& command = buffers_.commands.back();
    command.at = Clock::now();
    command.epoch = may_push() ? epoch() : kNoEpoch;
    command.motor = may_push() ? motors_for(force_newton) : Counts{};
    buffers_.commands.publish();
    buffers_.wake.signal();
}

Counts FalconDevice::motors_for(Vec3 force_newton) const noexcept {
    if (!is_finite(force_newton)) return {};
    const auto torques = torques_of(device_axes(force_newton), jacobian_);
    return torques ? motor_counts(*torques, tuned().motors) : Counts{};
}

}  // namespace dibhr::falcon
