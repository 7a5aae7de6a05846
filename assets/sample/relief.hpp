// The depth of a scene: rays marched along z, whole pictures from coarse to fine.
#pragma once

#include <vector>

#include "assets/sample/scene.hpp"

namespace dibhr::sample {

/// A depth picture, row by row from the top; `level` is exact, not rounded [0..255].
struct Relief {
    int columns{};
    int rows{};
    std::vector<float> level{};
    std::vector<Part> part{};

    [[nodiscard]] std::size_t at(int column, int row) const noexcept {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
};

/// The middle of a pixel (or a place between) in the world's x and y.
[[nodiscard]] inline Vec2 place_of(float column, float row) noexcept {
    return {column - 0.5F * static_cast<float>(kColumns - 1),
            0.5F * static_cast<float>(kRows - 1) - row};
}

struct Hit {
    float level{};
    Part part{Part::Wall};
};

/// What a ray along z meets at this place when it starts at `from_level`.
[[nodiscard]] Hit cast(const Scene& scene, Vec2 place, float from_level, Parts parts) noexcept;

/// All of a scene, kColumns x kRows.
[[nodiscard]] Relief march(const Scene& scene);

}  // namespace dibhr::sample
