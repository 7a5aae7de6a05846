// Checks the samples of an arm over time.
#include "device/openhaptics/arm_watch.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace dibhr::openhaptics {

namespace {

// README.md, Numbers.
constexpr double kFarthest_m = 1.0;

bool is_pose(const ArmSample& sample) noexcept {
    return is_finite(sample.position_m) && is_finite(sample.velocity_m_per_s) &&
           is_finite(sample.gimbal_rad) && glm::length(sample.position_m) < kFarthest_m;
}

}  // namespace

bool StillEncoders::add(const std::array<long, 6>& encoders, Vec3 gimbal_rad) noexcept {
    const std::array<long, 3> arm{encoders[0], encoders[1], encoders[2]};
    if (!start_rad_ || arm != last_) start_rad_ = gimbal_rad;
    last_ = arm;
    return glm::distance(gimbal_rad, *start_rad_) > kTurn_rad;
}

void ArmWatch::begin() noexcept {
    trust_.begin();
    const PoseTrust trust = trust_;
    *this = ArmWatch{};
    trust_ = trust;
}

void ArmWatch::add(const ArmSample& sample, Time at) noexcept {
    follow_motors(sample.warmest);
    samples_ = std::min(samples_ + 1, kSettling);
    stage_ = stage_of(sample, at);
    if (at - last_at_ >= kLongestGap) trust_.add_gap();
    last_at_ = at;
    std::optional<Vec3> position;
    if (stage_ == Stage::ready) position = sample.position_m;
    trust_.add(position, at, sample.may_output);
}

Stage ArmWatch::stage_of(const ArmSample& sample, Time at) noexcept {
    if (sample.fault != FaultClass::none) {
        fault_at_ = at;
        fault_stage_ = sample.fault == FaultClass::force ? Stage::force_cut : Stage::refused;
    }
    if (!is_pose(sample)) return Stage::not_understood;
    const bool pose_stands =
        still_.add(sample.position_m, glm::length(sample.velocity_m_per_s), at);
    const bool arm_stands = encoders_.add(sample.encoders, sample.gimbal_rad);
    if (samples_ < kSettling) return Stage::starting;
    if (sample.calibration != kHdCalibrated) return Stage::not_calibrated;
    if (pose_stands || arm_stands) return Stage::stands_still;
    if (share_ <= 0.0) return Stage::hot;
    if (fault_at_ && at - *fault_at_ < kFaultRests) return fault_stage_;
    return Stage::ready;
}

/// The temperature is the library's prediction. A value that is no number counts as hot.
void ArmWatch::follow_motors(double warmest) noexcept {
    const double heat = std::isfinite(warmest) ? warmest : 1.0;
    share_ = std::clamp((1.0 - heat) / (1.0 - kWarm), 0.0, 1.0);
    warm_ = heat > kWarm || (warm_ && heat > kCool);
}

}  // namespace dibhr::openhaptics
