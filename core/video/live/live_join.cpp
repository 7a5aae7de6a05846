// Joins by stamps; of clocks with another zero, by the smallest delay from stamp to arrival.
#include "core/video/live/live_join.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/realtime/now.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kStamps = 100;  ///< about three seconds
constexpr double kClockSet_s = 1.0;   ///< a clock so far off was set
/// Clocks that agree so well count as one: the difference is the network's delay.
constexpr double kSameClock_s = 0.25;
/// A picture with so much less delay than all before belongs to a backlog.
constexpr double kBacklog_s = 0.005;
constexpr std::chrono::seconds kLongestBacklog{2};
constexpr std::size_t kMostColours = 8;
constexpr std::size_t kMostWaiting = 2;

}  // namespace

void ClockOffset::add(double stamp_s, double arrived_s) {
    const double offset_s = arrived_s - stamp_s;
    if (!offsets_.empty() && std::fabs(offset_s - this->offset_s()) > kClockSet_s) offsets_.clear();
    catches_up_ = offsets_.empty() || offset_s < this->offset_s() - kBacklog_s;
    offsets_.push_back(offset_s);
    if (offsets_.size() > kStamps) offsets_.pop_front();
}

double ClockOffset::offset_s() const {
    return offsets_.empty() ? 0.0 : *std::min_element(offsets_.begin(), offsets_.end());
}

void LiveJoin::add_depth(LivePicture picture) {
    depth_offset_.add(picture.stamp_s, seconds_of(picture.arrived));
    if (!first_depth_) first_depth_ = picture.arrived;
    waiting_.push_back(std::move(picture));
    if (waiting_.size() > kMostWaiting) waiting_.pop_front();
}

void LiveJoin::add_colour(LivePicture picture) {
    colour_offset_.add(picture.stamp_s, seconds_of(picture.arrived));
    colours_.push_back(std::move(picture));
    if (colours_.size() > kMostColours) colours_.pop_front();
}

/// The time of a colour picture by the clock of the depth.
double LiveJoin::colour_s(const LivePicture& picture) const {
    const double apart_s = colour_offset_.offset_s() - depth_offset_.offset_s();
    return picture.stamp_s + (std::fabs(apart_s) < kSameClock_s ? 0.0 : apart_s);
}

const LivePicture* LiveJoin::nearest_colour(double depth_s) const {
    const auto nearest = std::min_element(
        colours_.begin(), colours_.end(), [&](const LivePicture& a, const LivePicture& b) {
            return std::fabs(colour_s(a) - depth_s) < std::fabs(colour_s(b) - depth_s);
        });
    return nearest == colours_.end() ? nullptr : &*nearest;
}

/// Whether the depth picture need not wait for a nearer colour.
bool LiveJoin::is_ready(const LivePicture& depth, Time now) const {
    const double half_s = 0.5 * interval_s_;
    const bool waited = now - depth.arrived >= std::chrono::duration<double>(half_s);
    return waited || (!colours_.empty() && colour_s(colours_.back()) >= depth.stamp_s - half_s);
}

/// While a connection opens, its pictures form a backlog. Their arrival says nothing about the
/// delay, and colour of the first ones may be missing.
bool LiveJoin::backlog_is_over(Time now) {
    backlog_over_ = backlog_over_ || now - *first_depth_ > kLongestBacklog ||
                    !(depth_offset_.catches_up() || colour_offset_.catches_up());
    return backlog_over_;
}

std::optional<LivePair> LiveJoin::take(Time now) {
    std::optional<LivePicture> depth;
    while (!waiting_.empty() && is_ready(waiting_.front(), now)) {
        depth = std::move(waiting_.front());
        waiting_.pop_front();
    }
    if (!depth || !backlog_is_over(now)) return std::nullopt;
    const LivePicture* const colour = nearest_colour(depth->stamp_s);
    if (colour == nullptr) return std::nullopt;
    return LivePair{.depth = std::move(*depth), .colour = *colour};
}

std::optional<LiveJoin::Time> LiveJoin::due() const {
    if (waiting_.empty() || colours_.empty()) return std::nullopt;
    return waiting_.front().arrived +
           std::chrono::ceil<Time::duration>(std::chrono::duration<double>(0.5 * interval_s_));
}

}  // namespace dibhr
