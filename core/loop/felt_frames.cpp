// Finds frames by where their images are in memory.
#include "core/loop/felt_frames.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/video/sources/preview_picture.hpp"

namespace dibhr {

namespace {

/// Of frames that wait for a recorder whose disk is busy.
constexpr std::size_t kMostWaiting_bytes = std::size_t{256} << 20;

std::size_t bytes_of(const Frame& frame) noexcept {
    const std::size_t images = frame.in_betweens ? 1 + frame.in_betweens->size() : 1;
    return frame.depth->levels.size() *
           (images * sizeof(float) + (frame.motion ? sizeof(MotionField::Way) : 0));
}

void drop_colour(Frame& frame) {
    frame.colour.reset();
    frame.video.reset();
}

/// What lies between two frames means nothing where a frame blends with itself.
bool blends_with_itself(const TickRecord& tick) noexcept {
    return tick.mark.from == tick.mark.to && tick.frames.from_s == tick.frames.to_s;
}

}  // namespace

void FeltFrames::add(const FrameWindow& window) {
    const std::lock_guard lock(guard_);
    const std::size_t before = frames_.size();
    for (Felt& felt : frames_) felt.was_shown = std::exchange(felt.shown, false);
    for (std::size_t k = 0; k < std::min(window.count, FrameWindow::kFrames); ++k) {
        const Frame& frame = window.frames[k];
        if (!frame.depth) continue;
        // A frame that comes again is another one: ticks ask in the order of publishing.
        const auto is_it = [&frame](const Felt& felt) {
            const Frame& other = felt.frame;
            return felt.was_shown && other.depth == frame.depth && other.motion == frame.motion &&
                   other.in_betweens == frame.in_betweens && other.maps == frame.maps &&
                   other.media_s == frame.media_s && other.media == frame.media;
        };
        const auto end = frames_.begin() + static_cast<std::ptrdiff_t>(before);
        const auto known = std::find_if(frames_.begin(), end, is_it);
        if (known != end) {
            known->shown = true;
        } else {
            Felt& felt = frames_.emplace_back(Felt{.frame = frame, .shown = true});
            felt.frame.undilated.reset();
            const Second second = second_of(frame);
            felt.pictured =
                keeps_ && pictures_ && last_kept_ != second && !pictured_.contains(second);
            if (felt.pictured) last_kept_ = second;
        }
    }
    for (Felt& felt : frames_)
        if (!felt.shown && !felt.pictured) drop_colour(felt.frame);
    drop_unused();
}

void FeltFrames::keep(bool on, bool pictures) {
    const std::lock_guard lock(guard_);
    keeps_ = on;
    pictures_ = pictures;
    last_kept_.reset();
    pictured_.clear();
    from_ = to_ = {};
    others_.clear();
    if (on) {
        others_.emplace_back();
        for (const Algorithm algorithm : all_algorithms()) others_.push_back({algorithm});
        others_.push_back({.algorithm = Algorithm::dibhr, .slides = true});
    }
    drop_unused();
}

FeltFrames::Second FeltFrames::second_of(const Frame& frame) noexcept {
    return {frame.media, std::llround(std::floor(frame.media_s))};
}

std::string FeltFrames::preview() {
    Frame frame;
    {
        const std::lock_guard lock(guard_);
        if (!pictures_ || !from_.has_colour() || !pictured_.insert(second_of(from_)).second)
            return {};
        frame = from_;
        drop_colour(from_);
    }
    return preview_of(frame);
}

/// The caller holds the lock. Never drops what is in the last window.
void FeltFrames::drop_unused() {
    std::size_t bytes = 0;
    for (auto felt = frames_.rbegin(); felt != frames_.rend(); ++felt) {
        bytes += bytes_of(felt->frame);
        if (!felt->shown && (!keeps_ || bytes > kMostWaiting_bytes)) felt->frame.depth.reset();
    }
    std::erase_if(frames_, [](const Felt& felt) { return !felt.frame.depth; });
}

std::optional<FeltSurface> FeltFrames::surface_of(const TickRecord& tick) {
    const SurfaceMark& mark = tick.mark;
    const auto is = [&tick](const Frame& frame, const void* image, double media_s) {
        return frame.depth.get() == image && frame.media_s == media_s &&
               frame.media == tick.frames.source.media;
    };
    const bool still = blends_with_itself(tick);
    const std::lock_guard lock(guard_);
    const auto from = std::ranges::find_if(frames_, [&](const Felt& felt) {
        const Frame& frame = felt.frame;
        const auto maps = frame.maps ? frame.maps->version : 0;
        return is(frame, mark.from, tick.frames.from_s) && maps == tick.frames.source.maps &&
               (still ||
                (frame.motion.get() == mark.motion && frame.in_betweens.get() == mark.in_betweens));
    });
    const auto to = std::ranges::find_if(
        frames_, [&](const Felt& felt) { return is(felt.frame, mark.to, tick.frames.to_s); });
    if (from == frames_.end() || to == frames_.end()) return std::nullopt;
    from_ = from->frame;
    to_ = to->frame;
    // Ticks go on in the order of publishing: what came before is not asked for again.
    std::erase_if(frames_, [first = &*std::min(from, to)](const Felt& felt) {
        return &felt < first && !felt.shown;
    });
    FeltSurface surface{.images = {{from_.depth, from_.unseen}}, .motion = {}};
    if (still) return surface;
    surface.motion = from_.motion;
    if (from_.in_betweens)
        for (const Frame& between : *from_.in_betweens)
            surface.images.push_back({between.depth, between.unseen});
    surface.images.push_back({to_.depth, to_.unseen});
    return surface;
}

std::vector<SurfaceRead> FeltFrames::read_by_others(const TickRecord& tick,
                                                    const SessionParameters& parameters,
                                                    const BumpMap* bump) {
    const std::lock_guard lock(guard_);
    std::vector<SurfaceRead> read;
    const DepthBlend frames{&from_, blends_with_itself(tick) ? &from_ : &to_, tick.blend};
    for (Other& other : others_) {
        if (!tick.surface || !frames.makes_surface()) {
            other.run.pause();
            continue;
        }
        TouchParameters touch = parameters.touch;
        touch.algorithm = other.algorithm.value_or(touch.algorithm);
        if (other.slides) touch.friction = {0.0, 0.0};
        other.run.run(tick, frames, bump, touch, parameters);
        read.push_back(other.run.read());
    }
    return read;
}

}  // namespace dibhr
