// Frames of one media in any order, and as a surface at any time.
#include "core/video/frame_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/video/depth/remembering_media.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kKept = 32;
constexpr std::size_t kLeastKept = 8;                       ///< the window and a few to step back
constexpr std::size_t kMostBytes = std::size_t{256} << 20;  ///< large frames: fewer of them
constexpr int kReadBack = 12;                               ///< frames decoded at once to go back
constexpr double kUnknownInterval_s = 1.0 / 25.0;
constexpr double kShortestLap_s = 1e-4;  ///< a shorter one is taken for a file without time stamps

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

double interval_s(const MediaDescription& description) {
    return description.frames_per_s > 0.0 ? 1.0 / description.frames_per_s : kUnknownInterval_s;
}

}  // namespace

FrameReader::FrameReader(std::unique_ptr<Media> media, std::uint32_t number)
    : media_(std::make_unique<RememberingMedia>(std::move(media))), number_(number) {}

FrameReader::Kept* FrameReader::find(double media_s) {
    const auto found = std::find_if(kept_.begin(), kept_.end(), [media_s](const Kept& kept) {
        return kept.raw.media_s == media_s;  // a name: the same frame has the same bits
    });
    return found == kept_.end() ? nullptr : &*found;
}

FrameReader::Kept* FrameReader::read() {
    const auto begin = std::chrono::steady_clock::now();
    auto raw = media_->next();
    begun_ = true;
    if (!raw) return nullptr;
    cost_.decode_ms = milliseconds_since(begin);
    Kept* before = position_s_ ? find(*position_s_) : nullptr;
    if (before != nullptr) before->next_s = raw->media_s;
    Kept* kept = find(raw->media_s);
    if (kept == nullptr) {
        drop_oldest();
        kept = &kept_.emplace_back();
        kept->raw.depth = std::make_shared<const DepthImage>(std::move(raw->depth));
        kept->held = std::move(raw->held);
        kept->raw.colour = std::make_shared<const ColourImage>(std::move(raw->colour));
        kept->raw.media_s = raw->media_s;
        kept->raw.index = raw->index;
        kept->raw.media = number_;
    }
    if (position_s_) kept->previous_s = position_s_;
    position_s_ = raw->media_s;
    return kept;
}

/// Makes room for one more. Re-read frames stay where they are: the oldest decoded goes first.
void FrameReader::drop_oldest() {
    if (kept_.empty()) return;
    const std::size_t by_size = kMostBytes / std::max<std::size_t>(1, bytes_of(kept_.back()));
    const std::size_t most = std::clamp(by_size, kLeastKept, kKept);
    while (kept_.size() >= most) kept_.pop_front();
}

std::size_t FrameReader::bytes_of(const Kept& kept) {
    return 2 * kept.raw.depth->levels.size() * sizeof(float) +
           kept.held.size() * sizeof(HeldLevel) + kept.raw.colour->rgb.size();
}

void FrameReader::jump_to(double media_s) {
    media_->seek(media_s);
    position_s_.reset();
}

Frame FrameReader::cleaned(Kept& kept) {
    Frame frame = kept.raw;
    if (!kept.cleaned) {
        const auto begin = std::chrono::steady_clock::now();
        kept.cleaned = cleaner_.cleaned(*kept.raw.depth, cleaning_, kept.held);
        cost_.clean_ms = milliseconds_since(begin);
        cost_.cleaned = std::chrono::steady_clock::now();
    }
    frame.depth = kept.cleaned->depth;
    frame.unseen = kept.cleaned->unseen;
    frame.cleaning = cleaning_;
    return frame;
}

std::optional<Frame> FrameReader::at(double media_s) {
    if (Kept* exact = find(media_s)) return cleaned(*exact);
    const double wanted_s = media_s + kTimeTolerance_s;
    for (Kept& kept : kept_)
        if (kept.raw.media_s <= wanted_s && kept.next_s && wanted_s < *kept.next_s)
            return cleaned(kept);
    if (begun_ || media_s > 0.0) jump_to(media_s);
    Kept* kept = read();
    if (kept == nullptr) return std::nullopt;
    return cleaned(*kept);
}

std::optional<Frame> FrameReader::after(double media_s) {
    if (const Kept* here = find(media_s); here != nullptr && here->next_s)
        if (Kept* next = find(*here->next_s)) return cleaned(*next);
    if (position_s_ != media_s) {
        jump_to(media_s);
        if (read() == nullptr) return std::nullopt;
    }
    Kept* next = read();
    if (next == nullptr) return std::nullopt;
    return cleaned(*next);
}

std::optional<Frame> FrameReader::before(double media_s) {
    if (const Kept* here = find(media_s); here != nullptr && here->previous_s)
        if (Kept* previous = find(*here->previous_s)) return cleaned(*previous);
    double back_s = kReadBack * interval_s(description());
    for (;; back_s *= 2.0) {
        const double from_s = std::max(0.0, media_s - back_s);
        jump_to(from_s);
        std::optional<double> previous_s;
        const Kept* kept = read();
        while (kept != nullptr && kept->raw.media_s < media_s) {
            previous_s = kept->raw.media_s;
            kept = read();
        }
        if (previous_s)
            if (Kept* previous = find(*previous_s)) return cleaned(*previous);
        if (!(from_s > 0.0)) return std::nullopt;
    }
}

double FrameReader::last_interval_s(double media_s) {
    const Kept* last = find(media_s);
    if (last != nullptr && last->previous_s) return media_s - *last->previous_s;
    return interval_s(description());
}

void FrameReader::set_cleaning(const CleaningOptions& options) {
    if (options == cleaning_) return;
    cleaning_ = options;
    for (Kept& kept : kept_) kept.cleaned.reset();
}

DepthInTime::DepthInTime(std::unique_ptr<Media> media, bool moving, const CleaningOptions& cleaning)
    : reader_(std::move(media)) {
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
    if (moving && !reader_.description().still) add(reader_.after(first_media_s_));
}

bool DepthInTime::advance_to(double playback_s) {
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

bool DepthInTime::add(std::optional<Frame> frame) {
    if (!frame) return false;
    frame->time_s = offset_s_ + frame->media_s - first_media_s_;
    frames_.push_back(std::move(*frame));
    return true;
}

bool DepthInTime::start_again(double playback_s) {
    const double lap_s = frames_[0].time_s + last_interval_s_ - offset_s_;
    if (!(lap_s > kShortestLap_s)) return false;
    // Whole laps that nobody asks for are not decoded.
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
    const double begin_s = frames_.front().time_s;
    const double lap_s = frames_.size() > 1 ? std::fmod(std::max(t_s, 0.0), duration_s()) : 0.0;
    return depth_at(frames_, begin_s + lap_s).surface(shape_, bump_.get());
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
