// The haptic thread's part of a device whose arm gives a position in metres and takes a force in
// newtons, through ArmBuffers.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "device/arm_buffers.hpp"
#include "device/grip_device.hpp"
#include "device/hand/pose_ages.hpp"

namespace dibhr {

/// As GripDevice. A Tuning also has `max_force_newton`; hand_mm(position_m), the position from the
/// middle of the workspace in the hand's axes (x right, y up, z to the user); arm_newton(force), a
/// force of the hand's axes in the arm's; and delay_s(exchange_ms), the time from reading a pose
/// until its force acts [s].
template <typename Settings, typename Tuning>
class ArmDevice : public GripDevice<Settings, Tuning> {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kOldestPose{20};

    /// The newest pose. `ready` is false, and no force will be sent, unless the device's thread
    /// published an epoch, the pose is younger than 20 ms, and the clutch is open. Before the first
    /// pose the goal is above the middle of the image, higher than the relief; without a pose it
    /// stays. A change of a rendered value sets `hand_changed`, as does every gap and jump.
    HandReading read(const HandContext& context) noexcept final {
        this->take_tuning();
        const TimedPose& newest = buffers_->poses.front();
        this->take_epoch(newest.epoch);
        pose_age_ = Clock::now() - newest.at;
        count_age();
        limits_ = buffers_->limits.front();

        std::optional<Vec3> grip_mm;
        if (this->can_touch() && pose_age_ < kOldestPose)
            grip_mm = this->tuned().hand_mm(newest.position_m);
        HandReading reading =
            this->reading_at(grip_mm, newest.buttons,
                             at_delay(limits_, Tuning::delay_s(newest.exchange_ms)), context);
        reading.limits->max_force_newton =
            std::min(reading.limits->max_force_newton, this->tuned().max_force_newton);
        return reading;
    }

    /// The force of this tick, sent by the device's thread. Zero for a force that is not finite,
    /// and whenever the last read() was not ready; at most Tuning::max_force_newton long, and no
    /// longer than the arm's limit.
    void send(Vec3 force_newton) noexcept final {
        const bool pushes = this->may_push() && is_finite(force_newton);
        TimedForce& force = buffers_->forces.back();
        force.at = Clock::now();
        force.epoch = pushes ? this->epoch() : kNoEpoch;
        force.newton = Vec3{0.0};
        if (pushes)
            force.newton =
                this->tuned().arm_newton(device_axes(no_longer_than_allowed(force_newton)));
        buffers_->forces.publish();
        buffers_->wake.signal();
    }

    /// For the haptic thread: age of the pose of the last read().
    [[nodiscard]] std::chrono::nanoseconds pose_age() const noexcept { return pose_age_; }

    /// For the window thread: pose ages of all ticks in which this device touched, since the start;
    /// updated every half second.
    [[nodiscard]] const PoseAges& pose_ages() noexcept { return published_ages_.front(); }

  protected:
    explicit ArmDevice(DeviceSpecification given) : GripDevice<Settings, Tuning>(std::move(given)) {
        buffers_->limits.publish(this->specification().limits);
    }

    /// Shared, because a call of a maker's library may outlive the device.
    [[nodiscard]] const std::shared_ptr<ArmBuffers>& buffers() const noexcept { return buffers_; }

    /// For the window thread: ages of about the last second.
    [[nodiscard]] const PoseAges& recent_ages() {
        const auto at = Clock::now();
        if (at - shown_at_ < std::chrono::seconds(1)) return recent_ages_;
        const PoseAges& ages = pose_ages();
        shown_at_ = at;
        recent_ages_ = ages.since(shown_ages_);
        shown_ages_ = ages;
        return recent_ages_;
    }

  private:
    static constexpr int kPublishAgesEvery = 500;  // ticks

    [[nodiscard]] Vec3 no_longer_than_allowed(Vec3 force) const noexcept {
        const double most = this->tuned().max_force_newton;
        const double limit =
            std::isfinite(most) ? std::clamp(most, 0.0, limits_.max_force_newton) : 0.0;
        const double length = glm::length(force);
        return length > limit ? force * (limit / length) : force;
    }

    void count_age() noexcept {
        if (!this->can_touch()) return;
        ages_.add(pose_age_);
        if (++ages_unpublished_ < kPublishAgesEvery) return;
        ages_unpublished_ = 0;
        published_ages_.publish(ages_);
    }

    const std::shared_ptr<ArmBuffers> buffers_{std::make_shared<ArmBuffers>()};
    TripleBuffer<PoseAges> published_ages_{};

    // Used by the window thread only.
    PoseAges shown_ages_{};   // all ages up to shown_at_
    PoseAges recent_ages_{};  // ages of the second before shown_at_
    Clock::time_point shown_at_{};

    // Used by the haptic thread only.
    DeviceLimits limits_{};
    std::chrono::nanoseconds pose_age_{0};
    PoseAges ages_{};
    int ages_unpublished_{0};
};

}  // namespace dibhr
