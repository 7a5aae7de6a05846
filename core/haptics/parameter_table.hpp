// The one table of the numbers people tune: it drives the command line, the settings file, the
// panels, the session file and every report. A new number is a member of TouchParameters, an entry
// here, and the place that uses it.
#pragma once

#include <span>
#include <string_view>

#include "core/haptics/parameters.hpp"

namespace dibhr {

/// Which numbers stand together on a panel.
enum class TouchTopic { shape, spring, damper, friction, texture };

/// One number people tune. Its default is what TouchParameters{} holds.
struct TouchNumber {
    /// "static-friction": the option is --static-friction, the setting static-friction.
    std::string_view name;
    std::string_view label;   ///< "Static friction", for the panel
    std::string_view column;  ///< "static_friction": in a session file and in JSON, with its unit
    std::string_view unit;    ///< "N/mm"; empty for a ratio
    TouchTopic topic;
    double lowest;
    double highest;
    std::string_view help;
    double& (*in)(TouchParameters&);
    const char* zero{nullptr};  ///< what 0 is called, for the panel: "off"; null: the number

    [[nodiscard]] double of(TouchParameters parameters) const { return in(parameters); }
    [[nodiscard]] double standard() const { return of({}); }
};

/// relief, roughness, static-friction, dynamic-friction, stiffness, damping, damping-cutoff,
/// pixel-pitch: the order of a session file's columns, where a new one goes to the end.
[[nodiscard]] std::span<const TouchNumber> touch_numbers() noexcept;

/// The one of this name ("static-friction"), or null.
[[nodiscard]] const TouchNumber* touch_number(std::string_view name) noexcept;

/// The one whose number is `member` of these parameters: number_of(p.friction.static_coefficient,
/// p). There is one for every double in TouchParameters; else the first is given back.
[[nodiscard]] const TouchNumber& number_of(const double& member, TouchParameters& parameters);

/// Moves every number into its range and dynamic friction to at most static friction.
void keep_in_range(TouchParameters& parameters);

}  // namespace dibhr
