// What a live frame is made of, to be kept; inside video and clip.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/video/live/live_feed.hpp"

namespace dibhr {

/// Shared with nobody who writes.
struct TakenPictures {
    cv::Mat levels{};  ///< of depth, before their meaning is looked up
    int bits{8};       ///< of a level
    cv::Mat colour{};  ///< 8-bit blue, green, red, as it came; empty: there is none
    std::shared_ptr<const LivePair> pair{};
};

}  // namespace dibhr
