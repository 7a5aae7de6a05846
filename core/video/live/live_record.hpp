// What is kept of live frames while they are recorded.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/frames/colour_image.hpp"

namespace dibhr {

struct TakenPictures;

struct LiveRecord {
    std::shared_ptr<const TakenPictures> pictures{};
    std::int64_t media_ms{0};  ///< its presentation time, from the recording's first
    DepthNoise noise{};        ///< by which its depth was cleaned
};

/// Levels of depth as they came, row-major, of `bytes` each, the machine's order.
struct LiveLevels {
    int columns{0}, rows{0};
    int bits{8};   ///< of a level
    int bytes{0};  ///< 1 or 2; 0: they are no whole numbers, and cannot be kept
    std::vector<std::uint8_t> levels{};
};

[[nodiscard]] LiveLevels levels_of(const LiveRecord& record);
/// As it came; of no size where there is none.
[[nodiscard]] ColourImage colour_of(const LiveRecord& record);

/// Gets every frame that is shown, before it is. Waits for nothing.
using LiveSink = std::function<void(const LiveRecord&)>;

}  // namespace dibhr
