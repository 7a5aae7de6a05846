// Reads a depth video forward to any playback time.
#include "core/video/depth_in_time.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace dibhr {
namespace {

/// Shorter rounds than this are taken for a file without time stamps.
constexpr double kShortestRound_s = 1e-4;

}  // namespace

DepthInTime::DepthInTime(std::unique_ptr<Media> media, bool moving, const CleaningOptions& cleaning)
    : media_(std::move(media)), cleaning_(cleaning) {
    const std::string name = media_->description().depth_path.string();
    std::optional<RawFrame> first = media_->next();
    if (!first) {
        throw InputError(name + ": holds no picture; choose another depth file");
    }
    DepthImage& depth = first->depth;
    if (depth.columns < 2 || depth.rows < 2) {
        throw InputError(name + ": " + std::to_string(depth.columns) + "x" +
                         std::to_string(depth.rows) +
                         " pixels are too few to touch; choose a depth file of at least 2x2");
    }
    if (cleaning_.any()) cleaner_.clean(depth, cleaning_);
    first_media_s_ = first->media_s;
    from_.image = std::move(depth);
    if (moving && !media_->description().still) to_ = read();
}

bool DepthInTime::advance_to(double playback_s) {
    bool started_again = false;
    while (to_ && to_->playback_s <= playback_s) {
        last_interval_s_ = to_->playback_s - from_.playback_s;
        std::swap(from_, *to_);
        to_ = read();
        if (!to_) {
            if (!start_again(playback_s)) break;
            started_again = true;
        }
    }
    const double interval_s = to_ ? to_->playback_s - from_.playback_s : 0.0;
    blend_ = interval_s > 0.0 ? (playback_s - from_.playback_s) / interval_s : 0.0;
    return started_again;
}

DepthSurface DepthInTime::surface(const SurfaceShape& shape, const BumpMap* bump) const {
    const DepthImage& to = to_ ? to_->image : from_.image;
    return {from_.image, to, blend_, shape, bump};
}

std::optional<DepthInTime::TimedDepth> DepthInTime::read() {
    std::optional<RawFrame> frame = media_->next();
    if (!frame) return std::nullopt;
    if (cleaning_.any()) cleaner_.clean(frame->depth, cleaning_);
    return TimedDepth{std::move(frame->depth), offset_s_ + frame->media_s - first_media_s_};
}

bool DepthInTime::start_again(double playback_s) {
    const double round_s = from_.playback_s + last_interval_s_ - offset_s_;
    if (!(round_s > kShortestRound_s)) return false;
    // Whole rounds that nobody asks for are not decoded.
    const double rounds = std::floor((playback_s - offset_s_) / round_s);
    offset_s_ += std::fmax(rounds, 1.0) * round_s;
    media_->seek(first_media_s_);
    to_ = read();
    return to_.has_value();
}

}  // namespace dibhr
