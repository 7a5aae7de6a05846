// The delta mechanism of the Falcon (README.md: Kinematics, Motors; Stamper's thesis, chapter 3).
#include "device/falcon/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace dibhr::falcon {

namespace {

constexpr double kCountsPerTurn = 1280.0;  // of the motor: 320 slots, x4

/// The direction of a leg, seen from the front: 105, -15 and -135 degrees.
struct Leg {
    double cos{0.0};
    double sin{0.0};
};
constexpr double kCos15 = 0.965925826289068286749743199728897;  // cos 15 degrees
constexpr double kSin15 = 0.258819045102520762348898837624048;  // sin 15 degrees
constexpr double kDiagonal = 0.707106781186547524400844362104849;
constexpr std::array<Leg, 3> kLegs{Leg{-kSin15, kCos15}, Leg{kCos15, -kSin15},
                                   Leg{-kDiagonal, -kDiagonal}};

/// The grip in the frame of a leg [m]: u along the leg's direction, v across, w out of the base.
struct InLeg {
    double u{0.0};
    double v{0.0};
    double w{0.0};
};

InLeg in_leg(Vec3 position, const Leg& leg, const Geometry& geometry) noexcept {
    return {position.x * leg.cos + position.y * leg.sin -
                (geometry.base_radius_m - geometry.platform_radius_m),
            -position.x * leg.sin + position.y * leg.cos +
                (geometry.platform_shift_m - geometry.base_shift_m),
            position.z};
}

Vec3 from_leg(const InLeg& d, const Leg& leg) noexcept {
    return {leg.cos * d.u - leg.sin * d.v, leg.sin * d.u + leg.cos * d.v, d.w};
}

bool has_limbs(const Geometry& geometry) noexcept {
    return geometry.thigh_m > 0.0 && geometry.shin_m > 0.0;
}

/// The shin projected into the plane of the leg: its length, and the derivative by v.
struct Shin {
    double length_m{0.0};
    double change{0.0};  ///< d length / d v
};

/// Nothing when |v| exceeds the length of the shin.
std::optional<Shin> shin_at(double v, const Geometry& geometry) noexcept {
    const double square = geometry.shin_m * geometry.shin_m - v * v;
    if (!(square > 0.0)) return std::nullopt;
    const double along = std::sqrt(square);
    const double length = geometry.shin_end_d_m + geometry.shin_end_e_m + along;
    if (!(length > 0.0)) return std::nullopt;
    return Shin{length, -v / along};
}

struct Elbow {
    double u{0.0};
    double w{0.0};
};

Elbow elbow_at(double angle, const Geometry& geometry) noexcept {
    return {geometry.thigh_m * std::cos(angle), geometry.thigh_m * std::sin(angle)};
}

/// The thigh's angle [rad], with the elbow on the outer side of the grip.
std::optional<double> thigh_angle(const InLeg& grip, double shin_m,
                                  const Geometry& geometry) noexcept {
    const double a = geometry.thigh_m;
    const double reach = std::hypot(grip.u, grip.w);
    const double k = (reach * reach + a * a - shin_m * shin_m) / (2.0 * a);
    if (!(reach > 0.0) || !std::isfinite(reach) || !(std::abs(k) <= reach)) return std::nullopt;
    return std::atan2(grip.w, grip.u) - std::acos(k / reach);
}

/// Twice the area that thigh and shin span [m^2]; zero when they are in line.
double spread(const Elbow& elbow, const InLeg& grip) noexcept {
    return elbow.u * (grip.w - elbow.w) - elbow.w * (grip.u - elbow.u);
}

/// The Vec3 component of leg `i`.
constexpr Vec3::length_type axis(std::size_t i) noexcept {
    return static_cast<Vec3::length_type>(i);
}

double volume_of(const Jacobian& rows) noexcept {
    return glm::dot(rows[0], glm::cross(rows[1], rows[2]));
}

bool singular(const Jacobian& rows) noexcept {
    constexpr double kLeastVolume = 1e-9;  // of the rows as unit vectors
    const double size = glm::length(rows[0]) * glm::length(rows[1]) * glm::length(rows[2]);
    return !(std::abs(volume_of(rows)) > kLeastVolume * size);
}

/// Solves rows * x = right; nothing when the rows are nearly in one plane.
std::optional<Vec3> solved(const Jacobian& rows, Vec3 right) noexcept {
    if (singular(rows)) return std::nullopt;
    const Vec3 x =
        (right.x * glm::cross(rows[1], rows[2]) + right.y * glm::cross(rows[2], rows[0]) +
         right.z * glm::cross(rows[0], rows[1])) /
        volume_of(rows);
    if (!is_finite(x)) return std::nullopt;
    return x;
}

using Elbows = std::array<Elbow, 3>;

/// Errors of the shin lengths for a grip at some place and given elbows.
struct Misfit {
    Vec3 missing_m{0.0};    ///< length of each shin minus the distance of elbow and grip
    Jacobian directions{};  ///< gradients of the distances by the grip's position
    bool beyond{false};     ///< beyond the singular poses, where no hand can move the grip
};

/// Nothing where a shin cannot reach.
std::optional<Misfit> misfit_at(Vec3 position, const Elbows& elbows,
                                const Geometry& geometry) noexcept {
    Misfit misfit;
    for (std::size_t i = 0; i < kLegs.size(); ++i) {
        const InLeg grip = in_leg(position, kLegs[i], geometry);
        const std::optional<Shin> shin = shin_at(grip.v, geometry);
        const double du = grip.u - elbows[i].u;
        const double dw = grip.w - elbows[i].w;
        const double distance = std::sqrt(du * du + dw * dw);
        if (!shin || !(distance > 0.0)) return std::nullopt;
        misfit.missing_m[axis(i)] = shin->length_m - distance;
        misfit.directions[i] = from_leg({du / distance, -shin->change, dw / distance}, kLegs[i]);
    }
    misfit.beyond = volume_of(misfit.directions) > 0.0;
    return misfit;
}

bool outer_elbows(Vec3 position, const Elbows& elbows, const Geometry& geometry) noexcept {
    constexpr double kInLine_m2 = -1e-9;  // rounding, where thigh and shin are in line
    for (std::size_t i = 0; i < kLegs.size(); ++i) {
        if (spread(elbows[i], in_leg(position, kLegs[i], geometry)) < kInLine_m2) return false;
    }
    return true;
}

/// Newton's method on the lengths of the shins. Unlike the angles, they are defined also where no
/// pose is. A step that leaves the reach or crosses the singular poses is halved.
std::optional<Vec3> grip_between(const Elbows& elbows, Vec3 position, bool beyond,
                                 const Geometry& geometry) noexcept {
    constexpr int kMostSteps = 60;
    constexpr int kMostHalvings = 8;
    constexpr double kLongestStep_m = 0.01;
    constexpr double kLastStep_m = 1e-9;  // the error after it is of the order of its square

    std::optional<Misfit> misfit = misfit_at(position, elbows, geometry);
    if (!misfit) return std::nullopt;
    for (int k = 0; k < kMostSteps; ++k) {
        const std::optional<Vec3> whole = solved(misfit->directions, misfit->missing_m);
        if (!whole) return std::nullopt;
        const double length = glm::length(*whole);
        Vec3 step = length > kLongestStep_m ? *whole * (kLongestStep_m / length) : *whole;
        if (length < kLastStep_m) {
            position += step;
            if (!outer_elbows(position, elbows, geometry)) return std::nullopt;
            return position;
        }
        const auto fits = [&] { return misfit && misfit->beyond == beyond; };
        misfit = misfit_at(position + step, elbows, geometry);
        for (int halvings = 0; !fits(); ++halvings) {
            if (halvings == kMostHalvings) return std::nullopt;
            step *= 0.5;
            misfit = misfit_at(position + step, elbows, geometry);
        }
        position += step;
    }
    return std::nullopt;
}

}  // namespace

Vec3 angles_of_counts(Vec3 counts, const Geometry& geometry) noexcept {
    return glm::radians(geometry.angle_at_zero_deg +
                        counts * (360.0 / (kCountsPerTurn * geometry.gear)));
}

Vec3 angles_of_counts(const Counts& counts, const Geometry& geometry) noexcept {
    return angles_of_counts(Vec3{counts[0], counts[1], counts[2]}, geometry);
}

std::optional<Vec3> angles_at(Vec3 position_m, const Geometry& geometry) noexcept {
    if (!has_limbs(geometry)) return std::nullopt;
    Vec3 angles{0.0};
    for (std::size_t i = 0; i < kLegs.size(); ++i) {
        const InLeg grip = in_leg(position_m, kLegs[i], geometry);
        const std::optional<Shin> shin = shin_at(grip.v, geometry);
        if (!shin) return std::nullopt;
        const std::optional<double> angle = thigh_angle(grip, shin->length_m, geometry);
        if (!angle) return std::nullopt;
        angles[axis(i)] = *angle;
    }
    return angles;
}

std::optional<Jacobian> jacobian_at(Vec3 position_m, const Geometry& geometry) noexcept {
    const std::optional<Vec3> angles = angles_at(position_m, geometry);
    if (!angles) return std::nullopt;
    Jacobian rows{};
    for (std::size_t i = 0; i < kLegs.size(); ++i) {
        const InLeg grip = in_leg(position_m, kLegs[i], geometry);
        const std::optional<Shin> shin = shin_at(grip.v, geometry);
        const Elbow elbow = elbow_at((*angles)[axis(i)], geometry);
        const double area = spread(elbow, grip);
        if (!shin || !(area > 0.0)) return std::nullopt;
        rows[i] = from_leg({(grip.u - elbow.u) / area, -shin->length_m * shin->change / area,
                            (grip.w - elbow.w) / area},
                           kLegs[i]);
        if (!is_finite(rows[i])) return std::nullopt;
    }
    if (singular(rows)) return std::nullopt;
    return rows;
}

std::optional<Vec3> position_with(Vec3 angles_rad, Vec3 near_m, const Geometry& geometry) noexcept {
    // Tried when `near_m` finds no pose. The first height finds the whole usable volume; the others
    // find half of the poses that it misses at the workspace's edge.
    constexpr std::array<double, 3> kStartHeights_m{0.115, 0.09, 0.15};

    if (!is_finite(angles_rad) || !has_limbs(geometry)) return std::nullopt;
    const Elbows elbows{elbow_at(angles_rad.x, geometry), elbow_at(angles_rad.y, geometry),
                        elbow_at(angles_rad.z, geometry)};
    if (const auto pose = grip_between(elbows, near_m, false, geometry)) return pose;
    for (const double height_m : kStartHeights_m) {
        const auto pose = grip_between(elbows, {0.0, 0.0, height_m}, false, geometry);
        if (pose) return pose;
    }
    return grip_between(elbows, near_m, true, geometry);
}

std::optional<Vec3> torques_of(Vec3 force_newton, const Jacobian& jacobian) noexcept {
    // With J = d theta / d p, J^T torque = force.
    const Jacobian columns{Vec3{jacobian[0].x, jacobian[1].x, jacobian[2].x},
                           Vec3{jacobian[0].y, jacobian[1].y, jacobian[2].y},
                           Vec3{jacobian[0].z, jacobian[1].z, jacobian[2].z}};
    return solved(columns, force_newton);
}

Counts motor_counts(Vec3 torques_newton_metre, const Motors& motors) noexcept {
    constexpr double kMostCounts = 4095.0;  // beyond it Novint's driver saturates
    const double scale = motors.counts_per_newton_metre;
    // Whole, so that rounding does not lead beyond it.
    const double full = std::floor(std::min(motors.full_scale_counts, kMostCounts));
    if (!is_finite(torques_newton_metre) || !std::isfinite(scale)) return {};
    if (!(scale > 0.0) || !(full > 0.0)) return {};

    const Vec3 size = glm::abs(torques_newton_metre);
    const double largest = std::max({size.x, size.y, size.z});
    const bool saturated = scale * largest > full;
    const auto command = [&](double torque) {
        return static_cast<std::int16_t>(
            std::lround(saturated ? -full * (torque / largest) : -scale * torque));
    };
    return {command(torques_newton_metre.x), command(torques_newton_metre.y),
            command(torques_newton_metre.z)};
}

}  // namespace dibhr::falcon
