// The materials that grow: bark, skin and wood.
#include <array>

#include "assets/materials/textures.hpp"

namespace dibhr::materials {
namespace {

/// One set of creases: how often it crosses the map from left to right and from top to bottom.
struct Creases {
    int across{}, down{};
    double depth{};
};

/// How deep the creases of a set are here: sharp at their bottom, now deeper, now nearly gone.
double crease(Place at, const Creases& set, int seed) noexcept {
    const double phase = set.across * at.x + set.down * at.y + 0.45 * noise(at, 8, 8, seed) +
                         0.6 * noise(at, 3, 3, seed + 4);
    const double from = std::abs(off_middle(phase));
    const double strength = std::clamp(0.75 + 0.9 * noise(at, 9, 9, seed + 8), 0.15, 1.0);
    return set.depth * strength * (1.0 - rise(0.0, 0.26, from));
}

/// Bends a place irregularly, as in a trunk.
Place crooked(Place at) noexcept {
    return warped(warped(warped(at, 0.05, 3, 2, 101), 0.022, 9, 6, 105), 0.006, 26, 16, 107);
}

/// About how far the nearest furrow of a set is, in units of the map: they run where noise changes
/// its sign.
double to_furrow(Place at, int across, int down, int seed) noexcept {
    constexpr double kStep = 0.004;
    const auto level = [&](double x, double y) {
        return noise(crooked(at + Place{x, y}), across, down, seed);
    };
    const Place steepness{level(kStep, 0.0) - level(-kStep, 0.0),
                          level(0.0, kStep) - level(0.0, -kStep)};
    return std::abs(level(0.0, 0.0)) / (glm::length(steepness) / (4.0 * kStep) + 4.0);
}

}  // namespace

double bark_at(Place at) noexcept {
    const Place p = crooked(at);
    // Furrows run upright and meet; cracks across are shallower.
    const double furrow = std::min(to_furrow(at, 5, 2, 113), to_furrow(at, 4, 1, 117));
    const double ridge = 0.75 * rise(0.0, 0.036, furrow) + 0.25 * rise(0.0, 0.08, furrow);
    const Cell plate = cell_at(p, 4, 5, 0.45, 111);
    const double crack = 1.0 - rise(0.0, 0.040, plate.to_border);
    // Scales, layer on layer, that break off towards the furrows.
    const double layers = 3.5 * (0.5 + rough_noise(p, 9, 4, 3, 0.55, 121)) + 25.0 * furrow;
    const double step = std::floor(layers) + rise(0.3, 1.0, layers - std::floor(layers));
    const double scales = 0.045 * std::clamp(step, 0.0, 8.0);
    return ridge * (0.75 + scales - 0.28 * crack) + 0.05 * rough_noise(at, 24, 12, 3, 0.6, 151);
}

double skin_at(Place at) noexcept {
    constexpr std::array<Creases, 4> kSets{
        {{13, -3, 1.0}, {6, 11, 0.9}, {-10, 8, 0.6}, {2, 19, 0.4}}};
    const Place p = warped(at, 0.010, 7, 7, 201);
    double deepest = 0.0, sum = 0.0;
    int seed = 211;
    for (const Creases& set : kSets) {
        const double depth = crease(p, set, seed);
        deepest = larger(deepest, depth, 0.1);
        sum += depth;
        seed += 20;
    }
    return -0.75 * deepest - 0.25 * sum + 0.22 * noise(at, 5, 5, 291) +
           0.05 * noise(at, 70, 70, 293);
}

double wood_at(Place at) noexcept {
    // Year rings, cut along: lines of equal height of a long, low hill.
    const double bent =
        1.5 * noise(at, 1, 2, 301) + 0.6 * noise(at, 2, 5, 303) + 0.05 * noise(at, 5, 20, 305);
    const double ring = 15.0 * at.y + 1.25 * bent;
    const double year = ring - std::floor(ring);
    const double late =
        rise(0.0, 0.78, year) * (1.0 - rise(0.88, 1.0, year));  // the hard wood stays
    const Place along{at.x, at.y + 0.2 * bent / 15.0};
    const double fibres = rough_noise(along, 3, 60, 2, 0.7, 311);
    const Cell pore = cell_at(along, 7, 44, 0.42, 321);
    const bool open = chance(pore.i, pore.j, 7, 44, 331) < 0.55;
    const double length = 0.02 + 0.045 * chance(pore.i, pore.j, 7, 44, 332);
    const double pit =
        open ? bump(glm::length(pore.from_centre / Place{length, 0.0095}), 1.0) : 0.0;
    return 0.75 * late + 0.42 * fibres - 0.85 * pit;
}

}  // namespace dibhr::materials
