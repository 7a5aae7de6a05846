// What people tune while they touch: plain data, handed over whole to the next tick, and the one
// table of it, which drives the command line, the settings file, the panels, the session file,
// every report, studies, dibhr.h and Python. A new number, switch or choice is a member of
// TouchParameters, an entry in that table, and the place that uses it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/haptics/enum_names.hpp"

namespace dibhr {

/// How the proxy follows the goal; see dibhr.hpp, pga.hpp, neighborhood.hpp, god_object.hpp.
enum class Algorithm { dibhr, pga, neighborhood, god_object };

/// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const Algorithm> all_algorithms() noexcept;
/// The algorithms with their names: named<Algorithm>() finds one by its name.
[[nodiscard]] std::span<const NamedValue<Algorithm>> name_table(Algorithm) noexcept;

/// "dibhr", "pga", "neighborhood" or "god-object": what `--algorithm` takes.
[[nodiscard]] const char* name_of(Algorithm algorithm) noexcept;

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

/// The spring and damper between proxy and goal, the size of a pixel under the hand, and the force
/// where there are no data.
struct Coupling {
    double stiffness_newton_per_mm{0.5};
    double damping_newton_s_per_m{0.0};
    double damping_cutoff_hz{0.0};  ///< of the low-pass on the velocity that is damped; 0: none
    double pixel_pitch_mm{kPaperPitch_mm};
    /// Share of the force where no surface was ever seen: 1: a wall at the back like any other, 0:
    /// no force.
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

/// Which parameters stand together on a panel.
enum class TouchTopic { algorithm, shape, spring, damper, friction, texture };

/// One number people tune. Its default is what TouchParameters{} holds, as that of a TouchSwitch
/// and of a TouchChoice.
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

/// One thing people turn on and off. Name, label and column are as those of a TouchNumber.
struct TouchSwitch {
    std::string_view name;
    std::string_view label;
    std::string_view column;
    TouchTopic topic;
    std::string_view help;  ///< what it does while it is on
    bool& (*in)(TouchParameters&);
    bool needs_motion{false};  ///< has no effect where the video's motion is not known

    [[nodiscard]] bool of(TouchParameters parameters) const { return in(parameters); }
    [[nodiscard]] bool standard() const { return of({}); }
};

/// Where a TouchChoice is held: a pointer for each enumeration in TouchParameters, all of which
/// have name_table().
using TouchChoiceTarget = std::variant<Algorithm*>;

/// A choice between several names. Name, label and column are as those of a TouchNumber.
struct TouchChoice {
    std::string_view name;
    std::string_view label;
    std::string_view column;
    std::string_view noun;  ///< "an algorithm": what one of the names stands for
    TouchTopic topic;
    std::string_view help;  ///< without the names
    TouchChoiceTarget (*in)(TouchParameters&);
    bool in_every_session{false};  ///< a session file without its column is damaged

    [[nodiscard]] std::string_view of(TouchParameters parameters) const;
    [[nodiscard]] std::string_view standard() const { return of({}); }
    /// False: `word` is none of the names; the parameters stay as they were.
    [[nodiscard]] bool choose(std::string_view word, TouchParameters& parameters) const;
    [[nodiscard]] std::vector<std::string> names() const;
};

/// In the order of a session file's columns, where a new one goes to the end.
[[nodiscard]] std::span<const TouchNumber> touch_numbers() noexcept;
/// Likewise.
[[nodiscard]] std::span<const TouchSwitch> touch_switches() noexcept;
[[nodiscard]] std::span<const TouchChoice> touch_choices() noexcept;

/// The whole table: visit(entry) with each TouchChoice, each TouchNumber and each TouchSwitch.
template <typename Visit>
void visit_touch_entries(const Visit& visit) {
    for (const TouchChoice& choice : touch_choices()) visit(choice);
    for (const TouchNumber& number : touch_numbers()) visit(number);
    for (const TouchSwitch& entry : touch_switches()) visit(entry);
}

/// The one of this name ("static-friction"), or null.
[[nodiscard]] const TouchNumber* touch_number(std::string_view name) noexcept;

/// The entry of `member`, a double in `parameters`: number_of(p.friction.static_coefficient, p).
/// Every double in TouchParameters has an entry; for another double the first one is returned.
[[nodiscard]] const TouchNumber& number_of(const double& member, TouchParameters& parameters);

/// A number, or a switch as one (0: off, 1: on), for interfaces that take numbers alone and know no
/// motion of a video: dibhr.h and Python.
struct PlainNumber {
    std::string_view name;
    std::string_view label;
    std::string_view unit;
    std::string_view help;
    double lowest;
    double highest;
    const TouchNumber* number;
    const TouchSwitch* on_off;  ///< where it is no number

    [[nodiscard]] double of(const TouchParameters& parameters) const;
    /// A switch is on unless `value` is 0.
    void put(double value, TouchParameters& parameters) const;
};

/// The numbers, then the switches that need no motion.
[[nodiscard]] std::span<const PlainNumber> plain_numbers() noexcept;

/// Moves every number into its range and dynamic friction to at most static friction.
void keep_in_range(TouchParameters& parameters);

}  // namespace dibhr
