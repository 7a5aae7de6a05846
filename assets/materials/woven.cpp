// The materials of yarn: linen and wool.
#include "assets/materials/textures.hpp"

namespace dibhr::materials {
namespace {

/// The round back of a thread, by how far from its middle: 1 there, 0 at 0.5.
double arch(double off) noexcept {
    return 1.0 - 4.0 * off * off;
}

/// Height of one leg of a stitch: a thick yarn that dives at both ends. `from` its middle, in units
/// of a stitch; it leans to the right with `side` 1, to the left with -1.
double leg(Place from, double side) noexcept {
    constexpr double kLean = 0.34, kLength = 0.86, kThickness = 0.295;
    const Place upright{from.x * side, -from.y};
    const double bent = upright.x - kLean * upright.y + 0.10 * upright.y * upright.y;
    const double across = bent / kThickness, along = upright.y / kLength;
    const double inside = std::max(1.0 - across * across, 0.0) * std::max(1.0 - along * along, 0.0);
    // Two plies, twisted: fine grooves across the yarn.
    const double twist = wave(2.6 * upright.y - 0.85 * across);
    return inside * (1.7 - 0.7 * inside) + 0.05 * inside * twist;
}

}  // namespace

double linen_at(Place at) noexcept {
    constexpr int kThreads = 32;
    const Place p = at * static_cast<double>(kThreads);
    const int warp = static_cast<int>(p.x), weft = static_cast<int>(p.y);
    const double across = off_middle(p.x), down = off_middle(p.y);
    const auto thickness = [&](int thread, double x, double y, int seed) {
        const double even = 0.85 + 0.20 * chance(thread, 0, kThreads, 1, seed);
        return even + 0.16 * noise({x, y}, kThreads, 4, seed);  // thick and thin as it was spun
    };
    // Two tabby phases: where one thread lies over, the other dives under.
    const double over = (warp + weft) % 2 == 0 ? 0.35 : -0.35;
    const double warp_height =
        arch(across) * thickness(warp, (warp + 0.5) / kThreads, at.y, 77) + over * arch(down);
    const double weft_height =
        arch(down) * thickness(weft, (weft + 0.5) / kThreads, at.x, 79) - over * arch(across);
    return larger(warp_height, weft_height, 0.15);
}

double wool_at(Place at) noexcept {
    constexpr int kWales = 8, kCourses = 10;
    const Place p = warped(at, 0.006, 8, 10, 11) * Place{kWales, kCourses};
    const int wale = static_cast<int>(std::floor(p.x)), course = static_cast<int>(std::floor(p.y));
    double height = 0.0;
    for (int j = course - 1; j <= course + 1; ++j)
        for (int i = wale - 1; i <= wale + 1; ++i) {
            const double thick = 0.92 + 0.16 * chance(i, j, kWales, kCourses, 21);
            for (const double side : {-1.0, 1.0}) {
                const Place middle{i + 0.5 + 0.25 * side, j + 0.5};
                height = larger(height, thick * leg(p - middle, side), 0.08);
            }
        }
    return height + 0.05 * rough_noise(at, 40, 40, 2, 0.6, 31);  // fuzz
}

}  // namespace dibhr::materials
