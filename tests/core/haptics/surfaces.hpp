// Surfaces the haptics tests walk on, from plain to hostile, and a deterministic dice.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr::test {

/// xorshift64*: the same numbers on every machine.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed * 2654435769U + 88172645463325252U) {}
    double uniform(double low, double high) {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        const auto bits = (state_ * 2685821657736338717U) >> 11;
        return low + (high - low) * (static_cast<double>(bits) * 0x1p-53);
    }

  private:
    std::uint64_t state_;
};

using dibhr::image_of;

inline DepthImage flat(int columns, int rows, double level) {
    return image_of(columns, rows, 255.0, [&](int, int) { return level; });
}

/// 16-bit levels a*i + b*j + c; with relief = 65535 / 100 an elevation is level / 100 px.
inline DepthImage tilted(int columns, int rows, double a, double b, double c) {
    return image_of(columns, rows, 65535.0, [&](int i, int j) { return a * i + b * j + c; });
}

struct NamedSurface {
    std::string name;
    DepthImage image;
};

inline std::vector<NamedSurface> hostile_surfaces(int columns, int rows) {
    Dice dice(7);
    std::vector<NamedSurface> all;
    const auto add = [&](const char* name, auto level) {
        all.push_back({name, image_of(columns, rows, 255.0, level)});
    };
    add("flat", [](int, int) { return 100.0; });
    add("random", [&](int, int) { return std::floor(dice.uniform(0.0, 256.0)); });
    add("gently random", [&](int, int) { return 100.0 + dice.uniform(0.0, 2.0); });
    add("spiked", [&](int, int) { return dice.uniform(0.0, 1.0) < 0.03 ? 255.0 : 40.0; });
    add("pitted", [&](int, int) { return dice.uniform(0.0, 1.0) < 0.03 ? 0.0 : 120.0; });
    add("checkerboard", [](int i, int j) { return (i + j) % 2 == 0 ? 30.0 : 200.0; });
    add("cliffs", [](int i, int j) { return (i / 9 + j / 7) % 2 == 0 ? 10.0 : 240.0; });
    add("hill", [&](int i, int j) {
        const double x = (i - 0.5 * columns) / (0.25 * columns);
        const double y = (j - 0.5 * rows) / (0.25 * rows);
        return 30.0 + 150.0 * std::exp(-x * x - y * y) +
               3.0 * std::sin(i * 0.7) * std::sin(j * 0.5);
    });
    return all;
}

}  // namespace dibhr::test
