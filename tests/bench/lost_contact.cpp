// Runs the second finger, on data alone, and finds what the data did during a loss of contact.
#include "tests/bench/lost_contact.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/video/cleaning/holes/depth_memory.hpp"
#include "tests/support/pressing_finger.hpp"

namespace dibhr::bench {

namespace {

using test::kFingerTick_s;
using test::kPressed_px;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// What comes back within half of it is up for most of it.
constexpr double kStays_s = 0.5;
constexpr std::size_t kLeastFrames = 3;  ///< of slow recordings
constexpr std::size_t kLeastData = 2;    ///< of those frames
constexpr double kShortGap_s = kHold_s;
constexpr int kAround_px = 2;
constexpr double kFar_px = kPressed_px / 2.0;  ///< no small difference to a finger

/// Milliseconds from `begin` up to `end`.
struct Loss {
    std::size_t begin{0};
    std::size_t end{0};
};

std::vector<Loss> losses_in(std::span<const char> contact) {
    std::vector<Loss> losses;
    for (std::size_t k = 0; k < contact.size(); ++k) {
        if (contact[k] != 0) continue;
        if (k == 0 || contact[k - 1] != 0) losses.push_back({k, k});
        losses.back().end = k + 1;
    }
    return losses;
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Nothing where there is too little.
std::optional<double> median_of_data(std::span<const double> values) {
    std::vector<double> data;
    std::copy_if(values.begin(), values.end(), std::back_inserter(data),
                 [](double value) { return !std::isnan(value); });
    if (data.size() < kLeastData) return std::nullopt;
    return median_of(std::move(data));
}

/// One pixel's data over the frames.
class PixelData {
  public:
    PixelData(std::span<const Frame> frames, std::span<const DepthImage> raw, Spot spot,
              double relief_px)
        : raw_(raw), spot_(spot), relief_px_(relief_px) {
        for (std::size_t k = 0; k < raw.size(); ++k) {
            times_s_.push_back(frames[k].time_s - frames.front().time_s);
            px_.push_back(elevation_px(raw[k], spot.i, spot.j));
            felt_px_.push_back(elevation_px(*frames[k].depth, spot.i, spot.j));
        }
    }

    [[nodiscard]] bool any() const {
        return std::any_of(px_.begin(), px_.end(), [](double px) { return !std::isnan(px); });
    }

    /// Its gaps bridged, one value a millisecond. There must be some data.
    [[nodiscard]] std::vector<double> bridged_px(std::size_t milliseconds) const {
        std::vector<double> series;
        std::size_t next = next_data(0);
        std::size_t last = next;
        for (std::size_t k = 0; k < milliseconds; ++k) {
            const double t_s = static_cast<double>(k) * kFingerTick_s;
            while (next < px_.size() && times_s_[next] <= t_s) {
                last = next;
                next = next_data(next + 1);
            }
            const bool between = next < px_.size() && next != last;
            const double share =
                between ? (t_s - times_s_[last]) / (times_s_[next] - times_s_[last]) : 0.0;
            series.push_back(between ? px_[last] + share * (px_[next] - px_[last]) : px_[last]);
        }
        return series;
    }

    /// The cause, where the felt surface differed from the data between two times.
    [[nodiscard]] Cause other_than_data(double from_s, double to_s) const {
        const std::size_t lowest = lowest_of(felt_px_, from_s, to_s);
        if (!std::isnan(px_[lowest]))
            return felt_px_[lowest] < px_[lowest] - kFar_px ? Cause::cleaning : Cause::gone;
        const std::size_t before = last_data(lowest);
        if (std::isnan(px_[before]) || from_s - times_s_[before] >= kShortGap_s)
            return Cause::unseen;
        const std::size_t after = next_data(lowest);
        const bool back = after < px_.size() && times_s_[after] - times_s_[before] < kShortGap_s &&
                          std::fabs(px_[after] - px_[before]) < kPressed_px;
        return back ? Cause::hole : Cause::gone;
    }

    /// What the data was for a while after `t_s`, NaN in gaps.
    [[nodiscard]] std::span<const double> after_px(double t_s) const {
        const std::size_t first = frame_at(t_s) + 1;
        std::size_t end = first;
        while (end < px_.size() && (times_s_[end] <= t_s + kStays_s || end < first + kLeastFrames))
            ++end;
        return std::span(px_).subspan(first, end - first);
    }

    /// Whether most of the pixels around fell, too, where this one is lowest.
    [[nodiscard]] bool fell_around(double from_s, double to_s) const {
        const std::size_t before = frame_at(from_s);
        const std::size_t lowest = lowest_of(px_, from_s, to_s);
        return around_px(lowest) < around_px(before) - kFar_px;
    }

  private:
    [[nodiscard]] double elevation_px(const DepthImage& image, int i, int j) const {
        return relief_px_ * static_cast<double>(image.at(i, j)) / image.highest_level;
    }
    [[nodiscard]] std::size_t next_data(std::size_t k) const {
        while (k < px_.size() && std::isnan(px_[k])) ++k;
        return k;
    }
    /// The last frame with data up to this one; the first where there is none.
    [[nodiscard]] std::size_t last_data(std::size_t k) const {
        while (k > 0 && std::isnan(px_[k])) --k;
        return k;
    }
    /// The frame with the lowest value of those that the surface is made of meanwhile.
    [[nodiscard]] std::size_t lowest_of(const std::vector<double>& px, double from_s,
                                        double to_s) const {
        std::size_t lowest = frame_at(from_s);
        for (std::size_t k = lowest + 1; k < px.size(); ++k) {
            if (px[k] < px[lowest] || std::isnan(px[lowest])) lowest = k;
            if (times_s_[k] >= to_s) break;
        }
        return lowest;
    }
    /// The last frame up to a time.
    [[nodiscard]] std::size_t frame_at(double t_s) const {
        const auto after = std::upper_bound(times_s_.begin(), times_s_.end(), t_s);
        return after == times_s_.begin() ? 0
                                         : static_cast<std::size_t>(after - times_s_.begin()) - 1;
    }
    /// The middle of the data around the pixel; NaN: there is none.
    [[nodiscard]] double around_px(std::size_t frame) const {
        const DepthImage& image = raw_[frame];
        std::vector<double> around;
        for (int j = std::max(spot_.j - kAround_px, 0);
             j <= std::min(spot_.j + kAround_px, image.rows - 1); ++j)
            for (int i = std::max(spot_.i - kAround_px, 0);
                 i <= std::min(spot_.i + kAround_px, image.columns - 1); ++i) {
                const bool counts = (i != spot_.i || j != spot_.j) && !std::isnan(image.at(i, j));
                if (counts) around.push_back(elevation_px(image, i, j));
            }
        return around.empty() ? kNone : median_of(std::move(around));
    }

    std::span<const DepthImage> raw_;
    Spot spot_;
    double relief_px_;
    std::vector<double> times_s_{};
    std::vector<double> px_{};  ///< NaN: no data
    std::vector<double> felt_px_{};
};

/// What a finger on the data alone feels.
struct DataFinger {
    explicit DataFinger(const std::vector<double>& data_px) {
        test::PressingFinger finger(data_px.front(), test::kRestTimeConstant_s);
        for (const double px : data_px) {
            goals_px.push_back(finger.follow(px));
            contact.push_back(px > goals_px.back() ? 1 : 0);
        }
    }
    std::vector<double> goals_px{};
    std::vector<char> contact{};
};

Cause cause_of(const Loss& loss, const PixelData& data, const DataFinger& finger) {
    const auto seconds = [](std::size_t k) { return static_cast<double>(k) * kFingerTick_s; };
    const auto begin = finger.contact.begin() + static_cast<std::ptrdiff_t>(loss.begin);
    const auto end = finger.contact.begin() + static_cast<std::ptrdiff_t>(loss.end);
    const auto held = std::count(begin, end, 1);
    if (2 * held >= end - begin)
        return data.other_than_data(seconds(loss.begin), seconds(loss.end));
    const auto fell = static_cast<std::size_t>(std::find(begin, end, 0) - finger.contact.begin());
    const std::span<const double> after_px = data.after_px(seconds(fell));
    if (after_px.size() < kLeastFrames) return Cause::other;
    const std::optional<double> then_px = median_of_data(after_px);
    if (!then_px) return Cause::gone;
    if (*then_px <= finger.goals_px[fell]) return Cause::moved;
    const bool wide = data.fell_around(seconds(fell), seconds(loss.end));
    return wide ? Cause::flicker_wide : Cause::flicker;
}

}  // namespace

LostContact explain_losses(std::span<const Frame> frames, std::span<const DepthImage> raw,
                           Spot spot, std::span<const char> contact, double relief_px) {
    LostContact lost;
    const std::vector<Loss> losses = losses_in(contact);
    if (losses.empty()) return lost;
    const PixelData data(frames, raw, spot, relief_px);
    if (!data.any()) {
        for (const Loss& loss : losses) lost[Cause::unseen] += loss.end - loss.begin;
        return lost;
    }
    const DataFinger finger(data.bridged_px(contact.size()));
    for (const Loss& loss : losses) lost[cause_of(loss, data, finger)] += loss.end - loss.begin;
    return lost;
}

}  // namespace dibhr::bench
