// The Haply Inverse3 as a device: what the haptic thread does with the newest pose.
#include "device/inverse3/inverse3_device.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "device/inverse3/dynamics.hpp"
#include "device/inverse3/settings.hpp"

namespace dibhr::inverse3 {

namespace {

using Clock = std::chrono::steady_clock;

// README.md, Safety numbers.
constexpr std::chrono::milliseconds kOldestPose{20};
constexpr double kMaxForce_newton = 10.0;  // for a moment; Tuning::max_force_newton lasts
constexpr double kMaxStiffness_newton_per_mm = 1.0;
constexpr int kTellAgesEvery = 500;  // ticks
constexpr double kMetre_mm = 1000.0;

/// The same pose gives the same goal.
bool feel_alike(const Tuning& a, const Tuning& b) noexcept {
    return a.workspace == b.workspace && a.centre_mm == b.centre_mm && a.tilt_deg == b.tilt_deg &&
           a.centred == b.centred;
}

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
    : specification_(specification_of(options)), driver_(std::move(options), exchange_) {}

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

bool Inverse3Device::is_retuned(const DeviceSettings& settings, const HandTuning& hand) const {
    return !(published_ == tuning_of(static_cast<const Inverse3Settings&>(settings),
                                     hand.max_force_newton, hand.centred));
}

void Inverse3Device::publish(const DeviceSettings& settings, const HandTuning& hand) {
    published_ = tuning_of(static_cast<const Inverse3Settings&>(settings), hand.max_force_newton,
                           hand.centred);
    tuning_.publish(published_);
}

HandReading Inverse3Device::read(const HandContext& context) noexcept {
    const bool feels_other = take_tuning();
    const TimedPose& newest = exchange_.poses.front();
    take_epoch(newest.epoch);
    pose_age_ = Clock::now() - newest.at;
    count_age();

    const bool posed = epoch_ != kNoEpoch && pose_age_ < kOldestPose;
    HandReading reading;
    reading.limits = at_scale(at_delay(specification_.limits, delay_s_of(newest.exchange_ms)),
                              tuned_.workspace.scale);
    reading.limits->max_force_newton =
        std::min(reading.limits->max_force_newton, tuned_.max_force_newton);
    reading.buttons = newest.buttons;
    reading.force_off = (newest.buttons & tuned_.force_off_buttons) != 0;
    const bool clutched = (newest.buttons & tuned_.clutch_buttons) != 0;
    if (posed) place_goal(newest.position_m, clutched, context);
    reading.ready = posed && !clutched;
    reading.taken_over = posed && (!was_posed_ || feels_other);
    was_posed_ = posed;
    may_push_ = reading.ready;

    reading.goal_in_grid = goal_in_grid_.value_or(above_image(context.surface));
    return reading;
}

void Inverse3Device::count_age() noexcept {
    if (epoch_ == kNoEpoch) return;
    ages_.add(pose_age_);
    if (++ages_untold_ < kTellAgesEvery) return;
    ages_untold_ = 0;
    told_ages_.publish(ages_);
}

/// The newest tuning for this tick; true when the hand feels something else with it.
bool Inverse3Device::take_tuning() noexcept {
    if (!tuning_.fresh()) return false;
    const Tuning& newest = tuning_.front();
    if (newest.centred != tuned_.centred) workspace_.centre();
    const bool other = !feel_alike(newest, tuned_);
    if (newest.tilt_deg != tuned_.tilt_deg) tilt_ = ImageTilt(newest.tilt_deg);
    tuned_ = newest;
    return other;
}

/// The first reading of an epoch starts afresh: the position may have jumped.
void Inverse3Device::take_epoch(Epoch newest) noexcept {
    if (newest == epoch_) return;
    epoch_ = newest;
    workspace_.centre();
    was_posed_ = false;
}

void Inverse3Device::place_goal(Vec3 position_m, bool clutched,
                                const HandContext& context) noexcept {
    const ImageFrame image = image_frame(context.surface, context.pixel_pitch_mm);
    const Vec3 hand_mm = tilt_.hand_from_service(position_m * kMetre_mm - tuned_.centre_mm);
    goal_in_grid_ = workspace_.goal_in_grid(hand_mm, clutched, image, tuned_.workspace);
}

void Inverse3Device::send(Vec3 force_newton) noexcept {
    const bool pushes = may_push_ && is_finite(force_newton);
    TimedForce& force = exchange_.forces.back();
    force.at = Clock::now();
    force.epoch = pushes ? epoch_ : kNoEpoch;
    force.newton = Vec3{0.0};
    if (pushes) {
        force.newton = tilt_.service_from_hand(
            device_axes(no_longer_than(force_newton, tuned_.max_force_newton)));
    }
    exchange_.forces.publish();
    exchange_.wake.signal();
}

}  // namespace dibhr::inverse3
