// Closes small holes of a depth image from the levels around them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// A hole is a patch of pixels of level 0, joined over edges and corners. One that is no wider and
/// no higher than a twentieth of the image's width is filled: each pixel takes the mean of the
/// nearest levels to its left, right, above and below, weighted by 1 / distance, which continues a
/// plane. Larger ones stay as they are: empty background must not become a surface.
class HoleFiller {
  public:
    void fill(DepthImage& image);

  private:
    /// Pixels [begin, end) of one row, all of level 0.
    struct Run {
        int row, begin, end;
        std::int32_t patch;
    };
    /// The rectangle around a patch, and the patch it was joined to.
    struct Patch {
        int left, right, top, bottom;
        std::int32_t parent;
    };

    void find_runs(const DepthImage& image);
    void join_runs();
    std::int32_t root(std::int32_t patch);
    void join(std::int32_t a, std::int32_t b);
    void keep_small(const DepthImage& image);
    void weigh_rows(const DepthImage& image);
    void weigh_columns(const DepthImage& image, int step);

    std::vector<Run> runs_{};
    std::vector<Patch> patches_{};
    std::vector<float> sum_{}, weight_{};  ///< of the pixels of all runs, one after the other
    std::vector<float> column_level_{};    ///< nearest level above (or below), by column
    std::vector<int> column_row_{};        ///< its row; negative: there is none
};

}  // namespace dibhr
