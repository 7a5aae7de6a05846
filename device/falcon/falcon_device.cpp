// The Novint Falcon as a device: what the haptic thread does with the newest reply.
#include "device/falcon/falcon_device.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "device/falcon/driver.hpp"
#include "device/falcon/exchange.hpp"
#include "device/falcon/kinematics.hpp"
#include "device/falcon/workspace.hpp"

namespace dibhr::falcon {

namespace {

using Clock = std::chrono::steady_clock;

// README.md, Safety numbers.
constexpr std::chrono::milliseconds kOldestReply{20};
constexpr double kMaxForce_newton = 8.0;
constexpr double kMaxStiffness_newton_per_mm = 1.0;
constexpr double kExtent_mm = 101.6;  // 4 inches
constexpr double kMetre_mm = 1000.0;
constexpr double kAboveAll_px = 6.0;

DeviceSpecification specification_of(const ConnectionOptions& options) {
    DeviceSpecification specification;
    specification.name =
        options.serial.empty() ? "Novint Falcon" : "Novint Falcon (" + options.serial + ")";
    specification.limits.max_force_newton = kMaxForce_newton;
    specification.limits.max_stiffness_newton_per_mm = kMaxStiffness_newton_per_mm;
    specification.workspace_mm = Vec3{kExtent_mm};
    return specification;
}

Vec3 centre_of(const WorkspaceOptions& workspace) noexcept {
    return {0.0, 0.0, workspace.centre_z_mm / kMetre_mm};
}

/// The same pose gives the same goal, and the same force the same commands.
bool feel_alike(const Tuning& a, const Tuning& b) noexcept {
    return a.geometry == b.geometry && a.motors == b.motors && a.workspace == b.workspace &&
           a.centred == b.centred;
}

}  // namespace

struct FalconDevice::Implementation {
    Implementation(ConnectionOptions options, FirmwareImage firmware)
        : specification(specification_of(options)),
          driver(std::move(options), std::move(firmware), exchange) {}

    HandReading read(const HandContext& context) noexcept;
    void send(Vec3 force_newton) noexcept;

    DeviceSpecification specification;
    TripleBuffer<Tuning> tuning{};
    Exchange exchange{};

    // The haptic thread's.
    Tuning tuned{};  // one for the whole tick
    Epoch epoch{kNoEpoch};
    std::uint64_t reply_number{0};
    std::optional<Vec3> position_m{};  // the last pose of this epoch
    Jacobian jacobian{};               // there
    Workspace workspace{};
    std::optional<Vec3> goal_in_grid{};
    bool may_push{false};  // the last reading was ready
    bool was_posed{false};

    Driver driver;  // last: its thread uses the exchange

  private:
    [[nodiscard]] bool take_tuning() noexcept;
    void take_epoch(Epoch newest) noexcept;
    [[nodiscard]] bool find_pose(const Counts& encoder) noexcept;
    void place_goal(bool clutched, const HandContext& context) noexcept;
    [[nodiscard]] Counts motors_for(Vec3 force_newton) const noexcept;
};

HandReading FalconDevice::Implementation::read(const HandContext& context) noexcept {
    const bool feels_other = take_tuning();
    const TimedReply& newest = exchange.replies.front();
    take_epoch(newest.epoch);
    reply_number = newest.number;

    const bool posed = epoch != kNoEpoch && Clock::now() - newest.at < kOldestReply &&
                       find_pose(newest.reply.encoder);
    HandReading reading;
    reading.limits = at_scale(specification.limits, tuned.workspace.scale);
    reading.buttons = newest.reply.buttons;
    reading.force_off = (newest.reply.buttons & tuned.force_off_buttons) != 0;
    if (posed) {
        const bool clutched = (newest.reply.buttons & tuned.clutch_buttons) != 0;
        place_goal(clutched, context);
        reading.ready = !clutched;
        reading.own_force_newton =
            grid_axes(Workspace::boundary_force(*position_m * kMetre_mm, tuned.workspace));
    } else {
        reading.ready = false;
    }
    reading.taken_over = posed && (!was_posed || feels_other);
    was_posed = posed;
    may_push = reading.ready;

    const Vec3 above{0.5 * (context.surface.columns() - 1), 0.5 * (context.surface.rows() - 1),
                     context.surface.ceiling() + kAboveAll_px};
    reading.goal_in_grid = goal_in_grid.value_or(above);
    return reading;
}

/// The newest tuning for this tick; true when the hand feels something else with it.
bool FalconDevice::Implementation::take_tuning() noexcept {
    const Tuning& newest = tuning.front();
    if (newest.centred != tuned.centred) workspace.centre();
    const bool other = !feel_alike(newest, tuned);
    tuned = newest;
    return other;
}

/// The first reading of a epoch starts afresh: the counters have jumped.
void FalconDevice::Implementation::take_epoch(Epoch newest) noexcept {
    if (newest == epoch) return;
    epoch = newest;
    position_m.reset();
    workspace.centre();
    was_posed = false;
}

bool FalconDevice::Implementation::find_pose(const Counts& encoder) noexcept {
    const Vec3 near = position_m.value_or(centre_of(tuned.workspace));
    const auto found =
        position_with(angles_of_counts(encoder, tuned.geometry), near, tuned.geometry);
    const auto jacobian_there = found ? jacobian_at(*found, tuned.geometry) : std::nullopt;
    if (!jacobian_there) return false;
    position_m = *found;
    jacobian = *jacobian_there;
    return true;
}

void FalconDevice::Implementation::place_goal(bool clutched, const HandContext& context) noexcept {
    const ImageFrame image{context.surface.columns(), context.surface.rows(),
                           context.surface.ceiling(), context.pixel_pitch_mm};
    goal_in_grid =
        workspace.goal_in_grid(*position_m * kMetre_mm, clutched, image, tuned.workspace);
}

void FalconDevice::Implementation::send(Vec3 force_newton) noexcept {
    TimedCommand& command = exchange.commands.back();
    command.at = Clock::now();
    command.epoch = may_push ? epoch : kNoEpoch;
    command.motor = may_push ? motors_for(force_newton) : Counts{};
    exchange.commands.publish();
    exchange.wake.signal();
}

Counts FalconDevice::Implementation::motors_for(Vec3 force_newton) const noexcept {
    if (!is_finite(force_newton)) return {};
    const auto torques = torques_of(device_axes(force_newton), jacobian);
    return torques ? motor_counts(*torques, tuned.motors) : Counts{};
}

FalconDevice::FalconDevice(ConnectionOptions options, FirmwareImage firmware)
    : implementation_(std::make_unique<Implementation>(std::move(options), std::move(firmware))) {}

FalconDevice::~FalconDevice() = default;

const DeviceSpecification& FalconDevice::specification() const noexcept {
    return implementation_->specification;
}

HandReading FalconDevice::read(const HandContext& context) noexcept {
    return implementation_->read(context);
}

void FalconDevice::send(Vec3 force_newton) noexcept {
    implementation_->send(force_newton);
}

bool FalconDevice::in_hand() const noexcept {
    return implementation_->epoch != kNoEpoch;
}

std::uint64_t FalconDevice::reply_number() const noexcept {
    return implementation_->reply_number;
}

TripleBuffer<Tuning>& FalconDevice::tuning() noexcept {
    return implementation_->tuning;
}

Status FalconDevice::status() const {
    return implementation_->driver.status();
}

void FalconDevice::use_firmware(FirmwareImage image) {
    implementation_->driver.use_firmware(std::move(image));
}

}  // namespace dibhr::falcon
