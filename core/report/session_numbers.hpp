// Statistics of a session's ticks: contact, forces, speeds, places and failures, in one pass.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <unordered_map>
#include <vector>

#include "core/haptics/safety.hpp"
#include "core/haptics/vec.hpp"
#include "core/report/contact_episodes.hpp"
#include "core/session/session.hpp"

namespace dibhr {

/// Lowest and highest of the values so far, NaN before the first, and the sums for their mean.
struct ValueRange {
    double low{std::numeric_limits<double>::quiet_NaN()};
    double high{std::numeric_limits<double>::quiet_NaN()};

    double sum{0.0};  ///< values times the seconds each stood for
    double seconds{0.0};

    void add(double value, double held_s) noexcept {
        if (!std::isfinite(value)) return;
        sum += value * held_s;
        seconds += held_s;
        low = std::fmin(low, value);
        high = std::fmax(high, value);
    }
    [[nodiscard]] bool empty() const noexcept { return std::isnan(low); }
};

/// A piece of the session.
struct TimePiece {
    ValueRange sent_newton{}, spring_newton{};
    ValueRange goal_mm_per_s{}, proxy_mm_per_s{};  ///< in contact
    // Presentation time of the frame to touch; NaN: none.
    double video_first_s{std::numeric_limits<double>::quiet_NaN()};
    double video_last_s{std::numeric_limits<double>::quiet_NaN()};

    void add_video(double video_s) noexcept {
        if (!std::isfinite(video_s)) return;
        if (std::isnan(video_first_s)) video_first_s = video_s;
        video_last_s = video_s;
    }
};

/// The session in equal pieces, as many as a plot can show.
class TimeLine {
  public:
    /// For ticks from `begin_s` to `end_s`; a piece is a millisecond at least.
    TimeLine(double begin_s, double end_s);

    [[nodiscard]] TimePiece& piece_at(double t_s) noexcept;

    [[nodiscard]] const std::vector<TimePiece>& pieces() const noexcept { return pieces_; }
    [[nodiscard]] double piece_s() const noexcept { return piece_s_; }
    /// Since the session began, of a piece's middle [s].
    [[nodiscard]] double middle_s(std::size_t piece) const noexcept {
        return (static_cast<double>(piece) + 0.5) * piece_s_;
    }

  private:
    double begin_s_;
    double piece_s_;
    std::vector<TimePiece> pieces_;
};

/// Equal bars from 0 on.
struct Bars {
    double width{1.0};
    std::vector<double> seconds{};
    double beyond_s{0.0};  ///< time beyond the last bar
};

/// Values from 0 on, each for some seconds. Memory is bounded: values are sorted into narrow bins,
/// and what is beyond the last of them counts as in it.
class Distribution {
  public:
    /// `resolution`: width of a narrow bin, in the quantity's unit.
    explicit Distribution(double resolution) : resolution_(resolution) {}

    /// Ignores a value that is not finite or below 0.
    void add(double value, double seconds);

    [[nodiscard]] double total_s() const noexcept { return total_s_; }
    [[nodiscard]] double mean() const noexcept;  ///< over time; 0 for nothing
    [[nodiscard]] double peak() const noexcept { return peak_; }
    /// The value below which the quantity was for this share of the time, to half the resolution.
    [[nodiscard]] double quantile(double share) const;
    /// At most `most` bars of a round width that reach to `upto` at least.
    [[nodiscard]] Bars bars(double upto, int most) const;

  private:
    double resolution_;
    std::vector<double> bin_s_{};
    double total_s_{0.0};
    double sum_{0.0};
    double peak_{0.0};
};

/// Pixels from `left` and `top` up to, not including, `right` and `bottom`.
struct PixelBounds {
    int left{0}, top{0}, right{0}, bottom{0};
};

/// One value a pixel, row-major.
struct PixelValues {
    int columns{0};
    int rows{0};
    std::vector<float> values{};

    [[nodiscard]] float at(int column, int row) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }
};

/// Where a video was touched, and for how long.
class TouchedPlaces {
  public:
    /// The contact was at this place of the depth image [px] and in the frame shown at `media_s`,
    /// for so long. A place outside every image only counts for its frame.
    void add(Vec2 place_px, double media_s, double seconds);

    [[nodiscard]] double total_s() const noexcept { return total_s_; }
    /// The frame that was touched longest, the earliest of several: its presentation time.
    [[nodiscard]] double longest_frame_s() const;
    /// Around every touched pixel; empty for none.
    [[nodiscard]] PixelBounds bounds() const;
    /// Whether a pixel of an image of this size was touched.
    [[nodiscard]] bool touches(int columns, int rows) const;
    /// Seconds per pixel over an image of this size, spread by a Gaussian of `sigma_px`.
    [[nodiscard]] PixelValues smoothed(int columns, int rows, double sigma_px) const;

  private:
    std::unordered_map<std::uint64_t, double> pixel_s_{};  ///< by row and column
    std::map<double, double> frame_s_{};
    double total_s_{0.0};
};

/// A tick counts for the time until the next one, at most for this: a program that was stopped did
/// not touch (as SafetyLimits::max_tick_s, after which there is no force).
inline constexpr double kLongestTick_s = 0.020;

inline constexpr std::size_t kSafetyCuts = static_cast<std::size_t>(kLastSafetyCut) + 1;

struct TickCounts {
    std::int64_t all{0};
    std::int64_t missing{0};  ///< in the file, between the first and the last
    std::int64_t in_contact{0};
    std::int64_t without_surface{0};
    std::int64_t device_not_ready{0};
    std::int64_t mouse_fallback{0};  ///< of the mouse, while the device was not ready
    std::int64_t late{0};
    std::int64_t goal_refused{0};
    std::int64_t catching_up{0};  ///< ended before the proxy had caught up with its goal
    std::array<std::int64_t, kSafetyCuts> cut{};  ///< by SafetyCut
    double worst_lateness_us{0.0};
};

struct SessionNumbers {
    double begin_utc_s{0.0};  ///< wall time of the first tick since 1970; 0: not known
    double duration_s{0.0};   ///< from the first tick to the end of the last
    double contact_s{0.0};
    TickCounts ticks{};
    std::vector<Episode> episodes{};
    // While in contact.
    Distribution sent_newton{0.001}, spring_newton{0.001};
    Distribution goal_mm_per_s{0.1}, proxy_mm_per_s{0.1};
    TimeLine time_line{0.0, 0.0};
    std::map<std::uint32_t, TouchedPlaces> places{};  ///< by media
    /// First use of a version of the parameters.
    std::map<std::uint64_t, double> settings_from_s{};

    /// Of all ticks, those in contact: `SELECT avg(contact) FROM tick`.
    [[nodiscard]] double contact_share() const noexcept {
        return ticks.all > 0
                   ? static_cast<double>(ticks.in_contact) / static_cast<double>(ticks.all)
                   : 0.0;
    }
};

/// Reads every tick once and keeps none; `progress` is called with the share done. Throws
/// InputError for a damaged file.
[[nodiscard]] SessionNumbers numbers_of(const Session& session,
                                        const std::function<void(double)>& progress = {});

/// Of the whole session.
[[nodiscard]] double path_mm(const SessionNumbers& numbers);

}  // namespace dibhr
