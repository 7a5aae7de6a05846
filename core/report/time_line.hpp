// What happened when: the range of each quantity in pieces of the session, so that a peak of one
// tick is still there in an hour.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace dibhr {

/// Lowest and highest of the values so far, NaN before the first, and what their mean is made of.
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
    double seconds{0.0};    ///< that ticks stood for
    double contact_s{0.0};  ///< of them in contact
    ValueRange sent_newton{}, spring_newton{};
    ValueRange goal_mm_per_s{}, proxy_mm_per_s{};  ///< in contact
    // Presentation time of what was there to touch; NaN for nothing.
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

}  // namespace dibhr
