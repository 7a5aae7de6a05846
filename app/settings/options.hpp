// The one table of numeric touch options: it drives the command line, the settings file and the
// sliders.
#pragma once

#include <span>
#include <string_view>

#include "core/haptics/parameters.hpp"

namespace dibhr {

/// One number people tune. Its default is what TouchParameters{} holds.
struct NumberOption {
    /// "static-friction": the option is --static-friction, the setting static-friction.
    std::string_view name;
    std::string_view label;  ///< "Static friction", for the panel
    std::string_view unit;   ///< "N/mm"; empty for a ratio
    double lowest;
    double highest;
    std::string_view help;
    double& (*in)(TouchParameters&);
    const char* zero{nullptr};  ///< what 0 is called, for the panel: "off"; null: the number
};

/// relief, pixel-pitch, stiffness, damping, damping-cutoff, static-friction, dynamic-friction,
/// roughness.
[[nodiscard]] std::span<const NumberOption> number_options();

/// Moves every number into its range and dynamic friction to at most static friction.
void keep_in_range(TouchParameters& parameters);

}  // namespace dibhr
