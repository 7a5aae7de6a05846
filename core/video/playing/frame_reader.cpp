// Keeps decoded frames, and the neighbours that clean them.
#include "core/video/playing/frame_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/realtime/moving_mean.hpp"
#include "core/video/playing/cleaning_degradation.hpp"
#include "core/video/playing/clip_trial.hpp"
#include "core/video/playing/held_levels_media.hpp"

namespace dibhr {

namespace {

/// Farther frames do not clean this one: all that could at 30 frames/s are nearer.
constexpr double kReach_s = 0.55;
constexpr double kUnknownInterval_s = 1.0 / 25.0;
/// After so many frames in a row, more than a window holds, the media counts as playing.
constexpr int kPlaysAfter = static_cast<int>(FrameWindow::kFrames);
constexpr std::int64_t kMostFramesBetween = 3;  // frames; no motion is computed over more
constexpr double kQuickJump_s = 0.1;            ///< quicker jumps need no preview
constexpr double kJump_s_a_pixel = 1e-7;        ///< a guess, until a jump was measured
constexpr double kMeasuring_s_a_pixel = 1e-6;   ///< likewise, of the frames that show the noise

double interval_s(const MediaDescription& description) {
    return description.frames_per_s > 0.0 ? 1.0 / description.frames_per_s : kUnknownInterval_s;
}

std::unique_ptr<Media> with_shared_memory(std::unique_ptr<Media> media,
                                          const ObjectPool<DepthImage>& images) {
    media->share_video();
    media->take_memory_from(images);
    return media;
}

}  // namespace

FrameReader::FrameReader(std::unique_ptr<Media> media, std::uint32_t number,
                         ReaderHeartbeats heartbeats, Now now)
    : now_(std::move(now)),
      assembly_(now_, kLongestPause),
      media_(std::make_unique<HeldLevelsMedia>(
                 with_shared_memory(std::move(media), assembly_.images())),
             heartbeats, now_),
      jump_s_(kJump_s_a_pixel * description().depth_columns * description().depth_rows) {
    assembly_.set_number(number);
    assembly_.set_interval(interval_s(description()));
}

double FrameReader::seconds_since(std::chrono::steady_clock::time_point begin) const {
    return std::chrono::duration<double>(now_() - begin).count();
}

FrameReader::Kept* FrameReader::find(double media_s) {
    const auto found = kept_.find(media_s);
    return found == kept_.end() ? nullptr : &found->second;
}

FrameReader::Kept* FrameReader::find_shown(double media_s) {
    const auto shown = [](Kept& kept) { return kept.has(Needs::surface) ? &kept : nullptr; };
    if (Kept* exactly = find(media_s)) return shown(*exactly);
    const double wanted_s = media_s + kTimeTolerance_s;
    const auto after = kept_.upper_bound(wanted_s);
    if (after == kept_.begin()) return nullptr;
    Kept& before = std::prev(after)->second;
    return before.next_s && wanted_s < *before.next_s ? shown(before) : nullptr;
}

FrameReader::Kept* FrameReader::read(const Pace& pace) {
    const std::optional<Position> last = std::exchange(position_, std::nullopt);
    prefetch_.reset();
    const auto begin = now_();
    auto raw = media_.next_from(pace.earliest_s, pace.spacing_s);
    const double waited_s = seconds_since(begin);
    Kept* before = last ? find(last->media_s) : nullptr;
    if (!raw) {
        if (before != nullptr) before->last = true;
        position_ = last;
        return nullptr;
    }
    const std::int64_t frames = last ? std::max<std::int64_t>(raw->index - last->index, 1) : 1;
    update_timing(*raw, frames, waited_s);
    skipped_frames_ += frames - 1;
    const bool follows = last && last->gapless && frames == 1;
    if (follows && before != nullptr) before->next_s = raw->media_s;
    Kept* kept = keep(std::move(*raw));
    if (at_beginning_) kept->first = true;
    if (follows) kept->previous_s = last->media_s;
    at_beginning_ = false;
    // The decoder may have skipped frames ahead: from here on any frame may be missing.
    const bool gapless = !(pace.spacing_s > 0.0) && (!last || last->gapless);
    position_ = {kept->frame.media_s, gapless, kept->frame.index};
    return kept;
}

/// Updates the mean times with a frame and the frames skipped before it.
void FrameReader::update_timing(const RawFrame& raw, std::int64_t frames, double waited_s) {
    waited_s = std::max(waited_s - 1e-3 * raw.single_frame_ms, 0.0);
    waited_s_ += waited_s;
    cost_.decode_ms = 1000.0 * waited_s;
    const auto count = static_cast<double>(frames);
    const bool only_decoded = raw.skipping_s > 0.0 && !filters_in_time();
    const double skipping_s = only_decoded ? raw.skipping_s : waited_s / count;
    decoding_s_ = moving_mean(decoding_s_, skipping_s);
    if (!only_decoded)
        conversion_s_ = 0.0;
    else if (const auto conversion_s = media_.conversion_s())
        conversion_s_ = moving_mean(conversion_s_, *conversion_s);
}

FrameReader::Kept* FrameReader::keep(RawFrame raw) {
    evict();
    Kept& kept = kept_[raw.media_s];
    if (need_colour(plan().steps) && !prepared_.found() && !raw.single_frame &&
        !kept.can_be_cleaned())
        assembly_.clean_frame(raw, plan());
    // The frame is new, or its colour was dropped to save memory.
    if (!kept.frame.colour_object()) kept.frame = assembly_.without_depth(raw);
    kept.frame.index = raw.index;  // after some jumps an estimate, off by the same for all
    raw.colour = {};
    raw.video.reset();
    if (!kept.can_be_cleaned()) kept.raw = std::move(raw);
    return &kept;
}

std::size_t FrameReader::reach() const {
    if (!filters_in_time()) return 0;
    // Farther frames of large pictures need more memory than most machines have.
    return plan().noise.per_frame_scale || is_large() ? kNearInTime : kReachInTime;
}

void FrameReader::jump_to(double media_s) {
    media_.seek(media_s);
    at_beginning_ = !(media_s > 0.0);
    position_.reset();
    prefetch_.reset();
}

bool FrameReader::prefetches_past(double media_s) const {
    return prefetch_ && prefetch_->from_s <= media_s && media_s <= prefetch_->kept_to_s;
}

bool FrameReader::decoder_is_after(double media_s) const {
    return position_ && position_->media_s == media_s;
}

/// Where all kept frames after this one are cleaned, sends the decoder to the end of their row
/// while they are shown, early enough for the neighbours that clean the next frame.
void FrameReader::prefetch_after_kept(double media_s) {
    std::vector<const Kept*> row{find(media_s)};
    while (const Kept* next = kept_after(*row.back(), Needs::surface)) row.push_back(next);
    const double kept_to_s = row.back()->frame.media_s;
    if (row.back()->last || decoder_is_after(kept_to_s) || prefetches_past(kept_to_s)) return;
    const auto is_cleaned = [](const Kept* kept) { return kept->is_cleaned(); };
    if (!std::all_of(row.begin(), row.end(), is_cleaned)) return;
    const double from_s = row[row.size() - 1 - std::min(reach(), row.size() - 1)]->frame.media_s;
    media_.decode_from(from_s);
    at_beginning_ = !(from_s > 0.0);
    position_.reset();
    prefetch_ = {from_s, kept_to_s};
}

/// Measures the following frames, up to a read error, which the read of that frame reports. The
/// trial takes as long again, and is of use for `automatic` alone.
void FrameReader::measure() {
    NoiseMeter meter;
    ClipTrial trial;
    try {
        media_.seek_depth(0.0);
        for (std::size_t k = 0; k < NoiseMeter::kEnoughFrames; ++k) {
            std::optional<RawFrame> raw = media_.next();
            if (!raw) break;
            if (tries()) trial.add(raw->depth);
            meter.add(std::move(raw->depth));
        }
    } catch (const InputError&) {
    }
    noise_ = meter.noise();
    if (!tries()) return;
    felt_ = trial.best_of(ways_of_automatic(description().depth_pixels()), *noise_);
    tried_ = true;
}

/// Whether the choice of `automatic` is still open.
bool FrameReader::tries() const {
    return options_.preset == CleaningPreset::automatic && !tried_ && !description().noise;
}

bool FrameReader::needs_measuring() const {
    return (needs_noise(options_) && !noise_ && !description().noise) || tries();
}

/// Measures the noise before the first frame is cleaned, where the options depend on it.
void FrameReader::make_plan() {
    if (planned_) return;
    if (!noise_) noise_ = description().noise;
    prepared_.look(description(), options_);
    media_.leave_out_depth(prepared_.times());
    const bool cleaned = std::exchange(cleans_, !prepared_.found());
    if (!prepared_.found() && needs_measuring()) {
        media_.prepare_with(nullptr);
        const auto begin = now_();
        jump_to(0.0);
        measure();
        jump_to(0.0);
        extra_s_ += seconds_since(begin);
    }
    whole_plan_ = prepared_.found() ? prepared_.plan()
                                    : plan_of(options_, noise_.value_or(DepthNoise{}),
                                              description().depth_pixels(),
                                              description().sparse_share.has_value(), felt_);
    CleaningPlan plan = whole_plan_;
    if (!prepared_.found()) plan.steps = degraded(plan.steps, degradation_);
    const bool other_steps =
        cleaned != cleans_ || mixed_ || !same_single_frame_steps(plan.steps, this->plan().steps);
    // Of frames that are kept uncleaned the colour is lost.
    mixed_ = other_steps && goes_on_ && cleaned == cleans_ && !plan.steps.steady &&
             need_colour(plan.steps) == need_colour(this->plan().steps);
    if (other_steps && !mixed_) {
        kept_.clear();
        jump_to(0.0);
    }
    for (auto& [media_s, kept] : kept_) kept.forget_cleaned();
    std::erase_if(kept_, [](const auto& kept) { return !kept.second.can_be_cleaned(); });
    assembly_.set_plan(plan);
    planned_ = true;
    goes_on_ = false;
    if (prepared_.found()) return media_.prepare_with(nullptr);
    media_.prepare_with([this, plan](RawFrame& raw) { assembly_.clean_frame(raw, plan); });
}

std::shared_ptr<const SingleFrameDepth> FrameReader::single_frame_of(Kept& kept) {
    if (!kept.raw.single_frame) assembly_.clean_frame(kept.raw, plan());
    cost_.clean_ms += std::exchange(kept.raw.single_frame_ms, 0.0);
    return kept.raw.single_frame;
}

/// A frame and its neighbours, each cleaned by itself, in order of time.
FrameReader::Neighbours FrameReader::neighbours(double media_s) {
    Neighbours neighbours;
    const auto is_near = [media_s](const Kept* kept) {
        return kept != nullptr && std::fabs(kept->frame.media_s - media_s) <= kReach_s;
    };
    neighbours.frames.push_back(single_frame_of(*find(media_s)));
    double first_s = media_s;
    for (std::size_t k = 0; k < reach(); ++k) {
        Kept* before = neighbour_before(first_s);
        if (!is_near(before)) break;
        neighbours.frames.insert(neighbours.frames.begin(), single_frame_of(*before));
        ++neighbours.now;
        first_s = before->frame.media_s;
    }
    double last_s = media_s;
    for (std::size_t k = 0; k < reach(); ++k) {
        Kept* after = neighbour_after(last_s);
        if (!is_near(after)) break;
        neighbours.frames.push_back(single_frame_of(*after));
        last_s = after->frame.media_s;
    }
    return neighbours;
}

/// Sets the prepared depth of a kept frame. False: the frame is to be cleaned.
bool FrameReader::fill_prepared(double media_s) {
    if (!prepared_.found()) return false;
    const auto begin = now_();
    Frame& frame = find(media_s)->frame;
    if (prepared_.fill(frame)) {
        frame.maps = assembly_.maps();
        cost_.clean_ms = cost_.finish_ms = 1000.0 * seconds_since(begin);
        cost_.cleaned = now_();
        return true;
    }
    planned_ = false;
    make_plan();
    for (jump_to(media_s); read() != nullptr && position_->media_s < media_s;) {
    }
    if (find(media_s) == nullptr)
        throw InputError(description().depth_path.string() + " cannot be read again at " +
                         short_text(media_s) + " s: open it again");
    return false;
}

Frame FrameReader::cleaned(double media_s) {
    wanted_s_ = media_s;
    if (!find(media_s)->is_cleaned()) {
        cost_.clean_ms = 0.0;
        if (fill_prepared(media_s)) return find(media_s)->frame;
        const Neighbours neighbours = this->neighbours(media_s);
        const auto begin = now_();
        std::vector<const SingleFrameDepth*> frames;
        frames.reserve(neighbours.frames.size());
        for (const auto& single_frame : neighbours.frames) frames.push_back(single_frame.get());
        Kept& kept = *find(media_s);
        const auto settled = std::exchange(kept.raw.settled, nullptr);
        // Of large pictures nothing is kept twice: another cleaning reads them again.
        const bool once = is_large() && !plan().steps.steady;
        RawFrame spent = once ? std::exchange(kept.raw, {}) : RawFrame{};
        kept.frame =
            once && !settled
                ? assembly_.finish_frame(kept.frame, std::move(*spent.single_frame))
                : assembly_.finish_frame(kept.frame, frames, neighbours.now, settled.get());
        cost_.finish_ms = 1000.0 * seconds_since(begin);
        cost_.clean_ms += cost_.finish_ms;
        cost_.cleaned = now_();
    }
    return find(media_s)->frame;
}

void FrameReader::set_maps(std::shared_ptr<const TouchMaps> maps) {
    for (auto& [media_s, kept] : kept_) kept.frame.maps = maps;
    assembly_.set_maps(std::move(maps));
}

FrameReader::Kept* FrameReader::kept_after(const Kept& kept, Needs needs) {
    Kept* next = kept.next_s ? find(*kept.next_s) : nullptr;
    return next != nullptr && next->has(needs) ? next : nullptr;
}

FrameReader::Kept* FrameReader::next_of(double media_s, Needs needs) {
    if (const Kept* here = find(media_s)) {
        if (here->last) return nullptr;
        if (Kept* next = kept_after(*here, needs)) return next;
    }
    if (!decoder_is_after(media_s) || !position_->gapless) {
        if (!prefetches_past(media_s)) jump_to(media_s);
        do {
            if (read() == nullptr) return nullptr;
        } while (position_->media_s < media_s);
    }
    return read();
}

/// Null also at a read error, which is kept until that frame itself is requested.
FrameReader::Kept* FrameReader::neighbour_after(double media_s) {
    if (pending_error_ && pending_error_->after_s == media_s) return nullptr;
    try {
        return next_of(media_s, Needs::depth);
    } catch (const InputError&) {
        pending_error_ = {media_s, std::current_exception()};
        return nullptr;
    }
}

/// Null also where the earlier frames cannot be read.
FrameReader::Kept* FrameReader::neighbour_before(double media_s) {
    try {
        return previous_of(media_s, Needs::depth);
    } catch (const InputError&) {
        return nullptr;
    }
}

FrameReader::Kept* FrameReader::previous_of(double media_s, Needs needs) {
    if (const Kept* here = find(media_s)) {
        if (here->first) return nullptr;
        Kept* previous = here->previous_s ? find(*here->previous_s) : nullptr;
        if (previous != nullptr && previous->has(needs)) return previous;
    }
    const double frames = std::max(frames_read_back(), static_cast<double>(reach() + 1));
    double back_s = frames * interval_s(description());
    for (;; back_s *= 2.0) {
        const double from_s = std::max(0.0, media_s - back_s);
        jump_to(from_s);
        std::optional<double> previous_s;
        const Kept* kept = read();
        while (kept != nullptr && kept->frame.media_s < media_s) {
            previous_s = kept->frame.media_s;
            kept = read();
        }
        if (previous_s)
            if (Kept* previous = find(*previous_s)) return previous;
        if (!(from_s > 0.0)) return nullptr;
    }
}

std::optional<Frame> FrameReader::at(double media_s) {
    make_plan();
    consecutive_frames_ = 0;
    if (const Kept* kept = find_shown(media_s)) return cleaned(kept->frame.media_s);
    const auto begin = now_();
    wanted_s_ = media_s;
    jump_to(media_s);
    const Kept* kept = read();
    if (kept == nullptr) return std::nullopt;
    const Frame frame = cleaned(kept->frame.media_s);
    jump_s_ = seconds_since(begin);
    return frame;
}

/// Skips nothing where the filter in time needs every frame.
const FrameReader::Kept* FrameReader::next_wanted(double media_s, const Pace& pace) {
    if (pending_error_ && pending_error_->after_s == media_s) {
        const std::exception_ptr why = std::exchange(pending_error_, {})->why;
        std::rethrow_exception(why);
    }
    const bool passes = pace.earliest_s > media_s || pace.spacing_s > 0.0;
    const Kept* const here = find(media_s);
    const bool is_kept = here != nullptr && kept_after(*here, Needs::surface) != nullptr;
    if (filters_in_time() || !passes || is_kept || !decoder_is_after(media_s))
        return next_of(media_s, Needs::surface);
    return here != nullptr && here->last ? nullptr : read(pace);
}

std::optional<Frame> FrameReader::after(double media_s, const Pace& pace) {
    make_plan();
    const Kept* next = nullptr;
    const std::int64_t skipped_frames = skipped_frames_;
    for (double from_s = media_s;; from_s = wanted_s_) {
        const Kept* further = next_wanted(from_s, pace);
        if (further == nullptr) break;
        if (next != nullptr) ++skipped_frames_;
        next = further;
        wanted_s_ = next->frame.media_s;
        if (!(wanted_s_ < pace.earliest_s)) break;
    }
    if (next == nullptr) return std::nullopt;
    // Motion is left out before frames are.
    if (skipped_frames_ > skipped_frames || !pace.time_for_motion) assembly_.pause_motion();
    Frame frame = cleaned(next->frame.media_s);
    if (++consecutive_frames_ >= kPlaysAfter) prefetch_after_kept(frame.media_s);
    return frame;
}

void FrameReader::connect(Frame& from, const Frame& next) {
    const bool follows =
        next.media_s > from.media_s && next.index - from.index <= kMostFramesBetween;
    const auto begin = now_();
    assembly_.connect(from, next, follows);
    extra_s_ += seconds_since(begin);
}

std::optional<Frame> FrameReader::before(double media_s) {
    make_plan();
    consecutive_frames_ = 0;
    wanted_s_ = media_s;
    const Kept* previous = previous_of(media_s, Needs::surface);
    if (previous == nullptr) return std::nullopt;
    return cleaned(previous->frame.media_s);
}

std::optional<Frame> FrameReader::first_picture() {
    const double measuring_s =
        kMeasuring_s_a_pixel * static_cast<double>(description().depth_pixels());
    const bool is_quick = description().still || measuring_s < kQuickJump_s;
    if (is_quick || planned_ || !needs_measuring()) return std::nullopt;
    prepared_.look(description(), options_);
    if (prepared_.found()) return std::nullopt;
    jump_to(0.0);
    return decoded_alone();
}

std::optional<Frame> FrameReader::preview(double media_s) {
    make_plan();
    if (jump_s_ < kQuickJump_s || find_shown(media_s) != nullptr) return std::nullopt;
    media_.seek_near(media_s);
    position_.reset();
    prefetch_.reset();
    return decoded_alone();
}

/// The decoder's next frame, which is not kept.
std::optional<Frame> FrameReader::decoded_alone() {
    at_beginning_ = false;
    std::optional<RawFrame> raw = media_.next();
    if (!raw) return std::nullopt;
    if (!prepared_.found()) return assembly_.finish_single_frame(std::move(*raw));
    Frame frame = assembly_.without_depth(*raw);
    planned_ = prepared_.fill(frame);
    if (!planned_) return std::nullopt;
    frame.maps = assembly_.maps();
    return frame;
}

double FrameReader::last_interval_s(double media_s) {
    const Kept* last = find(media_s);
    if (last != nullptr && last->previous_s) return media_s - *last->previous_s;
    return interval_s(description());
}

void FrameReader::set_cleaning(const CleaningOptions& options) {
    if (options == options_) return;
    options_ = options;
    planned_ = goes_on_ = false;
}

void FrameReader::set_degradation(std::size_t level) {
    if (prepared_.found() || (level == degradation_ && !mixed_)) return;
    degradation_ = level;
    planned_ = goes_on_ = false;
}

void FrameReader::degrade_next(std::size_t level) {
    const bool goes_on = planned_ || goes_on_;  // no other change is to come
    set_degradation(level);
    goes_on_ = goes_on;
}

}  // namespace dibhr
