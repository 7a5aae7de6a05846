// A colour picture as plain data.
#pragma once

#include <cstdint>
#include <vector>

namespace dibhr {

/// Colour picture, rows x columns, row-major, 3 bytes a pixel: red, green, blue.
struct ColourImage {
    int columns{0};
    int rows{0};
    std::vector<std::uint8_t> rgb{};
};

}  // namespace dibhr
