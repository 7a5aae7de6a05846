// A picture as a video's decoder made it: luma and chroma instead of red, green and blue.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/video/frames/colour_image.hpp"

namespace dibhr {

/// Rows of samples in the decoder's memory.
struct SamplePlane {
    const std::uint8_t* samples{nullptr};
    std::size_t row_bytes{0};  ///< from one row to the next
    int columns{0}, rows{0};
};

/// Shared; never written to.
struct VideoPicture {
    /// Luma; blue chroma; red chroma. Without colours a plane of chroma has 1 x 1 sample.
    std::array<SamplePlane, 3> planes{};
    /// 3; 2: the second plane has blue and red chroma side by side.
    int plane_count{3};
    int sample_bytes{1};  ///< 2: words of this machine
    /// Red, green and blue in [0, 1], row by row, of luma, blue chroma, red chroma and 1, where the
    /// samples are in [0, 1]. Results may be beyond and have to be clamped.
    std::array<std::array<float, 4>, 3> rgb_of_samples{};
    int quarter_turns{0};     ///< clockwise, from the planes to the shown picture
    int columns{0}, rows{0};  ///< of the shown picture, which has square pixels
    std::size_t bytes{0};     ///< of the memory that it shares
    /// The same picture as ColourImage, as other readers of the file get it; any thread.
    std::function<ColourImage()> convert{};
};

/// The places in the planes of the places in the shown picture, both in [0, 1] to the right and
/// down: (across.x * x + across.y * y + across.z, down.x * x + down.y * y + down.z).
struct PlaneTurn {
    std::array<float, 3> across{}, down{};
};
[[nodiscard]] PlaneTurn turn_of(int quarter_turns) noexcept;

/// Red, green and blue of a pixel of the shown picture; its chroma is that of the nearest sample.
[[nodiscard]] std::array<std::uint8_t, 3> rgb_at(const VideoPicture& picture, int column,
                                                 int row) noexcept;

/// Every `step`-th pixel of every `step`-th row, as the planes lie, in red, green, blue and 255;
/// at least one. For textures: 1 ns a pixel. Returns columns and rows.
std::array<int, 2> write_rgbx(const VideoPicture& picture, int step,
                              std::vector<std::uint32_t>& rgbx);

}  // namespace dibhr
