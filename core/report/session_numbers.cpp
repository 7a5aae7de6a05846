// What a session's ticks come to, in one pass.
#include "core/report/session_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/report/contact_episodes.hpp"

namespace dibhr {

namespace {

constexpr std::int64_t kProgressTicks = 20000;

/// Adds tick after tick to the numbers.
class Counter {
  public:
    explicit Counter(const Session& session) : session_(session) {
        numbers_.time_line = TimeLine(session.begin_s(), session.end_s());
        numbers_.ticks.missing = session.missing();
    }

    void add(const TickRecord& tick, double held_s) {
        count(tick);
        if (numbers_.ticks.all == 1) numbers_.begin_utc_s = tick.utc_s;
        const double pitch_mm = pitch_of(tick);
        episodes_.add(tick, held_s, pitch_mm);
        const std::optional<Speeds> speeds = speed_.add(tick, pitch_mm);
        TimePiece& piece = numbers_.time_line.piece_at(tick.t_s);
        piece.seconds += held_s;
        piece.sent_newton.add(glm::length(tick.sent_newton), held_s);
        piece.spring_newton.add(glm::length(tick.spring_newton), held_s);
        if (tick.surface) piece.add_video(tick.video_s);
        if (touches(tick)) add_contact(tick, held_s, speeds, piece);
    }

    SessionNumbers finish(double end_s) {
        numbers_.duration_s = end_s - session_.begin_s();
        if (!std::isfinite(numbers_.duration_s)) {
            throw InputError(session_.file().string() +
                             ": is damaged (times that are no numbers); copy it again");
        }
        numbers_.episodes = episodes_.finish();
        return std::move(numbers_);
    }

  private:
    void count(const TickRecord& tick) {
        TickCounts& ticks = numbers_.ticks;
        ++ticks.all;
        ticks.in_contact += tick.contact ? 1 : 0;
        ticks.without_surface += tick.surface ? 0 : 1;
        ticks.device_not_ready += tick.device_ready ? 0 : 1;
        ticks.stand_in += tick.stand_in ? 1 : 0;
        ticks.late += tick.lateness_us >= kLate_us ? 1 : 0;
        ticks.goal_refused += tick.goal_refused ? 1 : 0;
        if (std::isfinite(tick.lateness_us)) {
            ticks.worst_lateness_us = std::max(ticks.worst_lateness_us, tick.lateness_us);
        }
        if (tick.cut < kSafetyCuts) ++ticks.cut[tick.cut];
    }

    void add_contact(const TickRecord& tick, double held_s, const std::optional<Speeds>& speeds,
                     TimePiece& piece) {
        numbers_.contact_s += held_s;
        numbers_.sent_newton.add(glm::length(tick.sent_newton), held_s);
        numbers_.spring_newton.add(glm::length(tick.spring_newton), held_s);
        piece.contact_s += held_s;
        numbers_.places[tick.frames.source.media].add(
            Vec2(tick.proxy), tick.blend < 0.5 ? tick.frames.from_s : tick.frames.to_s, held_s);
        if (!speeds) return;
        numbers_.goal_mm_per_s.add(speeds->goal_mm_per_s, held_s);
        numbers_.proxy_mm_per_s.add(speeds->proxy_mm_per_s, held_s);
        piece.goal_mm_per_s.add(speeds->goal_mm_per_s, held_s);
        piece.proxy_mm_per_s.add(speeds->proxy_mm_per_s, held_s);
    }

    double pitch_of(const TickRecord& tick) {
        if (tick.settings != settings_) {
            const SessionParameters* parameters = session_.parameters_of(tick.settings);
            if (parameters != nullptr) pitch_mm_ = parameters->touch.coupling.pixel_pitch_mm;
            settings_ = tick.settings;
            numbers_.settings_from_s.try_emplace(tick.settings, tick.t_s);
        }
        return pitch_mm_;
    }

    const Session& session_;
    SessionNumbers numbers_{};
    ContactEpisodes episodes_{};
    SpeedWindow speed_{};
    std::optional<std::uint64_t> settings_{};
    double pitch_mm_{Coupling{}.pixel_pitch_mm};
};

/// How long the tick stands for; garbage in a file counts nothing.
double held(double seconds) {
    return seconds > 0.0 ? std::min(seconds, kLongestTick_s) : 0.0;
}

constexpr double kMostPieces = 4000.0;  // about four a pixel of the plots
constexpr double kShortestPiece_s = 0.001;

constexpr double kMostBins = 200000.0;

/// The narrowest of 1, 2 or 5 times a power of ten bins of which `most` reach to `bins`.
std::size_t round_bins(double bins, int most) {
    for (std::size_t power = 1;; power *= 10) {
        for (const std::size_t factor : {1U, 2U, 5U}) {
            if (std::ceil(bins / static_cast<double>(factor * power)) <= most) {
                return factor * power;
            }
        }
    }
}

}  // namespace

SessionNumbers numbers_of(const Session& session, const std::function<void(double)>& progress) {
    Counter counter(session);
    Session::Ticks ticks(session);
    TickRecord tick;
    TickRecord next;
    double end_s = session.begin_s();
    std::int64_t number = 0;
    for (bool more = ticks.next(tick); more; tick = next) {
        more = ticks.next(next);
        const double held_s = held(more ? next.t_s - tick.t_s : tick.dt_s);
        counter.add(tick, held_s);
        end_s = tick.t_s + held_s;
        if (++number % kProgressTicks == 0 && progress) {
            progress(static_cast<double>(number) / static_cast<double>(session.rows()));
        }
    }
    return counter.finish(end_s);
}

double path_mm(const SessionNumbers& numbers) {
    return std::accumulate(
        numbers.episodes.begin(), numbers.episodes.end(), 0.0,
        [](double sum, const Episode& episode) { return sum + episode.path_mm; });
}

TimeLine::TimeLine(double begin_s, double end_s) : begin_s_(begin_s) {
    const double duration_s = std::isfinite(end_s - begin_s) ? std::max(end_s - begin_s, 0.0) : 0.0;
    const double pieces = std::clamp(std::ceil(duration_s / kShortestPiece_s), 1.0, kMostPieces);
    piece_s_ = std::max(duration_s / pieces, kShortestPiece_s);
    pieces_.resize(static_cast<std::size_t>(pieces));
}

TimePiece& TimeLine::piece_at(double t_s) noexcept {
    const double number = std::floor((t_s - begin_s_) / piece_s_);
    const double last = static_cast<double>(pieces_.size() - 1);
    // A time that is no number belongs to the first piece.
    return pieces_[static_cast<std::size_t>(number > 0.0 ? std::min(number, last) : 0.0)];
}

void Distribution::add(double value, double seconds) {
    if (!std::isfinite(value) || value < 0.0) return;
    const auto bin = static_cast<std::size_t>(std::min(value / resolution_, kMostBins));
    if (bin >= bin_s_.size()) bin_s_.resize(bin + 1, 0.0);
    bin_s_[bin] += seconds;
    total_s_ += seconds;
    sum_ += value * seconds;
    peak_ = std::max(peak_, value);
}

double Distribution::mean() const noexcept {
    return total_s_ > 0.0 ? sum_ / total_s_ : 0.0;
}

double Distribution::quantile(double share) const {
    double below_s = 0.0;
    for (std::size_t bin = 0; bin < bin_s_.size(); ++bin) {
        below_s += bin_s_[bin];
        if (below_s >= share * total_s_) {
            return std::min((static_cast<double>(bin) + 0.5) * resolution_, peak_);
        }
    }
    return peak_;
}

Bars Distribution::bars(double upto, int most) const {
    const double wanted_bins = std::clamp(upto / resolution_, 1.0, kMostBins);
    const std::size_t each = round_bins(wanted_bins, std::max(most, 1));
    const double wanted = std::ceil(wanted_bins / static_cast<double>(each));
    Bars bars{resolution_ * static_cast<double>(each), {}, 0.0};
    bars.seconds.resize(static_cast<std::size_t>(wanted), 0.0);
    for (std::size_t bin = 0; bin < bin_s_.size(); ++bin) {
        const std::size_t bar = bin / each;
        (bar < bars.seconds.size() ? bars.seconds[bar] : bars.beyond_s) += bin_s_[bin];
    }
    return bars;
}

}  // namespace dibhr
