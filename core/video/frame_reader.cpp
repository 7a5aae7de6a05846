// Frames of one media, cleaned, in any order: keeps the last few so that stepping back is
// immediate.
#include "core/video/frame_reader.hpp"

#include <algorithm>
#include <utility>

namespace dibhr {
namespace {

constexpr std::size_t kKept = 32;
constexpr std::size_t kLeastKept = 8;                       ///< the window and a few to step back
constexpr std::size_t kMostBytes = std::size_t{256} << 20;  ///< large frames: fewer of them
constexpr int kReadBack = 12;                               ///< frames decoded at once to go back
constexpr double kUnknownInterval_s = 1.0 / 25.0;

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

double interval_s(const MediaDescription& description) {
    return description.frames_per_s > 0.0 ? 1.0 / description.frames_per_s : kUnknownInterval_s;
}

std::size_t bytes_of(const Frame& frame) {
    return 2 * frame.depth->levels.size() * sizeof(float) + frame.colour->rgb.size();
}

}  // namespace

FrameReader::FrameReader(std::unique_ptr<Media> media, std::uint32_t number)
    : media_(std::move(media)), number_(number) {}

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
    const std::size_t by_size = kMostBytes / std::max<std::size_t>(1, bytes_of(kept_.back().raw));
    const std::size_t most = std::clamp(by_size, kLeastKept, kKept);
    while (kept_.size() >= most) kept_.pop_front();
}

void FrameReader::jump_to(double media_s) {
    media_->seek(media_s);
    position_s_.reset();
}

Frame FrameReader::cleaned(Kept& kept) {
    Frame frame = kept.raw;
    if (kept.cleaned == nullptr) {
        if (!cleaning_.any()) {
            kept.cleaned = kept.raw.depth;
        } else {
            const auto begin = std::chrono::steady_clock::now();
            auto depth = std::make_shared<DepthImage>(*kept.raw.depth);
            cleaner_.clean(*depth, cleaning_);
            kept.cleaned = std::move(depth);
            cost_.clean_ms = milliseconds_since(begin);
        }
        cost_.cleaned = std::chrono::steady_clock::now();
    }
    frame.depth = kept.cleaned;
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

}  // namespace dibhr
