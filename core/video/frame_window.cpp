// The depth at a moment between frames.
#include "core/video/frame_window.hpp"

namespace dibhr {

bool DepthBlend::makes_surface() const noexcept {
    if (from == nullptr || to == nullptr || !from->depth || !to->depth) return false;
    const DepthImage& a = *from->depth;
    const DepthImage& b = *to->depth;
    return a.columns == b.columns && a.rows == b.rows && a.columns >= 2 && a.rows >= 2 &&
           a.highest_level == b.highest_level && a.highest_level > 0.0;
}

DepthBlend depth_at(std::span<const Frame> frames, double time_s) noexcept {
    if (frames.empty()) return {};
    const auto after =
        std::partition_point(frames.begin(), frames.end(),
                             [time_s](const Frame& frame) { return frame.time_s <= time_s; });
    const Frame& from = after == frames.begin() ? frames.front() : *(after - 1);
    if (after == frames.end() || !(time_s > from.time_s)) return {&from, &from, 0.0};
    const double span_s = after->time_s - from.time_s;
    return {&from, &*after, std::min((time_s - from.time_s) / span_s, 1.0)};
}

}  // namespace dibhr
