// The maps of the materials: fine relief that tiles without a seam.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dibhr::materials {

inline constexpr int kSide = 256;  ///< columns and rows of a map

/// The names of all materials, each that of its files.
[[nodiscard]] std::vector<std::string> names();

/// Heights of one material, kSide squared, row by row, from 0 to 255: the same on every machine, as
/// they come of sums, products and roots of doubles alone. `name` is one of names(); InputError
/// otherwise.
[[nodiscard]] std::vector<std::uint8_t> map_of(const std::string& name);

}  // namespace dibhr::materials
