// The drawn surface between two depth images.
#include "render/blended_depth.hpp"

namespace dibhr {

void drawn_elevations(const BlendedDepth& depth, const ReliefGrid& grid,
                      std::vector<float>& elevations) {
    const PixelElevation elevation(depth);
    elevations.resize(static_cast<std::size_t>(grid.columns()) *
                      static_cast<std::size_t>(grid.rows()));
    float* next = elevations.data();
    for (int j = 0; j < grid.rows(); ++j) {
        for (int i = 0; i < grid.columns(); ++i)
            *next++ = elevation(depth.from.index(grid.image_i(i), grid.image_j(j)));
    }
}

}  // namespace dibhr
