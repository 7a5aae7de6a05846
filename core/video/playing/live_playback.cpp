// Turns the pictures of a feed into a window of frames.
#include "core/video/playing/live_playback.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/realtime/moving_mean.hpp"
#include "core/video/live/live_name.hpp"

namespace dibhr {

namespace {

using Time = LivePlayback::Time;

constexpr double kShortestSilence_s = 0.15;
constexpr double kLongestSilence_s = 0.25;  ///< but for slow cameras at least so many intervals:
constexpr double kSlowIntervals = 1.5;
constexpr double kLostIntervals = 3.0;
constexpr std::chrono::seconds kRecentMotion{1};
constexpr float kMoved = 0.01F;  ///< of the highest level, or more than the noise
constexpr float kMovedNoise = 5.0F;
constexpr std::size_t kMovedPart = 500;  ///< one pixel in so many has moved
constexpr std::size_t kCompared = 7;     ///< one pixel in so many is compared
constexpr std::chrono::milliseconds kStatusInterval{500};
constexpr double kMilliseconds = 1000.0;
constexpr std::uint64_t kLiveDiscontinuities = std::uint64_t{1} << 32;  ///< higher than any file's

std::chrono::steady_clock::duration duration_of(double seconds) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(seconds));
}

double seconds_between(Time from, Time to) {
    return std::chrono::duration<double>(to - from).count();
}

/// As a file with time stamps in milliseconds returns it.
double rounded_to_ms(double time_s) {
    return static_cast<double>(std::llround(kMilliseconds * time_s)) * (1.0 / kMilliseconds);
}

bool differ(const DepthImage& a, const DepthImage& b, float by) {
    if (a.levels.size() != b.levels.size()) return true;
    std::size_t moved = 0;
    for (std::size_t k = 0; k < a.levels.size(); k += kCompared)
        moved += static_cast<std::size_t>(std::fabs(a.levels[k] - b.levels[k]) > by);
    return moved * kCompared * kMovedPart > a.levels.size();
}

}  // namespace

std::string signal_in_words(const LiveStatus& live) {
    const std::string from = in_quotes(live.from, 60);
    if (live.format_changed) return from + " changed: opening it again";
    return (live.signal ? "Signal from " : "No signal from ") + from;
}

std::string in_words(const LiveStatus& live) {
    if (live.signal) return number_text(kMilliseconds * live.behind_s, 0) + " ms behind";
    std::string words = signal_in_words(live);
    if (live.permanent_error && !live.trouble.empty())
        words = live.trouble;
    else if (!live.format_changed)
        words += " for " + number_text(live.silent_s, 0) + " s: waiting";
    return words + (live.force_off ? ", the force is off" : "");
}

void LivePlayback::open(std::unique_ptr<Media> media, std::uint32_t number,
                        std::shared_ptr<const TouchMaps> maps, std::function<void()> listener) {
    close();
    media_ = std::move(media);
    feed_ = media_->live();
    opened_ = number;
    assembly_.set_number(number);
    assembly_.set_maps(std::move(maps));
    playing_ = true;
    clock_.restart();
    feed_->set_listener(std::move(listener));
}

void LivePlayback::close() {
    if (feed_) feed_->set_listener({});
    feed_.reset();
    media_.reset();
    sink_ = {};
    frames_.clear();
    memory_.forget();
    meter_ = {};
    measured_ = 0;
    noise_.reset();
    last_ = {};
    taken_ = 0;
    file_begin_s_.reset();
    dropped_ = 0;
    behind_s_ = 0.0;
    assembly_.forget_motion_pauses();
    lost_ = force_off_ = false;
    ++discontinuity_;
}

void LivePlayback::play() {
    if (std::exchange(playing_, true)) return;
    clock_.restart();
}

void LivePlayback::pause(Time now) {
    if (std::exchange(playing_, false)) clock_.stop(now);
}

/// Cleans the last frame again at once.
void LivePlayback::set_cleaning(const CleaningOptions& options, Time now) {
    if (options == options_) return;
    options_ = options;
    if (!is_open() || frames_.empty()) return;
    make_plan();
    show_again(now);
}

void LivePlayback::show_again(Time now) {
    clock_.restart();
    show(cleaned_frame(last_), now);
    if (!playing_) clock_.stop(now);
}

void LivePlayback::set_maps(std::shared_ptr<const TouchMaps> maps) {
    for (Frame& frame : frames_) frame.maps = maps;
    assembly_.set_maps(std::move(maps));
}

void LivePlayback::record(std::uint32_t number, LiveSink sink, Time now) {
    sink_ = std::move(sink);
    if (!sink_) return;
    assembly_.set_number(number);
    file_begin_s_.reset();
    memory_.forget();
    if (frames_.empty()) return;
    file_begin_s_ = last_stamp_s_;
    last_.media_s = 0.0;
    last_.held.clear();
    if (!last_.never_has_holes) last_.held = memory_.take(last_.depth, last_.media_s);
    send_to_sink(last_);
    show_again(now);
}

bool LivePlayback::take(Time now) {
    bool changed = false;
    const double moment_s = clock_.clock().playback_s(now);
    while (playing_ && frames_.size() > 1 && frames_[1].time_s <= moment_s) {
        frames_.pop_front();
        changed = true;
    }
    const bool wants = playing_ || frames_.empty();
    if (wants && feed_->after(taken_, now)) changed = take_frame(now) || changed;
    return watch_signal(now_()) || changed;
}

/// False also where the pictures have changed their format: the signal is then lost.
bool LivePlayback::take_frame(Time now) {
    std::optional<RawFrame> raw = media_->next();
    if (!raw || !raw->taken) return false;
    const std::uint64_t number = raw->taken->pair->number;
    if (taken_ > 0) dropped_ += static_cast<std::int64_t>(number - taken_ - 1);
    taken_ = number;
    if (measure_noise(*raw)) return false;
    const double stamp_s = raw->media_s;
    if (!file_begin_s_) file_begin_s_ = stamp_s;
    raw->media_s = rounded_to_ms(stamp_s - *file_begin_s_);
    if (!frames_.empty() && frames_.back().media == assembly_.number() &&
        raw->media_s <= frames_.back().media_s)
        raw->media_s = rounded_to_ms(frames_.back().media_s + 1.0 / kMilliseconds);
    if (!raw->never_has_holes) raw->held = memory_.take(raw->depth, raw->media_s);
    last_stamp_s_ = stamp_s;
    last_ = std::move(*raw);
    send_to_sink(last_);
    if (std::exchange(lost_, false)) clock_.restart();
    force_off_ = false;
    const Time begin = now_();
    Frame frame = cleaned_frame(last_);
    connect(frame, begin);
    show(std::move(frame), now);
    if (!playing_) clock_.stop(now);
    return true;
}

/// True: the cleaning depends on the noise, and more frames must be measured before one is shown.
bool LivePlayback::measure_noise(const RawFrame& raw) {
    if (noise_) return false;
    meter_.add(raw.depth);
    if (++measured_ >= NoiseMeter::kEnoughFrames) noise_ = meter_.noise();
    if (!noise_ && needs_noise(options_)) return true;
    make_plan();
    return false;
}

void LivePlayback::make_plan() {
    CleaningPlan plan =
        plan_of(options_, noise_.value_or(DepthNoise{}), description().depth_pixels(),
                description().sparse_share.has_value());
    plan.steps.steady = false;  // needs frames that are still to come
    assembly_.set_plan(plan);
}

Frame LivePlayback::cleaned_frame(const RawFrame& raw) {
    const auto begin = now_();
    Frame frame = assembly_.finish_single_frame(raw);
    clean_ms_ = kMilliseconds * seconds_between(begin, now_());
    return frame;
}

/// Computes the motion from the last frame to `next`, whose cleaning started at `begin`.
void LivePlayback::connect(const Frame& next, Time begin) {
    if (!assembly_.motion().any() || !clock_.continues_with(last_stamp_s_, frames_)) return;
    assembly_.connect(frames_.back(), next, true);
    assembly_.add_cost(seconds_between(begin, now_()), clock_.interval_s());
}

void LivePlayback::show(Frame frame, Time now) {
    detect_motion(frame, now);
    const Time ready = now_();
    if (clock_.add(std::move(frame), last_stamp_s_, ready, frames_)) ++discontinuity_;
    const double ahead_s = frames_.back().time_s - clock_.clock().playback_s(ready);
    const double behind_s =
        std::max(ahead_s, 0.0) + seconds_between(last_.taken->pair->depth.arrived, ready);
    behind_s_ = moving_mean_from_first(behind_s_, behind_s);
}

void LivePlayback::send_to_sink(const RawFrame& raw) {
    if (!sink_) return;
    sink_({raw.taken, std::llround(kMilliseconds * raw.media_s), noise_.value_or(DepthNoise{})});
}

void LivePlayback::detect_motion(const Frame& frame, Time now) {
    const float noise = kMovedNoise * assembly_.plan().noise.at(0.5F);
    const float by = std::max(kMoved, noise) * static_cast<float>(frame.depth->highest_level);
    if (!frames_.empty() && differ(*frames_.back().depth, *frame.depth, by)) moved_at_ = now;
}

/// When the signal counts as lost unless a frame arrives.
Time LivePlayback::lost_at() const {
    const double interval_s = clock_.interval_s();
    const double longest_s = std::max(kLongestSilence_s, kSlowIntervals * interval_s);
    const double silence_s = std::clamp(kLostIntervals * interval_s, kShortestSilence_s, longest_s);
    return feed_->signal().last + duration_of(silence_s);
}

/// Switches the force off where the surface moved just before: it is no longer where it is held.
bool LivePlayback::watch_signal(Time now) {
    const bool lost = !frames_.empty() && playing_ && now >= lost_at();
    if (!lost) return false;
    if (std::exchange(lost_, true)) {
        const bool again = now >= status_at_ + kStatusInterval;
        if (again) status_at_ = now;
        return again;
    }
    status_at_ = now;
    force_off_ = feed_->signal().last - moved_at_ < kRecentMotion;
    return true;
}

Time LivePlayback::next_due(Time now) const {
    if (!playing_ && !frames_.empty()) return Time::max();
    Time due = lost_             ? status_at_ + kStatusInterval
               : frames_.empty() ? now + kStatusInterval
                                 : lost_at();
    if (const auto pair_due = feed_->due()) due = std::min(due, *pair_due);
    const PlaybackClock& clock = clock_.clock();
    if (frames_.size() > 1 && clock.speed > 0.0) {
        const double wait_s = (frames_[1].time_s - clock.anchor_s) / clock.speed;
        due = std::min(due, clock.anchor + duration_of(wait_s) + std::chrono::microseconds(100));
    }
    return due;
}

FrameWindow LivePlayback::window() const {
    FrameWindow window;
    window.count = std::min(frames_.size(), FrameWindow::kFrames);
    std::copy_n(frames_.begin(), window.count, window.frames.begin());
    window.clock = clock_.clock();
    window.discontinuity = kLiveDiscontinuities + discontinuity_;
    window.silent = force_off_;
    return window;
}

LiveStatus LivePlayback::status(Time now) const {
    const LiveSignal signal = feed_->signal();
    LiveStatus status;
    status.from = shown_source(description().depth_path);
    status.behind_s = behind_s_;
    status.dropped = dropped_;
    status.arrives_per_s = frames_.size() > 1 ? 1.0 / clock_.interval_s() : 0.0;
    status.signal = !lost_ && !signal.format_changed;
    status.silent_s = lost_ ? seconds_between(signal.last, now) : 0.0;
    status.force_off = force_off_;
    status.format_changed = signal.format_changed;
    status.trouble = signal.trouble;
    status.permanent_error = signal.permanent_error;
    status.opened = opened_;
    status.media = frames_.empty() ? 0 : frames_.front().media;
    const MotionThrottle& throttle = assembly_.throttle();
    status.motion_paused = assembly_.motion().motion && throttle.motion_paused();
    status.in_betweens_paused = assembly_.motion().in_betweens &&
                                (throttle.in_betweens_paused() || throttle.motion_paused());
    status.noise = noise_.value_or(DepthNoise{});
    return status;
}

std::string LivePlayback::cleaning_in_words() const {
    const CleaningPlan whole =
        plan_of(options_, assembly_.plan().noise, description().depth_pixels(),
                description().sparse_share.has_value());
    return in_words(options_, whole) + (whole.steps.steady ? "; live: no filter in time" : "");
}

}  // namespace dibhr
