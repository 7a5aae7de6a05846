// The hard materials: ice, rubber, sandpaper and stone.
#include <array>

#include "assets/materials/textures.hpp"

namespace dibhr::materials {
namespace {

/// A nearly straight scratch that repeats `across` times to the right and `down` times down the
/// map.
struct Scratch {
    int across{}, down{};
    double offset{};  ///< 0..1
    double depth{};
};

/// How far below the ice a scratch lies here: a groove with a fine raised edge.
double scratched(Place at, const Scratch& scratch, int seed) noexcept {
    const Place normal{scratch.across, scratch.down};
    const double phase = glm::dot(normal, at) + scratch.offset + 0.13 * noise(at, 2, 2, seed);
    const double from = off_middle(phase) / glm::length(normal);
    const double there = rise(-0.25, 0.2, noise(at, 3, 3, seed + 2));
    return scratch.depth * there * (bump(from, 0.014) - 0.2 * bump(std::abs(from) - 0.016, 0.009));
}

/// One sharp grain, `from` its middle: a pyramid of random faces, cut off aslant. `dice(k)` is
/// 0..1.
template <typename Dice>
double grain(Place from, Dice&& dice) noexcept {
    constexpr std::array<Place, 5> kSides{
        {{1.0, 0.1}, {0.25, 0.95}, {-0.8, 0.6}, {-0.75, -0.65}, {0.4, -0.9}}};
    const double top = 0.35 + 0.65 * dice(2);
    double height = 0.75 * top + 0.5 * glm::dot(Place{dice(3) - 0.5, dice(4) - 0.5}, from);
    int k = 5;
    for (const Place& side : kSides) {
        const Place lean{0.7 * (dice(k) - 0.5), 0.7 * (dice(k + 5) - 0.5)};
        const double steep = 1.4 + 0.8 * dice(k + 10);
        height = std::min(height, top - steep * glm::dot(from, side + lean));
        ++k;
    }
    return height;
}

/// Grains, one in each cell of a lattice of `across` squared.
double grains(Place at, int across, int seed) noexcept {
    const Place p = at * static_cast<double>(across);
    double height = 0.0;
    each_near(p, [&](int i, int j) {
        const auto dice = [&](int k) { return chance(i, j, across, across, seed + k); };
        const Place from = p - Place{i + 1.4 * dice(0) - 0.2, j + 1.4 * dice(1) - 0.2};
        height = std::max(height, grain(from, dice));
    });
    return height;
}

/// Hewn: every cell a low hill that leans its own way.
double hewn(Place at, int across, int seed) noexcept {
    const Place p = at * static_cast<double>(across);
    double height = -9.0;
    each_near(p, [&](int i, int j) {
        const auto dice = [&](int k) { return chance(i, j, across, across, seed + k) - 0.5; };
        const Place from = p - Place{i + 0.5 + 1.3 * dice(0), j + 0.5 + 1.3 * dice(1)};
        const double lean = glm::dot(Place{dice(3), dice(4)}, from);
        height = larger(height, 0.55 * dice(2) + lean - 0.5 * glm::dot(from, from), 0.03);
    });
    return height;
}

/// Round pits of about half a cell, in some of the cells.
double pits(Place at, int across, double share, int seed) noexcept {
    const Cell cell = cell_at(at, across, across, 0.35, seed);
    if (chance(cell.i, cell.j, across, across, seed + 2) >= share) return 0.0;
    const double width = (0.22 + 0.22 * chance(cell.i, cell.j, across, across, seed + 3)) / across;
    return (width * across / 0.44) * bump(glm::length(cell.from_centre), width);
}

}  // namespace

double ice_at(Place at) noexcept {
    constexpr std::array<Scratch, 5> kScratches{{{1, 2, 0.1, 0.9},
                                                 {2, -1, 0.45, 1.0},
                                                 {-1, 1, 0.8, 0.8},
                                                 {3, 1, 0.3, 0.6},
                                                 {1, -3, 0.65, 0.6}}};
    double height = 1.3 * rough_noise(warped(at, 0.05, 2, 2, 401), 3, 3, 2, 0.35, 411);
    int seed = 421;
    for (const Scratch& scratch : kScratches) {
        height -= 0.65 * scratched(at, scratch, seed);
        seed += 10;
    }
    return height;
}

double rubber_at(Place at) noexcept {
    constexpr int kRows = 16;
    const double side =
        2.0 * std::max(std::abs(off_middle(kRows * at.x)), std::abs(off_middle(kRows * at.y)));
    return larger(0.0, std::min(1.0, 1.9 * (0.86 - side)), 0.1);
}

double sandpaper_at(Place at) noexcept {
    const Place p = warped(at, 0.003, 30, 30, 501);
    const double glue = 0.12 * rough_noise(at, 14, 14, 2, 0.5, 571);
    return std::max({0.1 + glue, grains(p, 20, 511), 0.7 * grains(p, 33, 541)}) + 0.05 * glue;
}

double stone_at(Place at) noexcept {
    const Place p = warped(warped(at, 0.03, 4, 4, 601), 0.004, 13, 13, 605);
    const double faces =
        larger(hewn(p, 7, 650), -0.30, 0.15);  // no holes that would mark the repeats
    return faces + 0.19 * rough_noise(p + Place{0.05, 0.06}, 9, 9, 4, 0.62, 621) -
           0.42 * pits(p, 14, 0.4, 661) - 0.24 * pits(p, 31, 0.35, 671);
}

}  // namespace dibhr::materials
