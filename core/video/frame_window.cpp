// What the player hands to the haptic thread and to the window: a few frames around now, and the
// clock.
#include "core/video/frame_window.hpp"

#include <algorithm>

namespace dibhr {

DepthBlend FrameWindow::at(double playback_s) const noexcept {
    const std::size_t held = std::min(count, kFrames);
    if (held == 0) return {};
    // The pair's first frame: the last one that is not later than the moment.
    std::size_t from = 0;
    while (from + 1 < held && frames[from + 1].time_s <= playback_s) ++from;
    const Frame& first = frames[from];
    if (from + 1 == held || !(playback_s > first.time_s)) return {&first, &first, 0.0};
    const Frame& second = frames[from + 1];
    const double span_s = second.time_s - first.time_s;
    return {&first, &second, std::min((playback_s - first.time_s) / span_s, 1.0)};
}

}  // namespace dibhr
