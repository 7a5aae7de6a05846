// A hand that nobody moved: strokes, tremor and pauses as the literature describes them.
#pragma once

#include <cstdint>

#include "core/experiment/hand_motion.hpp"

namespace dibhr {

/// Strokes along arcs of ellipses in the area, one after the other, with pauses between them.
/// - Each stroke starts and ends at rest with a minimum-jerk course (Flash and Hogan 1985).
/// - Along it the speed is a smooth envelope times curvature^(-1/3): the two-thirds power law
///   (Lacquaniti, Terzuolo and Viviani 1983).
/// - Physiological tremor of 8 to 12 Hz rides on it, below a tenth of a millimetre on a Falcon.
/// - It presses 6 to 20 px deep and lifts off during some of the pauses.
/// The same `seed` gives the same motion. Places are in the pixels of `area`.
[[nodiscard]] HandMotion modelled_hand(const ImageArea& area, int updates = kExperimentUpdates,
                                       std::uint64_t seed = 1);

}  // namespace dibhr
