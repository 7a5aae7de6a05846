// The playback timeline: reads frames ahead of its clock, and skips those that would be late.
#include "core/video/playing/playback.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/realtime/moving_mean.hpp"

namespace dibhr {
namespace {

constexpr double kJump_s = 0.001;      ///< between frames: no two have the same playback time
constexpr double kNewestWeight = 0.2;  ///< the weight of the newest frame in the means
constexpr std::chrono::seconds kShownFor{3};  ///< so long the status says that the clock waited
constexpr double kMostBehind_s = 1.0;         ///< beyond this the clock waits
constexpr std::size_t kLarge = 4'000'000;     ///< pixels

}  // namespace

Playback::Playback(unsigned processors) : processors_(processors) {}

void Playback::open(std::unique_ptr<FrameReader> reader, Time now) {
    reader->set_cleaning(cleaning_);
    reader->set_motion(motion_request_);
    auto first = reader->first_picture();
    const bool is_preview = first.has_value();
    if (!first) first = reader->at(0.0);
    if (!first)
        throw InputError("'" + reader->description().depth_path.string() +
                         "' holds no frame: record it again");
    reader_ = std::move(reader);
    first_media_s_ = first->media_s;
    seek_target_s_ = is_preview ? std::optional(first_media_s_) : std::nullopt;
    degradation_ = {};
    drawing_rate_ = {};
    forget_costs();
    plan_ = {.speed = speed_};
    playing_ = true;
    jump_to(std::move(*first), now, is_preview);
}

/// Keeps the frames, so that the timeline continues.
void Playback::close() {
    reader_.reset();
    seek_target_s_.reset();
    is_preview_ = false;
    playing_ = false;
}

void Playback::anchor(double playback_s, Time now) {
    clock_ = {now, playback_s, playing_ ? plan_.speed : 0.0};
}

double Playback::moment(Time now) const {
    const double playback_s = clock_.playback_s(now);
    return frames_.empty() ? playback_s : std::min(playback_s, frames_.back().time_s);
}

/// The frame begins after all earlier frames, which were shown while it was read.
void Playback::jump_to(Frame frame, Time now, bool is_preview) {
    frame.time_s =
        frames_.empty() ? 0.0 : std::max(clock_.playback_s(now), frames_.back().time_s) + kJump_s;
    offset_s_ = frame.time_s - frame.media_s;
    beyond_part_ = part_ && frame.media_s > part_->to_s;
    frames_.clear();
    frames_.push_back(std::move(frame));
    complete_ = false;
    starts_ = true;
    is_preview_ = is_preview;
    ++discontinuity_;
    anchor(frames_.front().time_s, now);
}

bool Playback::single() const {
    return complete_ && frames_.size() == 1 && !(frames_.front().media_s > first_media_s_);
}

void Playback::play(Time now) {
    if (!is_open() || playing_) return;
    const bool at_end = complete_ && frames_.size() == 1;
    playing_ = !single();
    if (at_end && playing_)
        seek(lap_begins_s(), now);
    else
        anchor(moment(now), now);
    apply_degradation();
}

void Playback::pause(Time now) {
    if (!is_open()) return;
    const double playback_s = moment(now);
    playing_ = false;
    anchor(playback_s, now);
    apply_degradation();
}

void Playback::seek(double media_s, Time now) {
    if (!is_open()) return;
    steps_back_ = false;
    seek_target_s_ = std::max(media_s, first_media_s_);
    if (auto preview = reader_->preview(*seek_target_s_))
        jump_to(std::move(*preview), now, true);
    else
        read_seek_target(now);
}

bool Playback::read_seek_target(Time now) {
    const double media_s = *std::exchange(seek_target_s_, std::nullopt);
    auto frame = reader_->at(media_s);
    if (frame) jump_to(std::move(*frame), now);
    return frame.has_value();
}

void Playback::step(int frames, Time now) {
    if (!is_open()) return;
    if (seek_target_s_) read_seek_target(now);
    pause(now);
    Frame reached = frames_.front();
    for (int k = 0; k < std::abs(frames); ++k) {
        auto next = frames > 0 ? reader_->after(reached.media_s) : reader_->before(reached.media_s);
        if (!next) break;
        reached = std::move(*next);
    }
    jump_to(std::move(reached), now);
    steps_back_ = frames < 0;
}

void Playback::set_looping(bool looping) {
    if (looping == looping_) return;
    looping_ = looping;
    complete_ = false;  // the next read decides it again
    if (looping) return;
    // Drops frames of the next loop, unless the surface is already moving towards one.
    for (std::size_t k = 2; k < frames_.size(); ++k) {
        if (frames_[k].media_s > frames_[k - 1].media_s) continue;
        frames_.resize(k);
        offset_s_ = frames_.back().time_s - frames_.back().media_s;
    }
}

void Playback::set_part(const std::optional<MediaPart>& part) {
    if (part == part_) return;
    part_ = part;
    beyond_part_ = false;  // also where its end was passed while it was being set
    complete_ = false;     // the next read decides it again
    drop_frames_ahead();
}

void Playback::set_speed(double speed, Time now) {
    speed_ = speed > kSlowestSpeed ? std::min(speed, kFastestSpeed) : kSlowestSpeed;
    update_plan(now);
}

void Playback::set_cleaning(const CleaningOptions& options) {
    if (options == cleaning_) return;
    degradation_ = {};
    drawing_rate_ = {};
    if (is_open()) {
        forget_costs();
        reader_->set_degradation(0);
        reader_->set_cleaning(options);
        try {
            clean_again();
        } catch (...) {
            reader_->set_cleaning(cleaning_);
            throw;
        }
    }
    cleaning_ = options;
}

void Playback::set_motion(const MotionRequest& wanted) {
    const bool other_surface = wanted.in_betweens != motion_request_.in_betweens;
    motion_request_ = wanted;
    if (!is_open()) return;
    reader_->set_motion(wanted);
    if (other_surface && update_in_betweens(wanted.in_betweens)) ++discontinuity_;
}

/// Adds or removes in-betweens of the present frames. Whether any changed.
bool Playback::update_in_betweens(bool wanted) {
    bool changed = false;
    for (std::size_t k = 0; k + 1 < frames_.size(); ++k) {
        const bool had = frames_[k].in_betweens != nullptr;
        if (wanted)
            reader_->connect(frames_[k], frames_[k + 1]);
        else
            frames_[k].in_betweens.reset();
        changed = changed || had != (frames_[k].in_betweens != nullptr);
    }
    return changed;
}

void Playback::set_maps(const std::shared_ptr<const TouchMaps>& maps) {
    if (!is_open()) return;
    reader_->set_maps(maps);
    for (Frame& frame : frames_) frame.maps = maps;
}

/// Cleans all present frames again, or none.
void Playback::clean_again() {
    prepared_before_s_.reset();
    if (seek_target_s_) return;  // the target of the seek will be cleaned so
    std::deque<Frame> cleaned;
    for (const Frame& frame : frames_) {
        auto again = reader_->at(frame.media_s);
        if (!again) {
            throw InputError("the video cannot be read again at " + short_text(frame.media_s) +
                             " s: open it again");
        }
        again->time_s = frame.time_s;
        if (!cleaned.empty()) reader_->connect(cleaned.back(), *again);
        cleaned.push_back(std::move(*again));
    }
    frames_ = std::move(cleaned);
    ++discontinuity_;  // the surface changes at once
}

/// Frames that were cleaned at another level, here or in the reader.
bool Playback::holds_other_steps() const {
    if (is_preview_) return false;  // it will be replaced
    return reader_->is_mixed() ||
           std::any_of(frames_.begin(), frames_.end(),
                       [this](const Frame& frame) { return !is_of_plan(frame); });
}

/// While playing, from the next frame on. At rest there is time for all steps, also of the present
/// frames.
void Playback::apply_degradation() {
    const std::size_t level = playing_ ? degradation_.level() : 0;
    if (level == reader_->degradation() && (playing_ || !holds_other_steps())) return;
    forget_costs();
    if (playing_) return reader_->degrade_next(level);
    reader_->set_degradation(level);
    drop_frames_ahead();
    try {
        clean_again();
    } catch (const InputError&) {  // the frames stay as they are
    }
}

/// But for the one that the surface moves towards.
void Playback::drop_frames_ahead() {
    if (frames_.size() <= 2) return;
    frames_.resize(2);
    offset_s_ = frames_.back().time_s - frames_.back().media_s;
    complete_ = false;  // the next read decides it again
}

bool Playback::advance(Time now) {
    if (!playing_) return false;
    const double playback_s = clock_.playback_s(now);
    bool changed = false;
    while (frames_.size() > 1 && frames_[1].time_s <= playback_s) {
        if (!(frames_[0].cleaning == frames_[1].cleaning)) ++discontinuity_;
        frames_.pop_front();
        changed = true;
        if (at_seam()) ++discontinuity_;
    }
    if (complete_ && frames_.size() == 1) {
        playing_ = false;
        anchor(frames_.front().time_s, now);
        apply_degradation();
        changed = true;
    }
    return changed;
}

bool Playback::needs_frame() const {
    if (!is_open()) return false;
    // Of large pictures the shown frame, the next one, and one that is ready.
    const bool large = description().depth_pixels() > kLarge;
    const std::size_t most = large ? FrameWindow::kFrames - 1 : FrameWindow::kFrames;
    return seek_target_s_ || (!complete_ && frames_.size() < most);
}

bool Playback::read_ahead(Time now) {
    reading_since_ = now;
    waited_before_s_ = reader_->waited_s();
    extra_before_s_ = reader_->extra_s();
    return seek_target_s_ ? read_seek_target(now) : read_next(now);
}

bool Playback::read_next(Time now) {
    const Frame& newest = frames_.back();
    const std::int64_t skipped_frames = reader_->skipped_frames();
    auto next = reader_->after(newest.media_s, pace(now));
    if (lap_ends_before(next)) {
        const double lasts_s =
            next ? next->media_s - newest.media_s : reader_->last_interval_s(newest.media_s);
        const double begins_s = lap_begins_s();
        next.reset();
        if (looping_ && newest.media_s > begins_s) next = reader_->at(begins_s);
        if (next) offset_s_ += newest.media_s + lasts_s - next->media_s;
        beyond_part_ = false;
    }
    complete_ = !next;
    if (!next) return false;
    const auto passed = static_cast<double>(reader_->skipped_frames() - skipped_frames);
    skipped_frames_ = moving_mean(skipped_frames_, passed, kNewestWeight);
    read_frames_ = passed + 1.0;
    next->time_s = std::max(next->media_s + offset_s_, newest.time_s + kJump_s);
    if (next->cleaning == frames_.back().cleaning) reader_->connect(frames_.back(), *next);
    frames_.push_back(std::move(*next));
    if (frames_.size() == 2 && at_seam()) ++discontinuity_;
    return true;
}

bool Playback::in_part() const {
    return part_ && !beyond_part_;
}

/// Whether the loop ends here: at the end of the media, or of the part.
bool Playback::lap_ends_before(const std::optional<Frame>& next) const {
    return !next || (in_part() && next->media_s > part_->to_s);
}

/// Behind the part it is the media's own begin.
double Playback::lap_begins_s() const {
    return in_part() ? part_->from_s : first_media_s_;
}

/// The next frame of the plan; while frames are late, the first that is in time.
Pace Playback::pace(Time now) const {
    if (!playing_ || starts_) return {};
    const double spacing_s = plan_.every > 1.0 ? plan_.every * interval_s() : 0.0;
    const double next_s = next_shown_s(frames_.back().media_s, spacing_s);
    return {.earliest_s = std::max(earliest_in_time_s(now) - offset_s_, next_s),
            .spacing_s = spacing_s,
            .time_for_motion = !plan_.overloaded};
}

/// Of the next frame to read, on the playback timeline. Late frames are skipped up to one that is
/// ready early enough for the surface to move to it. A slowed clock waits for them instead.
double Playback::earliest_in_time_s(Time now) const {
    if (clock_is_slowed()) return 0.0;
    const double takes_s = clock_.speed * frame_time_s(costs(), plan_.every);
    const double there_s = clock_.playback_s(now) + takes_s;
    const double next_s = frames_.back().time_s + plan_.every * interval_s();
    return next_s < there_s ? there_s + takes_s : 0.0;
}

void Playback::on_frame_read(Time now) {
    const double took_s = std::chrono::duration<double>(now - reading_since_).count() -
                          (reader_->extra_s() - extra_before_s_);
    const bool is_of_plan = this->is_of_plan(frames_.back());  // else it does not tell its cost
    if (is_of_plan) add_cost(took_s, reader_->waited_s() - waited_before_s_);
    falls_behind_ = waited_ && now - *waited_ < kShownFor;
    if (frames_.size() < 2) return;
    const bool starts = std::exchange(starts_, false);
    if (playing_ && frames_.size() == 2) place_late_frame(starts, now);
    update_plan(now);
    if (playing_ && is_of_plan) degrade();
}

/// The surface moves on from where it was held while frames had run out.
void Playback::place_late_frame(bool starts, Time now) {
    const double moment_s = clock_.playback_s(now);
    Frame& held = frames_.front();
    Frame& next = frames_.back();
    const double late_s = moment_s - (next.media_s + offset_s_);
    const bool waits = late_s > (clock_is_slowed() ? 0.0 : kMostBehind_s);
    if (starts) offset_s_ += moment_s - held.time_s;
    if (waits && !starts)
        offset_s_ += late_s + (clock_is_slowed() ? plan_.every * interval_s() : 0.0);
    next.time_s = std::max(next.time_s, next.media_s + offset_s_);
    if (waits) waited_ = now;
    // The surface does not move towards a frame of another cleaning: that replaces it at once.
    if (!(next.cleaning == held.cleaning)) return;
    held.time_s = std::max(held.time_s, moment_s);
    next.time_s = std::max(next.time_s, held.time_s + std::max(kJump_s, 0.5 * interval_s()));
}

bool Playback::can_prepare_step_back() const {
    return is_open() && !playing_ && steps_back_ && !needs_frame() &&
           prepared_before_s_ != frames_.front().media_s;
}

void Playback::prepare_step_back() {
    prepared_before_s_ = frames_.front().media_s;
    try {
        static_cast<void>(reader_->before(*prepared_before_s_));  // the reader keeps it
    } catch (const InputError&) {                                 // the step itself reports it
    }
}

void Playback::end_here() {
    seek_target_s_.reset();
    complete_ = true;
}

bool Playback::at_seam() const {
    return frames_.size() > 1 && frames_[1].media_s <= frames_[0].media_s;
}

Playback::Time Playback::next_due() const {
    if (!playing_) return Time::max();
    if (frames_.size() < 2) return clock_.anchor;
    const double wait_s = (frames_[1].time_s - clock_.anchor_s) / clock_.speed;
    return clock_.anchor + std::chrono::ceil<Time::duration>(std::chrono::duration<double>(wait_s));
}

FrameWindow Playback::touchable() const {
    FrameWindow window = this->window();
    if (!is_preview_) return window;
    window.frames = {};
    window.count = 0;
    return window;
}

/// Up to the first frame that is cleaned otherwise: no surface blends two cleanings.
FrameWindow Playback::window() const {
    FrameWindow window;
    const auto other = std::find_if(frames_.begin(), frames_.end(), [this](const Frame& frame) {
        return !(frame.cleaning == frames_.front().cleaning);
    });
    const auto alike = static_cast<std::size_t>(std::distance(frames_.begin(), other));
    window.count = std::min(alike, FrameWindow::kFrames);
    std::copy_n(frames_.begin(), window.count, window.frames.begin());
    window.clock = clock_;
    window.discontinuity = discontinuity_;
    return window;
}

}  // namespace dibhr
