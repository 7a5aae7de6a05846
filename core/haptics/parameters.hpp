// What people tune while they touch: plain data, handed over whole to the next tick, and the one
// table of its numbers, which drives the command line, the settings file, the panels, the session
// file and every report. A new number is a member of TouchParameters, an entry in that table, and
// the place that uses it.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/haptics/words.hpp"

namespace dibhr {

/// How the proxy follows the goal; see dibhr.hpp, pga.hpp, neighborhood.hpp, god_object.hpp.
enum class Algorithm { dibhr, pga, neighborhood, god_object };

/// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const Algorithm> all_algorithms() noexcept;
/// The same with what they are called.
[[nodiscard]] std::span<const Word<Algorithm>> algorithm_words() noexcept;

/// "dibhr", "pga", "neighborhood" or "god-object": what `--algorithm` takes.
[[nodiscard]] const char* name_of(Algorithm algorithm) noexcept;

/// The algorithm of this name, or nothing.
[[nodiscard]] std::optional<Algorithm> algorithm_named(std::string_view name) noexcept;

/// The Falcon's 4 inches over the 720 columns of the paper's videos [mm].
inline constexpr double kPaperPitch_mm = 101.6 / 720.0;

/// How depth becomes elevation: relief * depth + roughness * bump, pixels.
struct SurfaceShape {
    double relief_px{255.0};   ///< of depth 1.0; so a grey level is a pixel, as in the paper
    double roughness_px{0.0};  ///< of bump height 1.0
    double bump_size_px{0.0};  ///< width of the bump map, which repeats; 0: of the whole surface

    bool operator==(const SurfaceShape&) const = default;
};

/// Coulomb friction; static_coefficient >= dynamic_coefficient >= 0.
struct Friction {
    double static_coefficient{0.4};   ///< while the contact sticks
    double dynamic_coefficient{0.4};  ///< once it slips

    bool operator==(const Friction&) const = default;
};

/// The spring and damper between proxy and goal, the size of a pixel under the hand, and what is
/// felt of no data.
struct Coupling {
    double stiffness_newton_per_mm{0.5};
    double damping_newton_s_per_m{0.0};
    double damping_cutoff_hz{0.0};  ///< of the low-pass on the velocity that is damped; 0: none
    double pixel_pitch_mm{kPaperPitch_mm};
    /// Of the force, where no surface was ever seen: 1: a wall at the back as any other, 0:
    /// nothing.
    double unseen_share{1.0};

    bool operator==(const Coupling&) const = default;
};

struct TouchParameters {
    Algorithm algorithm{Algorithm::dibhr};
    SurfaceShape shape{};
    Friction friction{};
    Coupling coupling{};
    /// A proxy is carried along by what it touches (README.md, Carried by what moves).
    bool carry{false};

    bool operator==(const TouchParameters&) const = default;
};

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

/// In the order of a session file's columns, where a new one goes to the end.
[[nodiscard]] std::span<const TouchNumber> touch_numbers() noexcept;

/// The one of this name ("static-friction"), or null.
[[nodiscard]] const TouchNumber* touch_number(std::string_view name) noexcept;

/// The one whose number is `member` of these parameters: number_of(p.friction.static_coefficient,
/// p). There is one for every double in TouchParameters; else the first is given back.
[[nodiscard]] const TouchNumber& number_of(const double& member, TouchParameters& parameters);

/// Moves every number into its range and dynamic friction to at most static friction.
void keep_in_range(TouchParameters& parameters);

}  // namespace dibhr
