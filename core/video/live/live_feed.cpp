// Joins two connections by their stamps, or by the arrival of their pictures.
#include "core/video/live/live_feed.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/realtime/moving_mean.hpp"
#include "core/realtime/now.hpp"

namespace dibhr {

namespace {

using Clock = LiveFeed::Clock;

constexpr double kLongestInterval_s = 0.5;
constexpr std::size_t kLongestName = 100;
constexpr std::chrono::milliseconds kNoPackets{
    1500};  ///< without a packet for so long, none arrive

/// Pictures without a stamp get the time of their arrival.
void stamp(LivePicture& picture) {
    if (!std::isfinite(picture.stamp_s)) picture.stamp_s = seconds_of(picture.arrived);
}

/// Refuses a camera that is not attached: waiting does not help.
void require_camera(const LiveName& name, const std::filesystem::path& place) {
    if (name.kind != LiveKind::camera || ::access(name.url.c_str(), R_OK) == 0) return;
    throw InputError(shown(place) + (errno == ENOENT ? " is no camera that is attached: see "
                                                       "v4l2-ctl --list-devices"
                                                     : " may not be read: join the group video"));
}

}  // namespace

LiveFeed::LiveFeed(std::filesystem::path colour, std::filesystem::path depth, Now now)
    : colour_(std::move(colour)),
      depth_(std::move(depth)),
      two_streams_(!colour_.empty() && colour_ != depth_),
      now_(std::move(now)) {
    LiveName depth_name = live_name(depth_);
    require_camera(depth_name, depth_);
    if (two_streams_) {
        require_camera(live_name(colour_), colour_);
        colour_stream_ = std::make_unique<LiveStream>(
            live_name(colour_), in_quotes(shown_source(colour_), kLongestName),
            [this](LivePicture picture) { return take(std::move(picture), Role::colour); },
            [this] { take_permanent_error(); });
        colour_stream_->set_outputs(true, false);
    }
    depth_stream_ = std::make_unique<LiveStream>(
        std::move(depth_name), in_quotes(shown_source(depth_), kLongestName),
        [this](LivePicture picture) { return take(std::move(picture), Role::depth); },
        [this] { take_permanent_error(); });
}

LiveFeed::~LiveFeed() {
    depth_stream_.reset();
    colour_stream_.reset();
}

bool LiveFeed::is_of(const std::filesystem::path& colour,
                     const std::filesystem::path& depth) const {
    const std::filesystem::path& only = depth.empty() ? colour : depth;
    return only == depth_ && (two_streams_ ? colour == colour_ : colour.empty() || colour == only);
}

void LiveFeed::set_outputs(bool colour, bool levels) {
    depth_stream_->set_outputs(colour, levels);
}

bool LiveFeed::has_first_format(const LivePicture& picture, std::optional<Form>& first) {
    const cv::Mat& any = picture.levels.empty() ? picture.colour : picture.levels;
    const Form form{any.size(), picture.bits, picture.grey};
    if (!first) first = form;
    signal_.format_changed = signal_.format_changed || !(*first == form);
    return !signal_.format_changed;
}

bool LiveFeed::take(LivePicture picture, Role role) {
    const Clock::time_point now = now_();
    const bool is_depth = role == Role::depth;
    stamp(picture);
    {
        const std::lock_guard lock(mutex_);
        changed_.notify_all();  // a pair may be due, or none will come
        if (!has_first_format(picture, is_depth ? depth_form_ : colour_form_)) return false;
        if (is_depth) update_signal(now);
        if (!two_streams_) {
            LivePair pair{.depth = std::move(picture)};
            pair.colour = pair.depth;
            publish(std::move(pair));
        } else {
            is_depth ? join_.add_depth(std::move(picture)) : join_.add_colour(std::move(picture));
            join(now);
        }
    }
    const std::lock_guard lock(listener_mutex_);
    if (listener_) listener_();
    return true;
}

void LiveFeed::update_signal(Clock::time_point now) {
    const double since_s = std::chrono::duration<double>(now - signal_.last).count();
    if (signal_.last != Clock::time_point{} && since_s < kLongestInterval_s)
        interval_s_ = moving_mean(interval_s_, since_s);
    signal_.last = now;
    signal_.permanent_error = false;
    join_.set_interval(interval_s_);
}

void LiveFeed::take_permanent_error() {
    const std::lock_guard lock(mutex_);
    signal_.permanent_error = true;
    changed_.notify_all();
}

void LiveFeed::join(Clock::time_point now) {
    if (auto pair = join_.take(now)) publish(std::move(*pair));
}

void LiveFeed::publish(LivePair pair) {
    pair.number = newest_ ? newest_->number + 1 : 1;
    newest_ = std::make_shared<const LivePair>(std::move(pair));
    changed_.notify_all();
}

std::shared_ptr<const LivePair> LiveFeed::after(std::uint64_t number, Clock::time_point latest) {
    std::unique_lock lock(mutex_);
    for (;;) {
        join(now_());
        if (newest_ && newest_->number > number) return newest_;
        if (now_() >= latest || signal_.format_changed || signal_.permanent_error) return nullptr;
        changed_.wait_until(lock, std::min(latest, join_.due().value_or(latest)));
    }
}

std::optional<Clock::time_point> LiveFeed::due() const {
    const std::lock_guard lock(mutex_);
    return join_.due();
}

LiveSignal LiveFeed::signal() const {
    LiveSignal signal;
    {
        const std::lock_guard lock(mutex_);
        signal = signal_;
    }
    signal.trouble = depth_stream_->trouble();
    if (signal.trouble.empty() && colour_stream_) signal.trouble = colour_stream_->trouble();
    signal.packet_received = now_() - depth_stream_->packet_received() < kNoPackets;
    return signal;
}

void LiveFeed::set_listener(std::function<void()> listener) {
    const std::lock_guard lock(listener_mutex_);
    listener_ = std::move(listener);
}

}  // namespace dibhr
