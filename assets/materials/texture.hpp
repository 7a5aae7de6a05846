// Waves, noise and cells that repeat over a map; none calls a function whose last bit depends on
// the machine.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "assets/sample/sdf.hpp"

namespace dibhr::materials {

/// A place in the map: 0..1 to the right and down, beyond which all repeats.
using Place = glm::dvec2;

/// A repeatable number in 0..1 for a cell of a lattice of `across` x `down`, which repeats.
inline double chance(int i, int j, int across, int down, int seed) noexcept {
    const auto wrapped = [](int cell, int cells) { return (cell % cells + cells) % cells; };
    return static_cast<double>(
        sample::lattice(wrapped(i, across) + 1021 * seed, wrapped(j, down) + 577 * seed));
}

/// 0 below `from`, 1 above `to`, smooth between.
inline double rise(double from, double to, double x) noexcept {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// A round hill: 1 at 0, 0 from `width` on.
inline double bump(double x, double width) noexcept {
    const double t = std::max(1.0 - x * x / (width * width), 0.0);
    return t * t;
}

/// The larger of two, rounded where they differ by less than `k`.
inline double larger(double a, double b, double k) noexcept {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::max(a, b) + h * h * k * 0.25;
}

/// How far x is from the middle of its unit: -0.5..0.5.
inline double off_middle(double x) noexcept {
    return x - std::floor(x) - 0.5;
}

/// A wave of period 1 and nearly a cosine: 1 at 0, -1 at 0.5.
inline double wave(double x) noexcept {
    return 2.0 * rise(0.0, 0.5, std::abs(off_middle(x))) - 1.0;
}

/// Smooth noise, mostly in -0.7..0.7, with `across` x `down` features in the map.
inline double noise(Place at, int across, int down, int seed) noexcept {
    const double x = at.x * across, y = at.y * down;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double fx = x - i, fy = y - j;
    const auto corner = [&](int di, int dj) {
        const double right = 2.0 * chance(i + di, j + dj, across, down, seed) - 1.0;
        const double downward = 2.0 * chance(i + di, j + dj, across, down, seed + 1) - 1.0;
        return 1.6 * (right * (fx - di) + downward * (fy - dj));
    };
    const auto ease = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
    const double high = corner(0, 0) + ease(fx) * (corner(1, 0) - corner(0, 0));
    const double low = corner(0, 1) + ease(fx) * (corner(1, 1) - corner(0, 1));
    return high + ease(fy) * (low - high);
}

/// Noise with finer and finer noise on it, each octave `fall` times as high as the one before.
inline double rough_noise(Place at, int across, int down, int octaves, double fall,
                          int seed) noexcept {
    double sum = 0.0, height = 1.0;
    for (int octave = 0; octave < octaves; ++octave) {
        const Place apart{0.31 * octave,
                          0.17 * octave};  // else all lattices would have corners in common
        sum += height * noise(at + apart, across << octave, down << octave, seed + 2 * octave);
        height *= fall;
    }
    return sum;
}

/// `at`, moved by up to about `by` by noise of `across` x `down` features.
inline Place warped(Place at, double by, int across, int down, int seed) noexcept {
    return at + by * Place{noise(at, across, down, seed), noise(at, across, down, seed + 2)};
}

/// Calls `visit(i, j)` for every cell of a lattice that is at most two away from that of `p`, in
/// cells.
template <typename Visit>
void each_near(Place p, Visit&& visit) {
    const int i = static_cast<int>(std::floor(p.x)), j = static_cast<int>(std::floor(p.y));
    for (int v = j - 2; v <= j + 2; ++v)
        for (int u = i - 2; u <= i + 2; ++u) visit(u, v);
}

/// The position of a place among the irregular cells of a lattice.
struct Cell {
    Place from_centre{};  ///< in units of the map
    double to_border{};   ///< likewise
    int i{}, j{};         ///< which cell of the lattice
};

/// The cell of a lattice of `across` x `down` whose centre, off the middle by up to `jitter` of the
/// cell, is nearest.
inline Cell cell_at(Place at, int across, int down, double jitter, int seed) noexcept {
    const Place cells{across, down};
    const Place p = at * cells;
    const auto towards = [&](int u, int v) {
        const Place off{chance(u, v, across, down, seed) - 0.5,
                        chance(u, v, across, down, seed + 1) - 0.5};
        return Place{u + 0.5, v + 0.5} + 2.0 * jitter * off - p;
    };
    Cell cell;
    Place nearest{9.0};
    each_near(p, [&](int u, int v) {
        const Place to = towards(u, v);
        if (glm::dot(to, to) >= glm::dot(nearest, nearest)) return;
        nearest = to;
        cell.i = u;
        cell.j = v;
    });
    cell.from_centre = -nearest / cells;
    cell.to_border = 9.0;
    each_near(Place{cell.i, cell.j}, [&](int u, int v) {
        if (u == cell.i && v == cell.j) return;
        const Place to = towards(u, v);
        const Place between = to - nearest;
        const double gone = 0.5 * glm::dot(nearest + to, between);
        cell.to_border = std::min(cell.to_border, gone / glm::length(between * cells));
    });
    return cell;
}

}  // namespace dibhr::materials
