// Reads and loops depth by time, without a clock.
#include "core/video/playing/depth_timeline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kShortestLap_s = 1e-4;  ///< shorter loops count as a file without time stamps

}  // namespace

DepthTimeline::DepthTimeline(std::unique_ptr<Media> media, Wanted wanted,
                             const CleaningOptions& cleaning, const MotionRequest& motion,
                             std::shared_ptr<const TouchMaps> maps)
    : reader_(std::move(media)) {
    reader_.set_maps(std::move(maps));
    reader_.set_motion(motion);
    const std::string name = reader_.description().depth_path.string();
    reader_.set_cleaning(cleaning);
    std::optional<Frame> first = reader_.at(0.0);
    if (!first) {
        throw InputError(name + ": holds no picture; choose another depth file");
    }
    const DepthImage& depth = *first->depth;
    if (depth.columns < 2 || depth.rows < 2) {
        throw InputError(name + ": " + std::to_string(depth.columns) + "x" +
                         std::to_string(depth.rows) +
                         " pixels are too few to touch; choose a depth file of at least 2x2");
    }
    first_media_s_ = first->media_s;
    add(std::move(first));
    if (wanted != Wanted::first && !reader_.description().still) add(reader_.after(first_media_s_));
}

bool DepthTimeline::advance_to(double playback_s) {
    bool started_again = false;
    now_s_ = playback_s;
    while (frames_.size() > 1 && frames_[1].time_s <= playback_s) {
        last_interval_s_ = frames_[1].time_s - frames_[0].time_s;
        frames_.erase(frames_.begin());
        if (add(reader_.after(frames_[0].media_s))) continue;
        started_again = start_again(playback_s) || started_again;
    }
    return started_again;
}

bool DepthTimeline::add(std::optional<Frame> frame) {
    if (!frame) return false;
    frame->time_s = offset_s_ + frame->media_s - first_media_s_;
    if (!frames_.empty()) reader_.connect(frames_.back(), *frame);
    frames_.push_back(std::move(*frame));
    return true;
}

bool DepthTimeline::start_again(double playback_s) {
    const double lap_s = frames_[0].time_s + last_interval_s_ - offset_s_;
    if (!(lap_s > kShortestLap_s)) return false;
    // Whole loops that lie between are not decoded.
    const double laps = std::floor((playback_s - offset_s_) / lap_s);
    offset_s_ += std::fmax(laps, 1.0) * lap_s;
    return add(reader_.at(first_media_s_));
}

DepthClip::DepthClip(std::vector<Frame> frames, const SurfaceShape& shape,
                     std::shared_ptr<const BumpMap> bump)
    : frames_(std::move(frames)), shape_(shape), bump_(std::move(bump)) {
    if (frames_.empty()) throw InputError("the depth video holds no picture; choose another one");
    const Frame& first = frames_.front();
    if (first.depth->columns < 2 || first.depth->rows < 2) {
        throw InputError("the depth video is too small to touch; choose one of at least 2x2");
    }
    double interval_s = 0.0;
    for (std::size_t k = 1; k < frames_.size(); ++k) {
        if (!DepthBlend{&first, &frames_[k]}.makes_surface()) {
            throw InputError("the depth video's pictures differ in size; choose another one");
        }
        interval_s = frames_[k].time_s - frames_[k - 1].time_s;
        if (!(interval_s > 0.0)) {
            throw InputError("the depth video's pictures are not in order; choose another one");
        }
    }
    if (frames_.size() == 1) return;
    Frame again = frames_.front();
    again.time_s = frames_.back().time_s + interval_s;
    frames_.push_back(std::move(again));
}

DepthSurface DepthClip::at(double t_s) const noexcept {
    return blend_at(t_s).surface(shape_, bump_.get());
}

DepthBlend DepthClip::blend_at(double t_s) const noexcept {
    const double begin_s = frames_.front().time_s;
    const double lap_s = frames_.size() > 1 ? std::fmod(std::max(t_s, 0.0), duration_s()) : 0.0;
    return depth_at(frames_, begin_s + lap_s);
}

double DepthClip::time_of(std::int64_t frame, double blend) const noexcept {
    if (frames_.size() == 1) return 0.0;
    const auto last = static_cast<std::int64_t>(frames_.size()) - 2;
    const auto k = static_cast<std::size_t>(std::clamp<std::int64_t>(frame, 0, last));
    const double begin_s = frames_.front().time_s;
    const double from_s = frames_[k].time_s - begin_s;
    const double to_s = frames_[k + 1].time_s - begin_s;
    return from_s + std::clamp(blend, 0.0, 1.0) * (to_s - from_s);
}

DepthClip read_depth_clip(std::unique_ptr<Media> media, const CleaningOptions& cleaning,
                          const SurfaceShape& shape,
                          const std::function<void(double share)>& progress) {
    FrameReader reader(std::move(media));
    if (reader.description().live)
        throw InputError(reader.description().depth_path.string() +
                         ": is live and has no end; record a session of it, or a file");
    reader.set_cleaning(cleaning);
    const auto count = static_cast<double>(std::max<std::int64_t>(reader.description().frames, 1));
    std::vector<Frame> frames;
    for (auto frame = reader.at(0.0); frame; frame = reader.after(frames.back().media_s)) {
        frame->time_s = frame->media_s;
        frames.push_back(std::move(*frame));
        if (progress) progress(static_cast<double>(frames.size()) / count);
    }
    return {std::move(frames), shape};
}

}  // namespace dibhr
