// What is kept of live frames while they are recorded.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/video/cleaning/depth_noise.hpp"

namespace dibhr {

struct TakenPictures;

struct LiveRecord {
    std::shared_ptr<const TakenPictures> pictures{};
    std::int64_t media_ms{0};  ///< its presentation time, from the recording's first
    DepthNoise noise{};        ///< by which its depth was cleaned
};

/// Gets every frame that is shown, before it is. Waits for nothing.
using LiveSink = std::function<void(const LiveRecord&)>;

}  // namespace dibhr
