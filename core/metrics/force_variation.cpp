// Angles between the forces of successive updates.
#include "core/metrics/force_variation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>

namespace dibhr {

double angle_between_rad(Vec3 a, Vec3 b) noexcept {
    // Not the arc cosine, which rounds angles below 1e-8 to zero.
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

std::vector<char> reversal_updates(std::span<const Vec3> goals, std::span<const double> depths_px,
                                   double mu) {
    std::vector<char> reversal(goals.size(), 0);
    if (goals.empty()) return reversal;
    Vec2 turn(goals[0]);  // along the image
    Vec2 heading{0.0};    // the last step that was not zero: a pause is no turn
    bool reversing = true;
    reversal[0] = 1;
    for (std::size_t k = 1; k < goals.size(); ++k) {
        const Vec2 step(goals[k] - goals[k - 1]);
        if (glm::dot(step, heading) < 0.0) {
            turn = Vec2(goals[k - 1]);
            reversing = true;
        }
        if (step != Vec2(0.0)) heading = step;
        reversal[k] = reversing ? 1 : 0;
        const double dragged_px = 2.0 * mu * std::max(depths_px[k], 0.0);
        if (glm::length(Vec2(goals[k]) - turn) >= dragged_px) reversing = false;
    }
    return reversal;
}

VariationStatistics force_variation(std::span<const Vec3> goals, std::span<const Vec3> proxies,
                                    std::span<const char> contact, std::span<const char> reversal,
                                    std::size_t settling_updates) {
    Spread all;
    Spread sliding;
    for (std::size_t k = 1; k < goals.size(); ++k) {
        if (contact[k - 1] == 0 || contact[k] == 0) continue;
        const double turned_deg =
            glm::degrees(angle_between_rad(proxies[k - 1] - goals[k - 1], proxies[k] - goals[k]));
        all.add(turned_deg);
        if (k >= settling_updates && reversal[k] == 0) sliding.add(turned_deg);
    }
    return {all.mean(), all.sd(), sliding.mean(), sliding.sd(), all.count(), sliding.count()};
}

SampleStatistics statistics_of(std::vector<double> samples) {
    if (samples.empty()) return {};
    std::sort(samples.begin(), samples.end());
    const auto count = static_cast<double>(samples.size());
    const auto at = [&](double q) {
        const double rank = std::ceil(q * count);
        return samples[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
    };
    const double sum = std::accumulate(samples.begin(), samples.end(), 0.0);
    return {samples.size(), sum / count, at(0.5), at(0.99), at(0.999), samples.back()};
}

}  // namespace dibhr
