// One finished frame of the sample: exact depth and the colour that goes with it.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/sample/pose.hpp"

namespace dibhr::sample {

/// kColumns x kRows, rows from the top.
struct Picture {
    std::vector<float> level{};       ///< exact depth 0..255, nearer is higher
    std::vector<std::uint8_t> bgr{};  ///< three bytes a pixel, sRGB
};

/// The same numbers on every run: no clock, no chance, no threads.
[[nodiscard]] Picture picture_of(int frame);

/// Depth rounded to 8 bits.
[[nodiscard]] std::vector<std::uint8_t> rounded(const std::vector<float>& level);

}  // namespace dibhr::sample
