// Joins two connections by their stamps, or by when their pictures come.
#include "core/video/live/live_feed.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/media.hpp"

namespace dibhr {

namespace {

using Clock = LiveFeed::Clock;

constexpr std::size_t kStamps = 100;  ///< about three seconds
constexpr double kOtherTime_s = 1.0;  ///< a clock that is so far off was set
/// Clocks that agree so well are one clock: what is between them is the way, not the time.
constexpr double kOneClock_s = 0.25;
constexpr std::size_t kMostColours = 8;
constexpr std::size_t kMostWaiting = 2;
constexpr double kNewest = 0.1;  ///< the weight of the newest of a moving mean
constexpr double kLongestInterval_s = 0.5;
constexpr std::size_t kLongestName = 100;
constexpr std::chrono::milliseconds kUnheard{1500};  ///< what sent no packet since sends none

double seconds_of(Clock::time_point time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}

Clock::duration duration_of(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// A source without stamps has those of its pictures' coming.
void stamp(LivePicture& picture) {
    if (!std::isfinite(picture.stamp_s)) picture.stamp_s = seconds_of(picture.arrived);
}

/// One that is not there need not be waited for.
void require_camera(const LiveName& name, const std::filesystem::path& place) {
    if (name.kind != LiveKind::camera || ::access(name.url.c_str(), R_OK) == 0) return;
    throw InputError(shown(place) + (errno == ENOENT ? " is no camera that is attached: see "
                                                       "v4l2-ctl --list-devices"
                                                     : " may not be read: join the group video"));
}

}  // namespace

void StampLine::add(double stamp_s, double arrived_s) {
    const double later_s = arrived_s - stamp_s;
    if (!later_.empty() && std::fabs(later_s - this->later_s()) > kOtherTime_s) later_.clear();
    later_.push_back(later_s);
    if (later_.size() > kStamps) later_.pop_front();
}

double StampLine::later_s() const {
    return later_.empty() ? 0.0 : *std::min_element(later_.begin(), later_.end());
}

LiveFeed::LiveFeed(std::filesystem::path colour, std::filesystem::path depth)
    : colour_(std::move(colour)),
      depth_(std::move(depth)),
      two_(!colour_.empty() && colour_ != depth_) {
    LiveName depth_name = live_name(depth_);
    require_camera(depth_name, depth_);
    if (two_) {
        require_camera(live_name(colour_), colour_);
        colour_stream_ = std::make_unique<LiveStream>(
            live_name(colour_), in_quotes(public_name(colour_), kLongestName),
            [this](LivePicture picture) { return take_colour(std::move(picture)); },
            [this] { take_refusal(); });
        colour_stream_->want(true, false);
    }
    depth_stream_ = std::make_unique<LiveStream>(
        std::move(depth_name), in_quotes(public_name(depth_), kLongestName),
        [this](LivePicture picture) { return take_depth(std::move(picture)); },
        [this] { take_refusal(); });
}

LiveFeed::~LiveFeed() {
    depth_stream_.reset();
    colour_stream_.reset();
}

bool LiveFeed::is_of(const std::filesystem::path& colour,
                     const std::filesystem::path& depth) const {
    const std::filesystem::path& only = depth.empty() ? colour : depth;
    return only == depth_ && (two_ ? colour == colour_ : colour.empty() || colour == only);
}

void LiveFeed::want(bool colour, bool levels) {
    depth_stream_->want(colour, levels);
}

bool LiveFeed::is_of_form(const LivePicture& picture, std::optional<Form>& first) {
    const cv::Mat& any = picture.levels.empty() ? picture.colour : picture.levels;
    const Form form{any.size(), picture.bits, picture.grey};
    if (!first) first = form;
    signal_.other_form = signal_.other_form || !(*first == form);
    return !signal_.other_form;
}

bool LiveFeed::take_depth(LivePicture picture) {
    const Clock::time_point now = Clock::now();
    stamp(picture);
    {
        const std::lock_guard lock(mutex_);
        if (!is_of_form(picture, depth_form_)) {
            came_.notify_all();
            return false;
        }
        const double since_s = std::chrono::duration<double>(now - signal_.last).count();
        if (signal_.last != Clock::time_point{} && since_s < kLongestInterval_s)
            interval_s_ += kNewest * (since_s - interval_s_);
        signal_.last = now;
        signal_.refused = false;
        depth_line_.add(picture.stamp_s, seconds_of(picture.arrived));
        if (two_) {
            waiting_.push_back(std::move(picture));
            if (waiting_.size() > kMostWaiting) waiting_.pop_front();
            join(now);
        } else {
            LivePair pair{.depth = std::move(picture)};
            pair.colour = pair.depth;
            hand_out(std::move(pair));
        }
    }
    const std::lock_guard lock(telling_);
    if (news_) news_();
    return true;
}

bool LiveFeed::take_colour(LivePicture picture) {
    stamp(picture);
    {
        const std::lock_guard lock(mutex_);
        if (!is_of_form(picture, colour_form_)) {
            came_.notify_all();
            return false;
        }
        colour_line_.add(picture.stamp_s, seconds_of(picture.arrived));
        colours_.push_back(std::move(picture));
        if (colours_.size() > kMostColours) colours_.pop_front();
        join(Clock::now());
    }
    const std::lock_guard lock(telling_);
    if (news_) news_();
    return true;
}

void LiveFeed::take_refusal() {
    const std::lock_guard lock(mutex_);
    signal_.refused = true;
    came_.notify_all();
}

/// When a colour picture was taken, by the depth's clock.
double LiveFeed::colour_s(const LivePicture& picture) const {
    const double apart_s = colour_line_.later_s() - depth_line_.later_s();
    return picture.stamp_s + (std::fabs(apart_s) < kOneClock_s ? 0.0 : apart_s);
}

const LivePicture* LiveFeed::nearest_colour(double depth_s) const {
    const auto nearest = std::min_element(
        colours_.begin(), colours_.end(), [&](const LivePicture& a, const LivePicture& b) {
            return std::fabs(colour_s(a) - depth_s) < std::fabs(colour_s(b) - depth_s);
        });
    return nearest == colours_.end() ? nullptr : &*nearest;
}

/// Whether no nearer colour is to be waited for: half an interval at most.
bool LiveFeed::may_go(const LivePicture& depth, Clock::time_point now) const {
    const double half_s = 0.5 * interval_s_;
    const bool waited = now >= depth.arrived + duration_of(half_s);
    return waited || (!colours_.empty() && colour_s(colours_.back()) >= depth.stamp_s - half_s);
}

/// Of those that may go only the newest is looked at.
void LiveFeed::join(Clock::time_point now) {
    std::optional<LivePicture> depth;
    while (!waiting_.empty() && may_go(waiting_.front(), now)) {
        depth = std::move(waiting_.front());
        waiting_.pop_front();
    }
    const LivePicture* const colour = depth ? nearest_colour(depth->stamp_s) : nullptr;
    if (colour == nullptr) return;  // before the first colour nothing is shown
    LivePair pair{.depth = std::move(*depth), .colour = *colour};
    hand_out(std::move(pair));
}

void LiveFeed::hand_out(LivePair pair) {
    pair.number = newest_ ? newest_->number + 1 : 1;
    newest_ = std::make_shared<const LivePair>(std::move(pair));
    came_.notify_all();
}

std::shared_ptr<const LivePair> LiveFeed::after(std::uint64_t number, Clock::time_point latest) {
    std::unique_lock lock(mutex_);
    for (;;) {
        join(Clock::now());
        if (newest_ && newest_->number > number) return newest_;
        if (Clock::now() >= latest || signal_.other_form || signal_.refused) return nullptr;
        Clock::time_point until = latest;
        if (!waiting_.empty())
            until = std::min(until, waiting_.front().arrived + duration_of(0.5 * interval_s_));
        came_.wait_until(lock, until);
    }
}

std::optional<Clock::time_point> LiveFeed::due() const {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty() || colours_.empty()) return std::nullopt;
    return waiting_.front().arrived + duration_of(0.5 * interval_s_);
}

LiveSignal LiveFeed::signal() const {
    LiveSignal signal;
    {
        const std::lock_guard lock(mutex_);
        signal = signal_;
    }
    signal.trouble = depth_stream_->trouble();
    if (signal.trouble.empty() && colour_stream_) signal.trouble = colour_stream_->trouble();
    signal.heard = Clock::now() - depth_stream_->heard() < kUnheard;
    return signal;
}

void LiveFeed::tell(std::function<void()> news) {
    const std::lock_guard lock(telling_);
    news_ = std::move(news);
}

}  // namespace dibhr
