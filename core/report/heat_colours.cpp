// The colours of a heat map.
#include "core/report/heat_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace dibhr {

namespace {

// ColorBrewer 2.0 (Brewer and Harrower), "YlOrRd", nine classes: marked there as safe for
// colour-blind readers; without the palest, which is lost on paper.
constexpr std::array kStops{Ink{255, 237, 160}, Ink{254, 217, 118}, Ink{254, 178, 76},
                            Ink{253, 141, 60},  Ink{252, 78, 42},   Ink{227, 26, 28},
                            Ink{189, 0, 38},    Ink{128, 0, 38}};

std::uint8_t between(std::uint8_t from, std::uint8_t to, double share) {
    return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
}

}  // namespace

Ink heat_ink(double share) {
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(kStops.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const double part = at - static_cast<double>(first);
    const Ink from = kStops[first];
    const Ink to = kStops[first + 1];
    return {between(from.red, to.red, part), between(from.green, to.green, part),
            between(from.blue, to.blue, part)};
}

}  // namespace dibhr
