// The table of the numbers people tune.
#include "core/haptics/parameter_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dibhr {
namespace {

// The highest stiffness is what a millimetre of penetration may pull with on a Falcon (8 N) and
// then some; the safety stage holds whatever these ask for.
constexpr std::array kTouchNumbers{
    TouchNumber{"relief", "Relief", "relief_px", "px", 0.0, 4096.0,
                "Elevation of the nearest depth; 255 makes a grey level a pixel",
                [](TouchParameters& p) -> double& { return p.shape.relief_px; }},
    TouchNumber{"pixel-pitch", "Pixel pitch", "pixel_pitch_mm", "mm", 0.001, 10.0,
                "Size of a pixel under the hand",
                [](TouchParameters& p) -> double& { return p.coupling.pixel_pitch_mm; }},
    TouchNumber{"stiffness", "Stiffness", "stiffness_newton_per_mm", "N/mm", 0.0, 10.0,
                "Force of the spring from goal to proxy",
                [](TouchParameters& p) -> double& { return p.coupling.stiffness_newton_per_mm; }},
    TouchNumber{"damping", "Damping", "damping_newton_s_per_m", "N s/m", 0.0, 100.0,
                "Force against the speed of the goal",
                [](TouchParameters& p) -> double& { return p.coupling.damping_newton_s_per_m; }},
    TouchNumber{"damping-cutoff", "Damping cutoff", "damping_cutoff_hz", "Hz", 0.0, 800.0,
                "Low-pass on the speed that is damped, against the buzz of a device's steps: 50 "
                "Hz suits a Falcon; 0: off",
                [](TouchParameters& p) -> double& { return p.coupling.damping_cutoff_hz; }, "off"},
    TouchNumber{"static-friction", "Static friction", "static_friction", "", 0.0, 5.0,
                "Coefficient while the contact sticks",
                [](TouchParameters& p) -> double& { return p.friction.static_coefficient; }},
    TouchNumber{"dynamic-friction", "Dynamic friction", "dynamic_friction", "", 0.0, 5.0,
                "Coefficient while it slips, at most the static one",
                [](TouchParameters& p) -> double& { return p.friction.dynamic_coefficient; }},
    TouchNumber{"roughness", "Roughness", "roughness_px", "px", 0.0, 256.0,
                "Elevation of the bump map's highest point",
                [](TouchParameters& p) -> double& { return p.shape.roughness_px; }},
};

}  // namespace

std::span<const TouchNumber> touch_numbers() noexcept {
    return kTouchNumbers;
}

const TouchNumber* touch_number(std::string_view name) noexcept {
    const auto found =
        std::find_if(kTouchNumbers.begin(), kTouchNumbers.end(),
                     [name](const TouchNumber& number) { return number.name == name; });
    return found == kTouchNumbers.end() ? nullptr : &*found;
}

void keep_in_range(TouchParameters& parameters) {
    TouchParameters defaults;
    for (const TouchNumber& option : kTouchNumbers) {
        double& value = option.in(parameters);
        if (!std::isfinite(value)) value = option.in(defaults);
        value = std::clamp(value, option.lowest, option.highest);
    }
    Friction& friction = parameters.friction;
    friction.dynamic_coefficient =
        std::min(friction.dynamic_coefficient, friction.static_coefficient);
}

}  // namespace dibhr
