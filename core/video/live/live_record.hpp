// What a recording of a live source keeps of each frame.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/frames/colour_image.hpp"

namespace dibhr {

struct SourcePictures;

struct LiveRecord {
    std::shared_ptr<const SourcePictures> pictures{};
    std::int64_t media_ms{0};  ///< presentation time, from the first recorded frame
    DepthNoise noise{};        ///< with which its depth was cleaned
};

/// Unchanged levels of depth, row-major, `bytes` each, in the machine's byte order.
struct LiveLevels {
    int columns{0}, rows{0};
    int bits{8};   ///< of a level
    int bytes{0};  ///< 1 or 2; 0: not whole numbers, cannot be recorded
    std::vector<std::uint8_t> levels{};
};

[[nodiscard]] LiveLevels levels_of(const LiveRecord& record);
/// The unchanged colour; of no size where there is none.
[[nodiscard]] ColourImage colour_of(const LiveRecord& record);

/// Gets every frame before it is shown. Never waits.
using LiveSink = std::function<void(const LiveRecord&)>;

}  // namespace dibhr
