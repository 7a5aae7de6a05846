// What people tune while they touch; plain data, handed over whole to the next tick.
#pragma once

#include "core/haptics/algorithm.hpp"

namespace dibhr {

/// The Falcon's 4 inches over the 720 columns of the paper's videos [mm].
inline constexpr double kPaperPitch_mm = 101.6 / 720.0;

/// How depth becomes elevation: relief * depth + roughness * bump, pixels.
struct SurfaceShape {
    double relief_px{
        255.0};  ///< elevation of depth 1.0; so a grey level is a pixel, as in the paper
    double roughness_px{0.0};  ///< elevation of bump height 1.0

    bool operator==(const SurfaceShape&) const = default;
};

/// Coulomb friction; static_coefficient >= dynamic_coefficient >= 0.
struct Friction {
    double static_coefficient{0.4};   ///< while the contact sticks
    double dynamic_coefficient{0.4};  ///< once it slips

    bool operator==(const Friction&) const = default;
};

/// The spring and damper between proxy and goal, and the size of a pixel under the hand.
struct Coupling {
    double stiffness_newton_per_mm{0.5};
    double damping_newton_s_per_m{0.0};
    double damping_cutoff_hz{0.0};  ///< of the low-pass on the velocity that is damped; 0: none
    double pixel_pitch_mm{kPaperPitch_mm};

    bool operator==(const Coupling&) const = default;
};

struct TouchParameters {
    Algorithm algorithm{Algorithm::dibhr};
    SurfaceShape shape{};
    Friction friction{};
    Coupling coupling{};

    bool operator==(const TouchParameters&) const = default;
};

}  // namespace dibhr
