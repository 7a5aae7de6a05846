// Linkage and hand of the simulated Falcon.
#include "tests/device/falcon/hand_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dibhr::test::falcon {

namespace {

// Outward directions of the legs, degrees: 1 = top, 2 = right, 3 = left.
constexpr std::array kLegs_deg{105.0, -15.0, -135.0};
constexpr double kRadian_deg = 57.29577951308232;

// A twentieth of the hand's own period is some milliseconds: a quarter of one is plenty.
constexpr double kStep_s = 0.00025;
constexpr double kDifference_m = 1e-6;  // for finite differences of angles of about a radian

/// One thigh's angle. With t = tan(angle / 2), |(u, w) - elbow| = reach is a quadratic in t.
std::optional<double> thigh_angle(double u, double v, double w, const Linkage& link) noexcept {
    if (std::abs(v) >= link.shin_m) return std::nullopt;
    const double reach = link.shin_ends_m + std::sqrt(link.shin_m * link.shin_m - v * v);
    const double k = u * u + w * w + link.thigh_m * link.thigh_m - reach * reach;
    const double across = 2.0 * link.thigh_m * u;
    const double along = 2.0 * link.thigh_m * w;
    const double discriminant = across * across + along * along - k * k;
    if (discriminant < 0.0) return std::nullopt;
    // (k + across) t^2 - 2 along t + (k - across) = 0; the elbow is on the outer side.
    return 2.0 * std::atan((along - std::sqrt(discriminant)) / (k + across));
}

}  // namespace

std::optional<Vec3> Linkage::angles_at(Vec3 grip_m) const noexcept {
    Vec3 angles{0.0};
    for (int leg = 0; leg < 3; ++leg) {
        const double phi = kLegs_deg.at(static_cast<std::size_t>(leg)) / kRadian_deg;
        const double u = grip_m.x * std::cos(phi) + grip_m.y * std::sin(phi) - base_less_platform_m;
        const double v = -grip_m.x * std::sin(phi) + grip_m.y * std::cos(phi) + tangential_m;
        const auto angle = thigh_angle(u, v, grip_m.z, *this);
        if (!angle || !std::isfinite(*angle)) return std::nullopt;
        angles[leg] = *angle;
    }
    return angles;
}

std::optional<Vec3> Linkage::counts_at(Vec3 grip_m) const noexcept {
    const auto angles = angles_at(grip_m);
    if (!angles) return std::nullopt;
    return (*angles - Vec3(angle_at_zero_rad)) * counts_per_rad;
}

Vec3 Linkage::force_of(Vec3 torques_newton_metre, Vec3 grip_m) const noexcept {
    Vec3 force{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 aside{0.0};
        aside[axis] = kDifference_m;
        const auto ahead = angles_at(grip_m + aside);
        const auto behind = angles_at(grip_m - aside);
        if (!ahead || !behind) return Vec3(0.0);
        const Vec3 turned = torques_newton_metre * (*ahead - *behind);
        force[axis] = (turned.x + turned.y + turned.z) / (2.0 * kDifference_m);
    }
    return force;
}

HandModel::HandModel(const HandOptions& options)
    : options_(options), grip_(options.start_m), hand_(options.start_m) {
    if (!linkage_.angles_at(grip_)) throw std::invalid_argument("the grip cannot be there");
}

void HandModel::place(Vec3 grip_m) {
    if (!linkage_.angles_at(grip_m)) throw std::invalid_argument("the grip cannot be there");
    way_.clear();
    grip_ = hand_ = grip_m;
    velocity_ = Vec3(0.0);
}

void HandModel::move(Vec3 to_m, double seconds) {
    way_.push_back({to_m, std::max(seconds, 0.0)});
}

void HandModel::drive(const std::array<std::int16_t, 3>& motor_counts) noexcept {
    // A positive command pulls the thigh down.
    torques_ =
        Vec3(motor_counts[0], motor_counts[1], motor_counts[2]) / -options_.counts_per_newton_metre;
}

Vec3 HandModel::motor_force_newton() const noexcept {
    if (torques_ == Vec3(0.0)) return Vec3(0.0);
    return linkage_.force_of(torques_, grip_);
}

void HandModel::advance(double seconds) {
    while (seconds > 0.0) {
        const double now = std::min(seconds, kStep_s);
        walk(now);
        step(now);
        seconds -= now;
    }
}

void HandModel::walk(double seconds) {
    while (!way_.empty()) {
        Leg& leg = way_.front();
        if (leg.seconds > seconds) {
            hand_ += (leg.to - hand_) * (seconds / leg.seconds);
            leg.seconds -= seconds;
            return;
        }
        seconds -= leg.seconds;
        hand_ = leg.to;
        way_.pop_front();
    }
}

void HandModel::step(double seconds) {
    const Vec3 force = (hand_ - grip_) * options_.stiffness_newton_per_m -
                       velocity_ * options_.damping_newton_s_per_m + motor_force_newton();
    velocity_ += force * (seconds / options_.mass_kg);
    const Vec3 next = grip_ + velocity_ * seconds;
    if (linkage_.angles_at(next)) {
        grip_ = next;
    } else {
        velocity_ = Vec3(0.0);  // the mechanism's own end
    }
}

std::array<int, 3> HandModel::counts() const noexcept {
    const Vec3 counts = linkage_.counts_at(grip_).value_or(Vec3(0.0));
    return {static_cast<int>(std::lround(counts.x)), static_cast<int>(std::lround(counts.y)),
            static_cast<int>(std::lround(counts.z))};
}

}  // namespace dibhr::test::falcon
