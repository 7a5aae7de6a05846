// The table of arms.
#include "device/forcedimension/models.hpp"

#include <algorithm>
#include <array>

namespace dibhr::forcedimension {

namespace {

constexpr double kMaxStiffness_newton_per_mm = 1.0;
// Nominal: the lightest arm; a step of 0.01 mm; one exchange and a half.
constexpr DeviceDynamics kNominalDynamics{
    .mass_kg = 0.2, .friction_newton_s_per_m = 0.3, .resolution_mm = 0.01, .delay_s = 0.002};

// README.md, Numbers, has the sources. lambda.3 and lambda.6 as lambda.7, sigma.3 as sigma.7.
constexpr std::array<ArmModel, 15> kModels{{
    {33, "omega.3", 12.0, 75.0},
    {34, "omega.6", 12.0, 75.0},
    {36, "omega.6 (left)", 12.0, 75.0},
    {35, "omega.7", 12.0, 75.0},
    {37, "omega.7 (left)", 12.0, 75.0},
    {63, "delta.3", 20.0, 150.0},
    {206, "sigma.3", 12.0, 75.0},
    {104, "sigma.7", 12.0, 75.0, {-0.01, 0.02, 0.0}},
    {105, "sigma.7 (left)", 12.0, 75.0, {-0.01, -0.02, 0.0}},
    {203, "lambda.3", 12.0, 112.5},
    {108, "lambda.7", 12.0, 112.5},
    {109, "lambda.7 (left)", 12.0, 112.5},
    {131, "lambda.6", 12.0, 112.5},
    {132, "lambda.6 (left)", 12.0, 112.5},
    {0, "arm of unknown type", 4.0, 75.0},  // last
}};

const ArmModel* find(int type) noexcept {
    return std::find_if(kModels.begin(), kModels.end() - 1,
                        [type](const ArmModel& model) { return model.type == type; });
}

}  // namespace

const ArmModel& model_of(int type) noexcept {
    return *find(type);
}

bool is_known(int type) noexcept {
    return find(type) != kModels.end() - 1;
}

int known_type(std::size_t n) noexcept {
    return n < kModels.size() ? kModels[n].type : 0;
}

std::string name_of_type(int type) {
    return is_known(type) ? model_of(type).name : "arm of type " + std::to_string(type);
}

DeviceLimits limits_of(const ArmModel& model) noexcept {
    DeviceLimits limits;
    limits.max_force_newton = model.force_newton;
    limits.max_stiffness_newton_per_mm = kMaxStiffness_newton_per_mm;
    limits.dynamics = kNominalDynamics;
    return limits;
}

DeviceLimits strongest_limits() noexcept {
    return limits_of(*std::max_element(
        kModels.begin(), kModels.end(),
        [](const ArmModel& a, const ArmModel& b) { return a.force_newton < b.force_newton; }));
}

}  // namespace dibhr::forcedimension
