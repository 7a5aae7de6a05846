// The callback in the library's servo thread.
#include "device/openhaptics/servo.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>

namespace dibhr::openhaptics {

namespace {

using Clock = std::chrono::steady_clock;

// README.md, Numbers.
constexpr int kLastFrames = 5;  // of zero force, before the callback ends
constexpr std::size_t kMostMotors = 6;

constexpr double kMetre_mm = 1000.0;

Vec3 vector_of(const std::array<double, 3>& values) noexcept {
    return {values[0], values[1], values[2]};
}

}  // namespace

unsigned int Servo::tick() noexcept {
    runs_ = true;
    if (!ended_) one_frame();
    const bool ended = ended_;
    runs_ = false;
    return ended ? kHdCallbackDone : kHdCallbackContinue;
}

void Servo::one_frame() noexcept {
    library_.begin_frame(arm_.handle);
    const Time now = Clock::now();
    if (now_.ticks > 0) ticks_.add(last_tick_, now);
    last_tick_ = now;

    ArmSample sample;
    std::uint8_t buttons = 0;
    read_frame(sample, buttons, now_.in_inkwell);
    sample.may_output = may_output_;
    sample.fault = fault_.kind;
    watch_.add(sample, now);
    now_.limit_newton = arm_.limits.max_force_newton * watch_.force_share();
    const bool ending = ending_;
    const Vec3 force = ending ? Vec3{0.0} : force_at(now);
    const std::array<double, 3> sent{force.x, force.y, force.z};
    library_.set_doubles(kHdForce, sent.data());
    library_.end_frame(arm_.handle);
    fault_ = take_faults(library_);

    publish_pose(sample, buttons, now);
    if (fault_.kind != FaultClass::none) {
        ++now_.errors;
        now_.last = fault_;
    }
    if (fault_.kind == FaultClass::force) ++now_.forces_cut;
    if (fault_.kind == FaultClass::link && now_.loss.kind == FaultClass::none) now_.loss = fault_;
    ++now_.ticks;
    now_.stage = watch_.stage();
    now_.calibration = sample.calibration;
    now_.warm = watch_.warm();
    now_.warmest = sample.warmest;
    now_.reports_heat = heat_.known;
    now_.presses = buttons_.presses();
    now_.pressed_at = buttons_.pressed_at();
    reports_.publish(now_);
    if (ending && ++last_frames_ >= kLastFrames) ended_ = true;
}

/// An error of another kind comes again in the next frame.
template <typename T>
void Servo::read(OptionalValue& value, const std::function<void(HdEnum, T*)>& get,
                 T* into) noexcept {
    if (!value.known) return;
    get(value.what, into);
    if (now_.ticks == 0) value.known = take_faults(library_).kind != FaultClass::call;
}

/// Without an answer of the library, the values stay zero, and no number for the temperature.
void Servo::read_frame(ArmSample& sample, std::uint8_t& buttons, bool& in_inkwell) noexcept {
    std::array<double, 3> position{};
    std::array<double, 3> velocity{};
    std::array<double, 3> gimbal{};
    std::array<double, kMostMotors> heat{};
    int pressed = 0;
    std::uint8_t inkwell = 0;
    library_.get_doubles(kHdPosition, position.data());
    library_.get_integers(kHdButtons, &pressed);
    read(velocity_, library_.get_doubles, velocity.data());
    read(gimbal_, library_.get_doubles, gimbal.data());
    read(encoders_, library_.get_longs, sample.encoders.data());
    read(heat_, library_.get_doubles, heat.data());
    read(inkwell_, library_.get_booleans, &inkwell);
    sample.position_m = vector_of(position) / kMetre_mm;
    sample.velocity_m_per_s = vector_of(velocity) / kMetre_mm;
    // Without encoders, a stylus that turns tells nothing of the arm.
    if (encoders_.known) sample.gimbal_rad = vector_of(gimbal);
    for (const double motor : heat)
        if (std::isfinite(sample.warmest) && !(motor <= sample.warmest)) sample.warmest = motor;
    sample.calibration = library_.check_calibration();
    buttons = static_cast<std::uint8_t>(pressed & 0xF);
    in_inkwell = inkwell != 0;
}

Vec3 Servo::force_at(Time now) noexcept {
    const Vec3 force = buffers_.force_for(watch_.epoch(), now);
    const double length = glm::length(force);
    return length > now_.limit_newton ? force * (now_.limit_newton / length) : force;
}

void Servo::publish_pose(const ArmSample& sample, std::uint8_t buttons, Time at) noexcept {
    TimedPose& pose = buffers_.poses.back();
    pose.position_m = sample.position_m - arm_.middle_m;
    pose.buttons = buttons_.add(buttons, at);
    pose.at = at;
    pose.epoch = fault_.kind == FaultClass::none && !ending_ ? watch_.epoch() : kNoEpoch;
    pose.exchange_ms = ticks_.within_ms();
    pose.number = now_.ticks + 1;
    DeviceLimits& limits = buffers_.limits.back();
    limits = arm_.limits;
    limits.max_force_newton = now_.limit_newton;
    buffers_.limits.publish();
    buffers_.poses.publish();
}

}  // namespace dibhr::openhaptics
