// The Haply Inverse3 as a device: what the haptic thread does with the newest pose.
#include "device/inverse3/inverse3_device.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "device/inverse3/dynamics.hpp"

namespace dibhr::inverse3 {

namespace {

using Clock = std::chrono::steady_clock;

// README.md, Safety numbers.
constexpr std::chrono::milliseconds kOldestPose{20};
constexpr double kMaxForce_newton = 10.0;  // peak; the lasting limit is Tuning::max_force_newton
constexpr double kMaxStiffness_newton_per_mm = 1.0;
constexpr int kPublishAgesEvery = 500;  // ticks
constexpr double kMetre_mm = 1000.0;

Vec3 no_longer_than(Vec3 force, double most) noexcept {
    const double limit = std::isfinite(most) ? std::clamp(most, 0.0, kMaxForce_newton) : 0.0;
    const double length = glm::length(force);
    return length > limit ? force * (limit / length) : force;
}

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

Inverse3Device::Inverse3Device(ConnectionOptions options)
    : GripDevice(specification_of(options)), driver_(std::move(options), buffers_) {}

DeviceState Inverse3Device::state() {
    const PoseAges& ages = pose_ages();
    const auto at = Clock::now();
    if (at - shown_at_ >= std::chrono::seconds(1)) {
        shown_at_ = at;
        recent_ages_ = ages.since(shown_ages_);
        shown_ages_ = ages;
    }
    DeviceState now = state_of(driver_.status(), recent_ages_);
    now.ages = ages;
    return now;
}

HandReading Inverse3Device::read(const HandContext& context) noexcept {
    const double tilt_deg = tuned().tilt_deg;
    take_tuning();
    if (tuned().tilt_deg != tilt_deg) tilt_ = ImageTilt(tuned().tilt_deg);
    const TimedPose& newest = buffers_.poses.front();
    take_epoch(newest.epoch);
    pose_age_ = Clock::now() - newest.at;
    count_age();

    std::optional<Vec3> hand_mm;
    if (can_touch() && pose_age_ < kOldestPose)
        hand_mm = tilt_.hand_from_service(newest.position_m * kMetre_mm - tuned().centre_mm);
    HandReading reading =
        reading_at(hand_mm, newest.buttons,
                   at_delay(specification().limits, delay_s_of(newest.exchange_ms)), context);
    reading.limits->max_force_newton =
        std::min(reading.limits->max_force_newton, tuned().max_force_newton);
    return reading;
}

void Inverse3Device::count_age() noexcept {
    if (!can_touch()) return;
    ages_.add(pose_age_);
    if (++ages_unpublished_ < kPublishAgesEvery) return;
    ages_unpublished_ = 0;
    published_ages_.publish(ages_);
}

void Inverse3Device::send(Vec3 force_newton) noexcept {
    const bool pushes = may_push() && is_finite(force_newton);
    TimedForce& force = buffers_.forces.back();
    force.at = Clock::now();
    force.epoch = pushes ? epoch() : kNoEpoch;
    force.newton = Vec3{0.0};
    if (pushes) {
        force.newton = tilt_.service_from_hand(
            device_axes(no_longer_than(force_newton, tuned().max_force_newton)));
    }
    buffers_.forces.publish();
    buffers_.wake.signal();
}

}  // namespace dibhr::inverse3
