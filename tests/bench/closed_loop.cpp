// The simulation: a mass, a device of coarse steps and late forces, and the program's own tick.
#include "tests/bench/closed_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/geometric.hpp>
#include <memory>
#include <numeric>

namespace dibhr::bench {

namespace {

constexpr int kColumns = 256;  // pixels of the image
constexpr int kRows = 8;
constexpr double kTick_s = 0.001;
constexpr int kStepsOfTick = 50;
constexpr double kFrame_s = 1.0 / 30.0;
constexpr double kMiddle_px = 100.0;
constexpr double kSettled_s = 2.0;  // from then on work and travel count
constexpr double kUnlimited = 1e9;

/// A device that moves in elevation and along the rows.
class SimulatedArm final : public Device {
  public:
    explicit SimulatedArm(const ClosedLoop& loop)
        : loop_(loop), late_(static_cast<std::size_t>(loop.delay_ticks)) {
        const double stiffness = 1e3 * loop.parameters.coupling.stiffness_newton_per_mm;
        depth_.place_m = loop.press_newton / stiffness;
        if (loop.grip.spring_newton_per_m > 0.0)
            depth_.rest_m = depth_.place_m + loop.press_newton / loop.grip.spring_newton_per_m;
        specification_.limits.max_stiffness_newton_per_mm = kUnlimited;
        specification_.limits.max_damping_newton_s_per_m = kUnlimited;
        // What a driver can state of a device whose mass it has not measured.
        specification_.limits.dynamics = {
            .mass_kg = kMasses_kg.front(),
            .friction_newton_s_per_m = kFrictions_newton_s_per_m.front(),
            .resolution_mm = loop.resolution_mm,
            .delay_s = (loop.stated_ticks < 0 ? loop.delay_ticks : loop.stated_ticks) * kTick_s};
        if (loop.stated) specification_.limits = *loop.stated;
        if (loop.measures_delay)
            specification_.limits = at_delay(specification_.limits, loop.delay_ticks * kTick_s);
    }

    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return specification_;
    }
    HandReading read(const HandContext& context) noexcept override {
        const double pitch_mm = context.pixel_pitch_mm;
        return {.goal_in_grid = {0.5 * kColumns + read_mm(aside_) / pitch_mm, 0.5 * kRows,
                                 kMiddle_px - read_mm(depth_) / pitch_mm}};
    }
    void send(Vec3 force_newton) noexcept override { sent_newton_ = force_newton; }

    /// A tick of motion under the force that acts now; the work it does on hand and device [J].
    double move(double push_newton_s) {
        late_.push_back(sent_newton_);
        const Vec3 newton = late_.front();
        late_.pop_front();
        depth_.speed_m_per_s += push_newton_s / loop_.mass_kg;
        return move(depth_, -newton.z, loop_.press_newton) + move(aside_, newton.x, 0.0);
    }

    [[nodiscard]] double depth_mm() const { return 1e3 * depth_.place_m; }
    [[nodiscard]] double aside_mm() const { return 1e3 * aside_.place_m; }
    [[nodiscard]] Vec3 sent_newton() const { return sent_newton_; }

  private:
    struct Axis {
        double rest_m{0.0};
        double place_m{0.0};
        double speed_m_per_s{0.0};
    };

    [[nodiscard]] double read_mm(const Axis& axis) const {
        const double step = loop_.resolution_mm;
        const double mm = 1e3 * axis.place_m;
        return step > 0.0 ? std::round(mm / step) * step : mm;
    }

    double move(Axis& axis, double newton, double press_newton) const {
        const double before_m = axis.place_m;
        constexpr double kStep_s = kTick_s / kStepsOfTick;
        for (int k = 0; k < kStepsOfTick; ++k) {
            const double all_newton = hand_newton(axis, press_newton) + newton -
                                      loop_.friction_newton_s_per_m * axis.speed_m_per_s;
            axis.speed_m_per_s += all_newton / loop_.mass_kg * kStep_s;
            axis.place_m += axis.speed_m_per_s * kStep_s;
        }
        return newton * (axis.place_m - before_m);
    }

    /// `press_newton`: of a hand that only pushes.
    [[nodiscard]] double hand_newton(const Axis& axis, double press_newton) const {
        const Grip& grip = loop_.grip;
        if (!(grip.spring_newton_per_m > 0.0)) return press_newton;
        return grip.spring_newton_per_m * (axis.rest_m - axis.place_m) -
               grip.damper_newton_s_per_m * axis.speed_m_per_s;
    }

    const ClosedLoop& loop_;
    DeviceSpecification specification_{};
    std::deque<Vec3> late_;  // forces that do not act yet, the next one first
    Axis depth_{};
    Axis aside_{};
    Vec3 sent_newton_{0.0};
};

/// `slide_px`: of its material until the next frame.
Frame frame_at(double time_s, double elevation_px, double slide_px) {
    auto image = std::make_shared<DepthImage>();
    image->columns = kColumns;
    image->rows = kRows;
    image->levels.assign(std::size_t{kColumns} * kRows, static_cast<float>(elevation_px));
    auto field = std::make_shared<MotionField>(MotionField{kColumns, kRows, {}});
    field->ways.assign(std::size_t{kColumns} * kRows, {static_cast<float>(slide_px), 0.0F});
    Frame frame;
    frame.depth = image;
    frame.motion = field;
    frame.time_s = frame.media_s = time_s;
    return frame;
}

double peak_to_peak(const std::vector<double>& values, std::size_t from) {
    const auto [least, most] =
        std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(from), values.end());
    return *most - *least;
}

double rms_about_mean(const std::vector<double>& values, std::size_t from) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(from);
    const double count = static_cast<double>(values.size() - from);
    const double mean = std::accumulate(begin, values.end(), 0.0) / count;
    double squares = 0.0;
    std::for_each(begin, values.end(),
                  [&](double value) { squares += (value - mean) * (value - mean); });
    return std::sqrt(squares / count);
}

/// The tick with its device, settings and frames.
class Bench {
  public:
    explicit Bench(const ClosedLoop& loop) : loop_(loop), arm_(loop) {
        haptic_settings_.parameters = loop.parameters;
        haptic_settings_.parameters.carry = loop.slide_mm_per_s != 0.0;
        haptic_settings_.parameters.shape.relief_px = 255.0;
        haptic_settings_.limits.ramp_s = kTick_s;  // no ramp: the hand did not just arrive
        haptic_settings_.limits.stability = loop.stability;
        if (loop.stability && loop.damping) {
            const DeviceLimits& device = arm_.specification().limits;
            Coupling& coupling = haptic_settings_.parameters.coupling;
            coupling = held_coupling(coupling, device);
            coupling = stable_coupling(coupling, coupling.stiffness_newton_per_mm, device.dynamics);
        }
        hand_over();
    }

    ClosedLoopResult run() {
        ClosedLoopResult result;
        const auto ticks = static_cast<std::int64_t>(loop_.seconds / kTick_s);
        double work_j = 0.0;
        Vec3 last_newton(0.0);
        std::vector<double> aside_mm;
        for (std::int64_t k = 0; k < ticks; ++k) {
            const double t_s = static_cast<double>(k) * kTick_s;
            if (k % 33 == 0) show_surface(t_s);
            if (loop_.change) {
                loop_.change(t_s, haptic_settings_);
                hand_over();
            }
            tick_.run({start_ + k * std::chrono::milliseconds(1), kTick_s, {}, false}, 0);
            const Vec3 newton = arm_.sent_newton();
            const double slew = haptic_settings_.limits.max_change_newton_per_ms + 1e-9;
            result.limits_held =
                result.limits_held &&
                glm::length(newton) <= haptic_settings_.limits.max_force_newton + 1e-9 &&
                glm::length(newton - last_newton) <= slew;
            last_newton = newton;
            const bool taps = k == static_cast<std::int64_t>(kSettled_s / kTick_s);
            const double worked_j = arm_.move(taps ? loop_.tap_newton_s : 0.0);
            if (t_s >= kSettled_s) work_j += worked_j;
            result.depth_mm.push_back(arm_.depth_mm());
            result.force_newton.push_back(newton.z);
            aside_mm.push_back(arm_.aside_mm());
        }
        const std::size_t last_second = result.depth_mm.size() - 1000;
        result.swing_mm = peak_to_peak(result.depth_mm, last_second);
        result.buzz_newton = rms_about_mean(result.force_newton, last_second);
        result.travel_mm =
            peak_to_peak(result.depth_mm, static_cast<std::size_t>(kSettled_s / kTick_s));
        result.aside_mm = arm_.aside_mm();
        result.aside_swing_mm = peak_to_peak(aside_mm, last_second);
        result.work_mw = 1e3 * work_j / (loop_.seconds - kSettled_s);
        result.controller_mw = state_.front().touch.energy.taken_out_mw;
        return result;
    }

  private:
    void hand_over() {
        ++haptic_settings_.version;
        settings_.publish(haptic_settings_);
    }
    /// Publishes the frames around `t_s`, as the player would.
    void show_surface(double t_s) {
        FrameWindow window;
        const double first = std::floor(t_s / kFrame_s) - 1.0;
        for (Frame& frame : window.frames) {
            const double time_s = (first + static_cast<double>(window.count++)) * kFrame_s;
            const double rise_mm = loop_.surface_mm ? loop_.surface_mm(std::max(time_s, 0.0)) : 0.0;
            const double pitch_mm = haptic_settings_.parameters.coupling.pixel_pitch_mm;
            frame = frame_at(time_s, kMiddle_px + rise_mm / pitch_mm,
                             loop_.slide_mm_per_s * kFrame_s / pitch_mm);
        }
        window.clock = {start_, 0.0, 1.0};
        frames_.publish(window);
    }

    const ClosedLoop& loop_;
    SimulatedArm arm_;
    TripleBuffer<FrameWindow> frames_{};
    TripleBuffer<HapticSettings> settings_{};
    TripleBuffer<HapticState> state_{};
    std::unique_ptr<StripRing> strips_{std::make_unique<StripRing>()};
    std::unique_ptr<TickRing> ticks_{std::make_unique<TickRing>()};
    HapticSettings haptic_settings_{};
    HapticTick tick_{{arm_, frames_, settings_, state_, *strips_, *ticks_}};
    std::chrono::steady_clock::time_point start_{std::chrono::hours(1)};
};

}  // namespace

ClosedLoopResult run(const ClosedLoop& loop) {
    return Bench(loop).run();
}

ClosedLoop on_device(const DeviceLimits& stated, double stiffness_newton_per_mm, const Grip& grip,
                     double times_mass, double times_friction) {
    const DeviceDynamics& device = stated.dynamics;
    ClosedLoop loop;
    loop.stability = true;
    loop.grip = grip;
    loop.mass_kg = times_mass * device.mass_kg;
    loop.friction_newton_s_per_m = times_friction * device.friction_newton_s_per_m;
    loop.resolution_mm = device.resolution_mm;
    loop.delay_ticks = static_cast<int>(std::lround(1e3 * device.delay_s));
    loop.stated = stated;
    loop.press_newton = std::min(0.93, 0.5 * stated.max_force_newton);
    loop.parameters.coupling.stiffness_newton_per_mm =
        std::min(stiffness_newton_per_mm, stated.max_stiffness_newton_per_mm);
    return loop;
}

bool oscillates(const ClosedLoopResult& result) {
    constexpr double kMost_mm = 0.2;
    return result.swing_mm > kMost_mm;
}

double lowest_oscillating(ClosedLoop loop, double most) {
    constexpr double kLeast = 0.1;
    constexpr double kStep = 1.12;
    double& stiffness = loop.parameters.coupling.stiffness_newton_per_mm;
    for (stiffness = kLeast; stiffness < most; stiffness *= kStep) {
        if (oscillates(run(loop))) return stiffness;
    }
    return most;
}

}  // namespace dibhr::bench
