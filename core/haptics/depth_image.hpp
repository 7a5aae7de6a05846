// One depth image in its source's own levels, and a bump map: the data of a surface.
#pragma once

#include <cstddef>
#include <vector>

namespace dibhr {

/// Depth levels, rows x columns, row-major; brighter = nearer to the camera = higher.
/// A float holds 16 bits exactly, so nothing of the source is lost. At least 2 x 2 when touched.
struct DepthImage {
    int columns{0};
    int rows{0};
    /// The level of depth 1.0: 255 for 8-bit, 65535 for 16-bit sources.
    double highest_level{255.0};
    std::vector<float> levels{};

    [[nodiscard]] float& at(int i, int j) { return levels[index(i, j)]; }
    [[nodiscard]] float at(int i, int j) const { return levels[index(i, j)]; }
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(i);
    }
};

/// The image whose level at column i and row j is `level(i, j)`.
template <typename Level>
[[nodiscard]] DepthImage image_of(int columns, int rows, double highest_level, Level&& level) {
    DepthImage image{columns, rows, highest_level, {}};
    image.levels.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) image.at(i, j) = static_cast<float>(level(i, j));
    }
    return image;
}

/// Fine relief laid over the depth image, once or again and again: rows x columns, row-major,
/// heights in [0, 1].
struct BumpMap {
    int columns{0};
    int rows{0};
    std::vector<float> heights{};

    /// The heights at every VERTEX of a depth image of columns x rows, row-major, where the map is
    /// `size_px` wide. Computed by `stretch` (surface.hpp).
    struct AtVertices {
        int columns{0};
        int rows{0};
        double size_px{0.0};
        std::vector<double> heights{};
    };
    AtVertices at_vertices{};
};

}  // namespace dibhr
