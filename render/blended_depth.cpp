// The drawn surface between two depth images.
#include "render/blended_depth.hpp"

namespace dibhr {

void drawn_elevations(const BlendedDepth& depth, const ReliefGrid& grid,
                      std::vector<float>& elevations) {
    const PixelElevation elevation(depth);
    elevations.resize(static_cast<std::size_t>(grid.columns()) *
                      static_cast<std::size_t>(grid.rows()));
    float* next = elevations.data();
    const auto step = static_cast<std::size_t>(grid.step);
    const auto columns = static_cast<std::size_t>(grid.columns());
    for (int j = 0; j < grid.rows(); ++j) {
        const std::size_t row = depth.from.index(0, grid.image_j(j));
        for (std::size_t i = 0; i + 1 < columns; ++i) *next++ = elevation(row + i * step);
        *next++ = elevation(row + static_cast<std::size_t>(grid.image_columns - 1));
    }
}

}  // namespace dibhr
