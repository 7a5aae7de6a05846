// The table of numeric touch options.
#include "app/settings/options.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dibhr {
namespace {

// The highest stiffness is what a millimetre of penetration may pull with on a Falcon (8 N) and
// then some; the safety stage holds whatever these ask for.
constexpr std::array kNumberOptions{
    NumberOption{"relief", "Relief", "px", 0.0, 4096.0,
                 "Elevation of the nearest depth; 255 makes a grey level a pixel",
                 [](TouchParameters& p) -> double& { return p.shape.relief_px; }},
    NumberOption{"pixel-pitch", "Pixel pitch", "mm", 0.001, 10.0, "Size of a pixel under the hand",
                 [](TouchParameters& p) -> double& { return p.coupling.pixel_pitch_mm; }},
    NumberOption{"stiffness", "Stiffness", "N/mm", 0.0, 10.0,
                 "Force of the spring from goal to proxy",
                 [](TouchParameters& p) -> double& { return p.coupling.stiffness_newton_per_mm; }},
    NumberOption{"damping", "Damping", "N s/m", 0.0, 100.0, "Force against the speed of the goal",
                 [](TouchParameters& p) -> double& { return p.coupling.damping_newton_s_per_m; }},
    NumberOption{"damping-cutoff", "Damping cutoff", "Hz", 0.0, 800.0,
                 "Low-pass on the speed that is damped, against the buzz of a device's steps: 50 "
                 "Hz suits a Falcon; 0: off",
                 [](TouchParameters& p) -> double& { return p.coupling.damping_cutoff_hz; }, "off"},
    NumberOption{"static-friction", "Static friction", "", 0.0, 5.0,
                 "Coefficient while the contact sticks",
                 [](TouchParameters& p) -> double& { return p.friction.static_coefficient; }},
    NumberOption{"dynamic-friction", "Dynamic friction", "", 0.0, 5.0,
                 "Coefficient while it slips, at most the static one",
                 [](TouchParameters& p) -> double& { return p.friction.dynamic_coefficient; }},
    NumberOption{"roughness", "Roughness", "px", 0.0, 256.0,
                 "Elevation of the bump map's highest point",
                 [](TouchParameters& p) -> double& { return p.shape.roughness_px; }},
};

}  // namespace

std::span<const NumberOption> number_options() {
    return kNumberOptions;
}

void keep_in_range(TouchParameters& parameters) {
    TouchParameters defaults;
    for (const NumberOption& option : kNumberOptions) {
        double& value = option.in(parameters);
        if (!std::isfinite(value)) value = option.in(defaults);
        value = std::clamp(value, option.lowest, option.highest);
    }
    Friction& friction = parameters.friction;
    friction.dynamic_coefficient =
        std::min(friction.dynamic_coefficient, friction.static_coefficient);
}

}  // namespace dibhr
