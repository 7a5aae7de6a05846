// How fast the hand and the point on the surface move.
#include "core/report/speed_window.hpp"

#include <glm/geometric.hpp>

namespace dibhr {

namespace {

constexpr double kRounding_s = 1e-9;
constexpr double kLongestWindow_s = 3.0 * kSpeedWindow_s;  // longer: something is missing

}  // namespace

std::optional<Speeds> SpeedWindow::add(const TickRecord& tick, double pitch_mm) {
    const Place now{tick.t_s, tick.goal, tick.proxy};
    // What comes after a jump is compared with nothing before it.
    if (!tick.surface || tick.lets_go || tick.from_zero) places_.clear();
    if (!tick.surface || !is_finite(now.goal_px) || !is_finite(now.proxy_px)) return std::nullopt;
    places_.push_back(now);
    const double begin_s = now.t_s - kSpeedWindow_s + kRounding_s;
    while (places_.size() > 1 && places_[1].t_s <= begin_s) places_.pop_front();
    const Place& then = places_.front();
    const double between_s = now.t_s - then.t_s;
    if (then.t_s > begin_s || between_s > kLongestWindow_s) return std::nullopt;
    const double mm_per_s_of_px = pitch_mm / between_s;
    return Speeds{glm::length(now.goal_px - then.goal_px) * mm_per_s_of_px,
                  glm::length(now.proxy_px - then.proxy_px) * mm_per_s_of_px};
}

}  // namespace dibhr
