// The step in which the user moves the grip: rate of new positions, their resolution, and the
// workspace.
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "core/files/plain_text.hpp"
#include "device/hand/check/numbers.hpp"
#include "device/inverse3/check/context.hpp"

namespace dibhr::inverse3 {

namespace {

using Clock = CheckedInverse3::Clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr double kNoise_mm = 1e-6;           // rounding errors, smaller than any encoder's step
constexpr Milliseconds kStandsStill{100.0};  // after so long without a change the grip is at rest
constexpr std::array kAxes{"x", "y", "z"};

/// Statistics of the received positions.
class Positions {
  public:
    Vec3 lowest_mm{1e9};
    Vec3 highest_mm{-1e9};
    std::size_t count{0};

    void add(Vec3 position_mm, Clock::time_point at) {
        lowest_mm = glm::min(lowest_mm, position_mm);
        highest_mm = glm::max(highest_mm, position_mm);
        if (count++ > 0) add_step(position_mm - last_mm_, at);
        last_mm_ = position_mm;
    }

    /// New positions per second while the grip moved; 0: it did not move.
    [[nodiscard]] double new_per_s() const {
        const double half_ms = intervals_ms_.quantile(0.5);
        return half_ms > 0.0 ? 1000.0 / half_ms : 0.0;
    }
    [[nodiscard]] double step_mm() const {
        double least = 0.0;
        for (const Sample& steps : steps_mm_) {
            const double step = steps.quantile(0.05);
            if (step > 0.0 && (least == 0.0 || step < least)) least = step;
        }
        return least;
    }
    void add_to(Json& measured) const {
        measured["positions"] = count;
        measured["changes_while_moving"] = intervals_ms_.count();
        measured["moving_s"] = moving_.count() / 1000.0;
        measured["new_positions_per_s"] = new_per_s();
        measured["change_interval_ms"] = {{"p05", intervals_ms_.quantile(0.05)},
                                          {"p50", intervals_ms_.quantile(0.5)},
                                          {"p95", intervals_ms_.quantile(0.95)}};
        measured["smallest_step_mm"] = step_mm();
        for (std::size_t k = 0; k < kAxes.size(); ++k) {
            measured["steps"][kAxes.at(k)] = {{"count", steps_mm_.at(k).count()},
                                              {"different", steps_mm_.at(k).different()},
                                              {"step_mm_p05", steps_mm_.at(k).quantile(0.05)},
                                              {"step_mm_p50", steps_mm_.at(k).quantile(0.5)}};
        }
        measured["lowest_mm"] = along_axes(lowest_mm);
        measured["highest_mm"] = along_axes(highest_mm);
    }

  private:
    void add_step(Vec3 step_mm, Clock::time_point at) {
        bool changed = false;
        for (std::size_t k = 0; k < kAxes.size(); ++k) {
            const double step = std::abs(step_mm[static_cast<int>(k)]);
            if (!(step > kNoise_mm)) continue;
            changed = true;
            steps_mm_.at(k).add(std::round(step / kNoise_mm) * kNoise_mm);
        }
        if (!changed) return;
        const Milliseconds since = changed_at_ ? Milliseconds(at - *changed_at_) : kStandsStill;
        changed_at_ = at;
        if (since >= kStandsStill) return;
        intervals_ms_.add(since.count());
        moving_ += since;
    }

    Vec3 last_mm_{0.0};
    std::optional<Clock::time_point> changed_at_{};
    Sample intervals_ms_{};
    Milliseconds moving_{0.0};
    std::array<Sample, 3> steps_mm_{};
};

}  // namespace

void check_moving(CheckContext& context, Json& measured) {
    context.console.ask(
        "Move the grip slowly, then to every end; Enter when you have been everywhere. No force.");
    Positions positions;
    const auto limit = Clock::now() + context.options.times.moving;
    bool answered = false;
    while (!(answered = context.answered()) && Clock::now() < limit) {
        const auto received = context.device.exchange(std::nullopt, context.likely_dialect());
        if (received.arm.position_m)
            positions.add(*received.arm.position_m * kMetre_mm, Clock::now());
    }
    measured["ended_by_enter"] = answered;
    if (!answered) context.print_timeout(context.options.times.moving);
    if (positions.count == 0) throw DeviceError("no position came that makes sense");
    positions.add_to(measured);
    measured.update(reported_frame(context.device));
    if (!(positions.new_per_s() > 0.0)) {
        context.console.print("The grip was not moved: its steps and its workspace stay open.");
        return;
    }
    const Vec3 size_mm = positions.highest_mm - positions.lowest_mm;
    context.findings.record_answer(OpenQuestion::device_rate,
                                   number_text(positions.new_per_s(), 0) + " while it moved");
    context.findings.record_answer(
        OpenQuestion::step,
        number_text(positions.step_mm(), 4) + " mm (95 % of the steps along an axis are longer)");
    context.findings.record_answer(OpenQuestion::workspace, number_text(size_mm.x, 0) + " x " +
                                                                number_text(size_mm.y, 0) + " x " +
                                                                number_text(size_mm.z, 0) +
                                                                " mm (x, y, z) were reached");
}

}  // namespace dibhr::inverse3
