// The Novint Falcon as a device: what the haptic thread does with the newest reply.
#include "device/falcon/falcon_device.hpp"

#include <chrono>
#include <utility>

#include "device/falcon/settings.hpp"

namespace dibhr::falcon {

namespace {

using Clock = std::chrono::steady_clock;

// README.md, Safety numbers.
constexpr std::chrono::milliseconds kOldestReply{20};
constexpr double kMaxForce_newton = 8.0;
constexpr double kMaxStiffness_newton_per_mm = 1.0;
constexpr DeviceDynamics kDynamics{
    .mass_kg = 0.1, .friction_newton_s_per_m = 0.5, .resolution_mm = 0.06, .delay_s = 0.002};
/// From reading a pose until its force acts, where exchanges take so long: one and a half of them
/// and half a tick of ours [s].
constexpr double delay_s_of(int exchange_ms) noexcept {
    return 1e-3 * (1.5 * exchange_ms + 0.5);
}
constexpr double kMetre_mm = 1000.0;

Vec3 centre_of(const WorkspaceOptions& workspace) noexcept {
    return {0.0, 0.0, workspace.centre_z_mm / kMetre_mm};
}

/// The same pose gives the same goal, and the same force the same commands.
bool feel_alike(const Tuning& a, const Tuning& b) noexcept {
    return a.geometry == b.geometry && a.motors == b.motors && a.workspace == b.workspace &&
           a.centred == b.centred;
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
    : specification_(specification_of(options)),
      firmware_(firmware.name),
      firmware_trouble_(std::move(firmware_trouble)),
      driver_(std::move(options), std::move(firmware), exchange_) {}

DeviceState FalconDevice::state() {
    DeviceState now = state_of(driver_.status());
    now.firmware->name = firmware_;
    now.firmware->trouble = firmware_trouble_;
    return now;
}

bool FalconDevice::is_retuned(const DeviceSettings& settings, const HandTuning& hand) const {
    return !(published_ == tuning_of(static_cast<const FalconSettings&>(settings), hand.centred));
}

void FalconDevice::publish(const DeviceSettings& settings, const HandTuning& hand) {
    published_ = tuning_of(static_cast<const FalconSettings&>(settings), hand.centred);
    tuning_.publish(published_);
}

std::string FalconDevice::use_firmware(const std::filesystem::path& file) {
    FirmwareImage image = keep_firmware(file);
    firmware_ = image.name;
    firmware_trouble_.clear();
    driver_.use_firmware(std::move(image));
    return firmware_;
}

HandReading FalconDevice::read(const HandContext& context) noexcept {
    const bool feels_other = take_tuning();
    const TimedReply& newest = exchange_.replies.front();
    take_epoch(newest.epoch);
    reply_number_ = newest.number;

    const bool posed = epoch_ != kNoEpoch && Clock::now() - newest.at < kOldestReply &&
                       find_pose(newest.reply.encoder);
    HandReading reading;
    reading.limits = at_scale(at_delay(specification_.limits, delay_s_of(newest.exchange_ms)),
                              tuned_.workspace.scale);
    reading.buttons = newest.reply.buttons;
    reading.force_off = (newest.reply.buttons & tuned_.force_off_buttons) != 0;
    if (posed) {
        const bool clutched = (newest.reply.buttons & tuned_.clutch_buttons) != 0;
        place_goal(clutched, context);
        reading.ready = !clutched;
        reading.own_force_newton =
            grid_axes(Workspace::boundary_force(*position_m_ * kMetre_mm, tuned_.workspace));
    } else {
        reading.ready = false;
    }
    reading.taken_over = posed && (!was_posed_ || feels_other);
    was_posed_ = posed;
    may_push_ = reading.ready;

    reading.goal_in_grid = goal_in_grid_.value_or(above_image(context.surface));
    return reading;
}

/// The newest tuning for this tick; true when the hand feels something else with it.
bool FalconDevice::take_tuning() noexcept {
    const Tuning& newest = tuning_.front();
    if (newest.centred != tuned_.centred) workspace_.centre();
    const bool other = !feel_alike(newest, tuned_);
    tuned_ = newest;
    return other;
}

/// The first reading of an epoch starts afresh: the counters have jumped.
void FalconDevice::take_epoch(Epoch newest) noexcept {
    if (newest == epoch_) return;
    epoch_ = newest;
    position_m_.reset();
    workspace_.centre();
    was_posed_ = false;
}

bool FalconDevice::find_pose(const Counts& encoder) noexcept {
    const Vec3 near = position_m_.value_or(centre_of(tuned_.workspace));
    const auto found =
        position_with(angles_of_counts(encoder, tuned_.geometry), near, tuned_.geometry);
    const auto jacobian_there = found ? jacobian_at(*found, tuned_.geometry) : std::nullopt;
    if (!jacobian_there) return false;
    position_m_ = *found;
    jacobian_ = *jacobian_there;
    return true;
}

void FalconDevice::place_goal(bool clutched, const HandContext& context) noexcept {
    const ImageFrame image = image_frame(context.surface, context.pixel_pitch_mm);
    goal_in_grid_ =
        workspace_.goal_in_grid(*position_m_ * kMetre_mm, clutched, image, tuned_.workspace);
}

void FalconDevice::send(Vec3 force_newton) noexcept {
    TimedCommand& command = exchange_.commands.back();
    command.at = Clock::now();
    command.epoch = may_push_ ? epoch_ : kNoEpoch;
    command.motor = may_push_ ? motors_for(force_newton) : Counts{};
    exchange_.commands.publish();
    exchange_.wake.signal();
}

Counts FalconDevice::motors_for(Vec3 force_newton) const noexcept {
    if (!is_finite(force_newton)) return {};
    const auto torques = torques_of(device_axes(force_newton), jacobian_);
    return torques ? motor_counts(*torques, tuned_.motors) : Counts{};
}

}  // namespace dibhr::falcon
