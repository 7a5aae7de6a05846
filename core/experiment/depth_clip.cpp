// The blend between the frames around a moment.
#include "core/experiment/depth_clip.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kOnlyInterval_s = 1.0;  // of two frames at one time: never asked for

}  // namespace

DepthClip::DepthClip(std::vector<TimedDepth> frames, SurfaceShape shape)
    : frames_(std::move(frames)), shape_(shape) {
    if (frames_.empty()) throw InputError("the depth video holds no picture; choose another one");
    const DepthImage& first = frames_.front().image;
    double interval_s = kOnlyInterval_s;
    for (std::size_t k = 0; k < frames_.size(); ++k) {
        const DepthImage& image = frames_[k].image;
        if (image.columns < 2 || image.rows < 2) {
            throw InputError("the depth video is too small to touch; choose one of at least 2x2");
        }
        if (image.columns != first.columns || image.rows != first.rows ||
            image.highest_level != first.highest_level) {
            throw InputError("the depth video's pictures differ in size; choose another one");
        }
        if (k == 0) continue;
        interval_s = frames_[k].time_s - frames_[k - 1].time_s;
        if (!(interval_s > 0.0)) {
            throw InputError("the depth video's pictures are not in order; choose another one");
        }
    }
    if (frames_.size() > 1) {
        duration_s_ = frames_.back().time_s - frames_.front().time_s + interval_s;
    }
}

DepthSurface DepthClip::at(double t_s) const noexcept {
    if (frames_.size() == 1) return {frames_[0].image, frames_[0].image, 0.0, shape_};
    const double begin_s = frames_.front().time_s;
    const double round_s = std::fmod(std::max(t_s, 0.0), duration_s_);
    const auto after = std::upper_bound(
        frames_.begin(), frames_.end(), begin_s + round_s,
        [](double time_s, const TimedDepth& frame) { return time_s < frame.time_s; });
    const TimedDepth& from = after == frames_.begin() ? frames_.front() : *(after - 1);
    const bool last = after == frames_.end();
    const TimedDepth& to = last ? frames_.front() : *after;
    const double end_s = last ? begin_s + duration_s_ : to.time_s;
    const double blend = (begin_s + round_s - from.time_s) / (end_s - from.time_s);
    return {from.image, to.image, blend, shape_};
}

double DepthClip::time_of(std::int64_t frame, double blend) const noexcept {
    if (frames_.size() == 1) return 0.0;
    const auto last = static_cast<std::int64_t>(frames_.size()) - 1;
    const auto k = static_cast<std::size_t>(std::clamp<std::int64_t>(frame, 0, last));
    const double begin_s = frames_.front().time_s;
    const double from_s = frames_[k].time_s - begin_s;
    const double to_s = k + 1 < frames_.size() ? frames_[k + 1].time_s - begin_s : duration_s_;
    return from_s + std::clamp(blend, 0.0, 1.0) * (to_s - from_s);
}

}  // namespace dibhr
