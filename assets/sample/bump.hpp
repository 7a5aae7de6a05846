// Bump maps that tile without a seam: a linen weave and a fine grain.
#pragma once

#include <cstdint>
#include <vector>

namespace dibhr::sample {

inline constexpr int kBumpSide = 128;  ///< columns and rows

/// Over and under of warp and weft with uneven threads; kBumpSide squared, row by row.
[[nodiscard]] std::vector<std::uint8_t> linen();
/// Round grains of many sizes, like fine sandpaper.
[[nodiscard]] std::vector<std::uint8_t> grain();

}  // namespace dibhr::sample
