// Damping, velocity, the video's motion, and the passivity observer and controller.
#include "core/haptics/stability.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace dibhr {

namespace {

constexpr double kTick_s = 0.001;
constexpr double kMetre_mm = 1000.0;
// Measured with tests/bench over all its hands: README.md, Stability.
constexpr double kDampingCutoff_hz = 200.0;
constexpr double kVideoCutoff_hz = 4.0;
constexpr double kExcessDecay_s = 1.0;  // of energy that nothing takes out
constexpr double kTakenOutWithin_s = 0.003;
constexpr double kRestsAfter_s = 0.1;
constexpr double kMostExcess_mj = 10.0;
constexpr double kFlowTime_s = 1.0;

/// How late a force that is held for a tick acts on average.
double lateness_s(const DeviceDynamics& device) noexcept {
    return kTick_s / 2.0 + device.delay_s;
}

/// The strongest damper that is itself stable on a device of this mass and delay.
double most_damping(const DeviceDynamics& device) noexcept {
    return 0.75 * device.mass_kg / lateness_s(device);
}

Vec3 direction_of(Vec3 way) noexcept {
    const double length = glm::length(way);
    return length > 0.0 ? way / length : Vec3(0.0);
}

/// The energy of a spring that pulls no harder than `most_newton` [mJ].
double spring_energy(double length_mm, double stiffness, double most_newton) noexcept {
    const double most_mm = stiffness > 0.0 ? most_newton / stiffness : 0.0;
    const double elastic_mm = std::min(length_mm, most_mm);
    return 0.5 * stiffness * elastic_mm * elastic_mm + most_newton * (length_mm - elastic_mm);
}

}  // namespace

double share_of_newest(double dt_s, double time_constant_s) noexcept {
    return dt_s > 0.0 ? dt_s / (dt_s + time_constant_s) : 0.0;
}

double time_constant_of(double cutoff_hz) noexcept {
    return cutoff_hz > 0.0 ? 1.0 / (2.0 * std::numbers::pi * cutoff_hz) : 0.0;
}

double stability_margin(const Coupling& coupling, const DeviceDynamics& device) noexcept {
    const double driven = coupling.stiffness_newton_per_mm * kMetre_mm * lateness_s(device);
    return coupling.damping_newton_s_per_m + device.friction_newton_s_per_m - driven;
}

double needed_damping(double stiffness_newton_per_mm, const DeviceDynamics& device) noexcept {
    if (!device.moves()) return 0.0;
    const Coupling undamped{.stiffness_newton_per_mm = stiffness_newton_per_mm};
    return std::max(0.0, device.margin_newton_s_per_m - stability_margin(undamped, device));
}

double most_stiffness(const DeviceDynamics& device) noexcept {
    if (!device.moves()) return std::numeric_limits<double>::infinity();
    const double left =
        most_damping(device) + device.friction_newton_s_per_m - device.margin_newton_s_per_m;
    return std::max(0.0, left / lateness_s(device) / kMetre_mm);
}

Coupling stable_coupling(Coupling coupling, double effective_stiffness,
                         const DeviceDynamics& device) noexcept {
    const double needed = needed_damping(effective_stiffness, device);
    if (!(needed > 0.0)) return coupling;
    coupling.damping_newton_s_per_m = needed;
    coupling.damping_cutoff_hz = kDampingCutoff_hz;
    return coupling;
}

Vec3 AdaptiveWindow::after(Vec3 way, double dt_s, double resolution) noexcept {
    length_ = std::min(length_ + 1, kLongest);
    for (std::size_t k = length_ - 1; k > 0; --k) {
        way_[k] = way_[k - 1] + way;
        age_s_[k] = age_s_[k - 1] + dt_s;
    }
    way_[0] = way;
    age_s_[0] = dt_s;
    const double tolerance = tolerance_ * resolution;
    return {slope(0, tolerance), slope(1, tolerance), slope(2, tolerance)};
}

double AdaptiveWindow::slope(int axis, double tolerance) const noexcept {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    double found = 0.0;
    for (std::size_t k = 0; k < length_; ++k) {
        const double way = way_[k][axis];
        const double straight = way / age_s_[k];
        if (straight < lowest || straight > highest) break;
        found = straight;
        lowest = std::max(lowest, (way - tolerance) / age_s_[k]);
        highest = std::min(highest, (way + tolerance) / age_s_[k]);
    }
    return found;
}

bool RestWatch::rests_after(Vec3 way, double dt_s, double resolution) noexcept {
    constexpr double kRoundOff = 1.01;
    off_ += way;
    rested_s_ += dt_s;
    const double distance = glm::length(off_);
    if (distance > resolution * kRoundOff) {
        off_ *= resolution / distance;
        rested_s_ = 0.0;
    }
    return rested_s_ > kRestsAfter_s;
}

double VideoMotion::filtered_rise(double rise_px, double dt_s, double most_px) noexcept {
    const double behind = lag_px_ + rise_px;
    const double share = share_of_newest(dt_s, time_constant_of(kVideoCutoff_hz));
    const double step = std::min(behind * share, most_px);
    lag_px_ = behind - step;
    return step;
}

Vec3 PassivityControl::acting_force(double dt_s, double delay_s) const noexcept {
    const double ticks = std::round(delay_s / dt_s);
    const double held = ticks >= 0.0 ? std::min(ticks, kMostDelay - 1.0) : 0.0;  // also no number
    return sent_newton_[static_cast<std::size_t>(held)];
}

double PassivityControl::damping_for(double speed, const DeviceDynamics& device) const noexcept {
    if (speed == 0.0) return 0.0;
    const double wanted = kMetre_mm * excess_mj_ / (speed * speed * kTakenOutWithin_s);
    return std::min(wanted, most_damping(device));
}

auto PassivityControl::account_for(const Tick& tick, Vec3 along,
                                   const DeviceDynamics& device) noexcept -> Energy {
    const double stiffness = tick.stiffness_newton_per_mm;
    const double length_mm = glm::length(tick.lag_mm);
    const double from_video = update_spring_pull(tick, along);
    // Both with the present stiffness: a stiffness that a person changes creates no energy.
    const double stored = spring_energy(length_mm, stiffness, tick.max_force_newton) -
                          spring_energy(length_mm_, stiffness, tick.max_force_newton);
    const double rubbed =
        spring_energy(glm::length(tick.lag_mm - tick.slid_mm), stiffness, tick.max_force_newton) -
        spring_energy(length_mm, stiffness, tick.max_force_newton);
    const double worked = glm::dot(acting_force(tick.dt_s, device.delay_s), tick.goal_step_mm);
    length_mm_ = length_mm;
    return {worked + stored - from_video + rubbed, from_video};
}

/// Updates the spring's pull on the hand. Gives the video's energy since the last update [mJ].
double PassivityControl::update_spring_pull(const Tick& tick, Vec3 along) noexcept {
    const Vec3 before = pull_newton_;
    pull_newton_ =
        std::min(tick.stiffness_newton_per_mm * glm::length(tick.lag_mm), tick.max_force_newton) *
        along;
    const double from_video = 0.5 * glm::dot(before + pull_newton_, tick.video_step_mm);
    fill_video_tank(tick.dt_s, from_video);
    return from_video;
}

Vec3 PassivityControl::force_after(const Tick& tick, const DeviceDynamics& device) noexcept {
    const Vec3 along = direction_of(tick.lag_mm);
    const Energy energy = account_for(tick, along, device);
    const auto speed_in = [&](AdaptiveWindow& window) {
        return glm::dot(window.after(tick.goal_step_mm, tick.dt_s, device.resolution_mm), along);
    };
    const double speed = speed_in(quick_velocity_);
    const double steady = speed_in(steady_velocity_);
    const double margin =
        (device.margin_newton_s_per_m - device.friction_newton_s_per_m) / kMetre_mm;
    const double remaining_excess_mj =
        excess_mj_ * (1.0 - share_of_newest(tick.dt_s, kExcessDecay_s));
    excess_mj_ =
        std::clamp(remaining_excess_mj + energy.created + margin * steady * steady * tick.dt_s, 0.0,
                   kMostExcess_mj);
    if (rest_.rests_after(tick.goal_step_mm, tick.dt_s, device.resolution_mm)) excess_mj_ = 0.0;
    const double damping = damping_for(speed, device);
    smooth_flow({energy.from_video / tick.dt_s, std::max(0.0, energy.created) / tick.dt_s,
                 damping / kMetre_mm * speed * speed, damping},
                tick.dt_s);
    return -damping / kMetre_mm * speed * along;
}

double PassivityControl::most_rise_mm(double stiffness) const noexcept {
    // The rise at which pull * rise + stiffness / 2 * rise^2 empties the tank.
    const double pull = std::max(0.0, pull_newton_.z);
    const double both = pull + std::sqrt(pull * pull + 2.0 * stiffness * video_mj_);
    return both > 0.0 ? 2.0 * video_mj_ / both : std::numeric_limits<double>::infinity();
}

void PassivityControl::fill_video_tank(double dt_s, double from_video_mj) noexcept {
    constexpr double kVideo_mw = 20.0;
    const double left_mj = video_mj_ + kVideo_mw * dt_s - from_video_mj;
    video_mj_ = left_mj > 0.0 ? std::min(left_mj, kVideoAtOnce_mj) : 0.0;  // also no number
}

void PassivityControl::record_sent_force(Vec3 force_newton) noexcept {
    std::shift_right(sent_newton_.begin(), sent_newton_.end(), 1);
    sent_newton_.front() = force_newton;
}

void PassivityControl::skip_tick(double dt_s) noexcept {
    pull_newton_ = Vec3(0.0);
    skip_tick({.dt_s = dt_s});
}

void PassivityControl::skip_tick(const Tick& tick) noexcept {
    quick_velocity_.forget();
    steady_velocity_.forget();
    rest_ = {};
    length_mm_ = excess_mj_ = 0.0;
    const double from_video = update_spring_pull(tick, direction_of(tick.lag_mm));
    smooth_flow({.from_video_mw = tick.dt_s > 0.0 ? from_video / tick.dt_s : 0.0}, tick.dt_s);
}

void PassivityControl::smooth_flow(const EnergyFlow& now, double dt_s) noexcept {
    const double newest = share_of_newest(dt_s, kFlowTime_s);
    const auto follow = [newest](double& flow_mw, double now_mw) {
        flow_mw += newest * (now_mw - flow_mw);
    };
    follow(flow_.from_video_mw, now.from_video_mw);
    follow(flow_.created_mw, now.created_mw);
    follow(flow_.taken_out_mw, now.taken_out_mw);
    flow_.damping_newton_s_per_m = now.damping_newton_s_per_m;
}

}  // namespace dibhr
