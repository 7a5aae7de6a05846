// Goal -> proxy -> spring force -> safe force.
#include "core/haptics/touch.hpp"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "core/haptics/dibhr.hpp"

namespace dibhr {

namespace {}  // namespace

Vec3 coupling_force(const Proxy& proxy, Vec3 goal, Vec3 goal_velocity,
                    const Coupling& coupling) noexcept {
    if (!proxy.contact) return Vec3(0.0);
    const double mm = coupling.pixel_pitch_mm;
    return coupling.stiffness_newton_per_mm * mm * (proxy.position - goal) -
           coupling.damping_newton_s_per_m * 1e-3 * mm * goal_velocity;
}

TouchRenderer::TouchRenderer(std::unique_ptr<ProxyAlgorithm> algorithm)
    : algorithm_(std::move(algorithm)) {}

const Touch& TouchRenderer::update(const DepthSurface& surface, Vec3 goal,
                                   const TouchParameters& parameters, SafetyInput input,
                                   const SafetyLimits& limits) noexcept {
    if (!is_finite(goal)) {
        last_.spring_force_newton = Vec3(0.0);
        last_.sent_force_newton = safety_.limit(Vec3(NAN), input, limits);
        last_.cut = safety_.last_cut();
        return last_;
    }
    const Vec3 goal_step = started_ ? goal - last_.goal : Vec3(0.0);
    input.goal_step_mm = glm::length(goal_step) * parameters.coupling.pixel_pitch_mm;
    input.restart = input.restart || !started_;
    started_ = true;

    last_.goal = goal;
    last_.proxy = algorithm_->update(surface, goal, parameters.friction);
    const Vec3 goal_velocity = input.dt_s > 0.0 ? goal_step / input.dt_s : Vec3(0.0);
    last_.spring_force_newton =
        coupling_force(last_.proxy, goal, goal_velocity, parameters.coupling);
    last_.sent_force_newton = safety_.limit(last_.spring_force_newton, input, limits);
    last_.cut = safety_.last_cut();
    return last_;
}

std::unique_ptr<ProxyAlgorithm> make_algorithm(Algorithm algorithm) {
    switch (algorithm) {
        case Algorithm::dibhr:
            break;
    }
    return std::make_unique<Dibhr>();
}

}  // namespace dibhr
