// The one table of the numbers people tune: it drives the command line, the settings file, the
// panel, the session file and every report.
#pragma once

#include <span>
#include <string_view>

#include "core/haptics/parameters.hpp"

namespace dibhr {

/// One number people tune. Its default is what TouchParameters{} holds.
struct TouchNumber {
    /// "static-friction": the option is --static-friction, the setting static-friction.
    std::string_view name;
    std::string_view label;   ///< "Static friction", for the panel
    std::string_view column;  ///< "static_friction": in a session file and in JSON, with its unit
    std::string_view unit;    ///< "N/mm"; empty for a ratio
    double lowest;
    double highest;
    std::string_view help;
    double& (*in)(TouchParameters&);
    const char* zero{nullptr};  ///< what 0 is called, for the panel: "off"; null: the number
};

/// relief, pixel-pitch, stiffness, damping, damping-cutoff, static-friction, dynamic-friction,
/// roughness.
[[nodiscard]] std::span<const TouchNumber> touch_numbers() noexcept;

/// The one of this name ("static-friction"), or null.
[[nodiscard]] const TouchNumber* touch_number(std::string_view name) noexcept;

/// Moves every number into its range and dynamic friction to at most static friction.
void keep_in_range(TouchParameters& parameters);

}  // namespace dibhr
