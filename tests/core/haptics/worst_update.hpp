// Searches the update that reads most: on a surface, by an algorithm, from any place to any other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"

namespace dibhr::test {

/// One of twenty surfaces by its number: slopes under noise of all strengths, waves, terraces,
/// needles and pits.
inline DepthImage generated_surface(int number, int columns, int rows) {
    Dice dice(900 + static_cast<std::uint64_t>(number));
    const double noise = 0.004 * std::pow(2.0, number % 10);
    const double slope = dice.uniform(-0.08, 0.08);
    const double length_px = dice.uniform(3.0, 60.0);
    const double wave = dice.uniform(0.0, 40.0);
    const double step = number < 10 ? 0.0 : dice.uniform(1.0, 30.0);
    const double spiked = number % 4 == 3 ? 0.03 : 0.0;
    return image_of(columns, rows, 255.0, [&](int i, int j) {
        double level = 128.0 + slope * i + wave * std::sin(i / length_px) * std::cos(j / length_px);
        if (step > 0.0) level = std::floor(level / step) * step;
        level += noise * dice.uniform(-1.0, 1.0);
        if (dice.uniform(0.0, 1.0) < spiked) level = dice.uniform(0.0, 255.0);
        return std::clamp(level, 0.0, 255.0);
    });
}

/// A proxy is pressed onto the surface at one place, and its goal then jumps to another.
struct Jump {
    Vec3 from{0.0};
    Vec3 to{0.0};
    Friction friction{};

    void press(ProxyAlgorithm& algorithm, const DepthSurface& surface) const {
        algorithm.reset();
        static_cast<void>(algorithm.update(surface, {from.x, from.y, 300.0}, friction));
        static_cast<void>(algorithm.update(surface, from, friction));
    }

    /// The update of the jump.
    [[nodiscard]] Proxy made(ProxyAlgorithm& algorithm, const DepthSurface& surface) const {
        press(algorithm, surface);
        return algorithm.update(surface, to, friction);
    }
};

/// Of `tries` jumps the one that reads most, or else moves most: at random first, then ever nearer
/// to the worst.
inline Jump worst_jump(ProxyAlgorithm& algorithm, const DepthSurface& surface, Dice& dice,
                       int tries) {
    const auto place = [&](double depth) {
        const double y = dice.uniform(0.0, surface.rows() - 1.0);
        const double x = dice.uniform(0.0, surface.columns() - 1.0);
        return Vec3(x, y, depth);
    };
    Jump worst{};
    std::tuple<int, int> most{-1, -1};
    for (int n = 0; n < tries; ++n) {
        const double mu = n % 3 == 0 ? dice.uniform(0.0, 0.5) : dice.uniform(1.0, 1.5);
        Jump jump{place(dice.uniform(-50.0, 128.0)),
                  place(dice.uniform(-400.0, 128.0)),
                  {mu, dice.uniform(0.5, 1.0) * mu}};
        if (n > tries / 2) {
            const double near = 0.2 * (tries - n) / tries;
            jump = {worst.from + near * (jump.from - worst.from),
                    worst.to + near * (jump.to - worst.to),
                    n % 2 == 0 ? worst.friction : jump.friction};
        }
        const Proxy proxy = jump.made(algorithm, surface);
        const std::tuple<int, int> read{proxy.reads, proxy.moves};
        if (read > most) {
            most = read;
            worst = jump;
        }
    }
    return worst;
}

}  // namespace dibhr::test
