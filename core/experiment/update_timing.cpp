// Timing of single updates.
#include "core/experiment/update_timing.hpp"

#include <chrono>
#include <cstddef>
#include <utility>

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;

double us_between(Clock::time_point begin, Clock::time_point end) {
    return std::chrono::duration<double, std::micro>(end - begin).count();
}

}  // namespace

double clock_cost_us() {
    std::vector<double> costs(10001);
    for (double& cost : costs) {
        const auto begin = Clock::now();
        cost = us_between(begin, Clock::now());
    }
    return statistics_of(std::move(costs)).median;
}

UpdateTiming time_updates(ProxyAlgorithm& algorithm, const DepthSurface& surface,
                          const std::vector<Vec3>& goals, const Friction& friction) {
    algorithm.restart();
    for (const Vec3& goal : goals) algorithm.update(surface, goal, friction);

    UpdateTiming timing;
    std::vector<double> times_us(goals.size());
    double moves = 0.0;
    algorithm.restart();
    for (std::size_t k = 0; k < goals.size(); ++k) {
        const auto begin = Clock::now();
        const Proxy& proxy = algorithm.update(surface, goals[k], friction);
        times_us[k] = us_between(begin, Clock::now());
        moves += proxy.moves;
        timing.bound_met = timing.bound_met || proxy.bound_met;
    }
    timing.moves_per_update = goals.empty() ? 0.0 : moves / static_cast<double>(goals.size());
    timing.update_us = statistics_of(std::move(times_us));
    return timing;
}

}  // namespace dibhr
