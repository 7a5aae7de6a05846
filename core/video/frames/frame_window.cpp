// Finds the two frames around a moment, and the two in-betweens that are felt and drawn.
#include "core/video/frames/frame_window.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace dibhr {

std::shared_ptr<const ColourImage> Frame::rgb() const {
    return video ? std::make_shared<const ColourImage>(video->convert()) : colour;
}

bool DepthBlend::makes_surface() const noexcept {
    if (from == nullptr || to == nullptr || !from->depth || !to->depth) return false;
    const DepthImage& a = *from->depth;
    const DepthImage& b = *to->depth;
    return a.columns == b.columns && a.rows == b.rows && a.columns >= 2 && a.rows >= 2 &&
           a.highest_level == b.highest_level && a.highest_level > 0.0;
}

DepthBlend DepthBlend::with_in_betweens() const noexcept {
    if (from == to || !from->in_betweens || from->in_betweens->empty()) return *this;
    const std::vector<Frame>& between = *from->in_betweens;
    const auto parts = static_cast<double>(between.size() + 1);
    const double at = std::clamp(blend, 0.0, 1.0) * parts;
    const auto k = std::min(static_cast<std::size_t>(at), between.size());
    return {k == 0 ? from : &between[k - 1], k == between.size() ? to : &between[k],
            at - static_cast<double>(k)};
}

DepthBlend depth_at(std::span<const Frame> frames, double time_s) noexcept {
    if (frames.empty()) return {};
    const auto after =
        std::partition_point(frames.begin(), frames.end(),
                             [time_s](const Frame& frame) { return frame.time_s <= time_s; });
    const Frame& from = after == frames.begin() ? frames.front() : *(after - 1);
    if (after == frames.end() || !(time_s >= from.time_s)) return {&from, &from, 0.0};
    const double span_s = after->time_s - from.time_s;
    return {&from, &*after, std::min((time_s - from.time_s) / span_s, 1.0)};
}

}  // namespace dibhr
