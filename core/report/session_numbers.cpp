// Computes the statistics of a session's ticks, in one pass.
#include "core/report/session_numbers.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.hpp"

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
        piece.sent_newton.add(glm::length(tick.sent_newton), held_s);
        piece.spring_newton.add(glm::length(tick.spring_newton), held_s);
        if (tick.surface) piece.add_video(tick.video_s);
        if (touches(tick)) add_contact(tick, held_s, speeds, piece);
    }

    SessionNumbers finish(double end_s) {
        numbers_.duration_s = end_s - session_.begin_s();
        if (!std::isfinite(numbers_.duration_s))
            throw InputError(session_.file().string() +
                             ": is damaged (times that are not numbers); copy it again");
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
        ticks.mouse_fallback += tick.mouse_fallback ? 1 : 0;
        ticks.late += tick.lateness_us >= kLate_us ? 1 : 0;
        ticks.goal_refused += tick.goal_refused ? 1 : 0;
        ticks.catching_up += tick.catching_up ? 1 : 0;
        if (std::isfinite(tick.lateness_us))
            ticks.worst_lateness_us = std::max(ticks.worst_lateness_us, tick.lateness_us);
        if (tick.cut < kSafetyCuts) ++ticks.cut[tick.cut];
    }

    void add_contact(const TickRecord& tick, double held_s, const std::optional<Speeds>& speeds,
                     TimePiece& piece) {
        numbers_.contact_s += held_s;
        numbers_.sent_newton.add(glm::length(tick.sent_newton), held_s);
        numbers_.spring_newton.add(glm::length(tick.spring_newton), held_s);
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

/// The time that a tick counts for; an invalid time in a file counts 0.
double held(double seconds) {
    return seconds > 0.0 ? std::min(seconds, kLongestTick_s) : 0.0;
}

constexpr double kMostPieces = 4000.0;  // about four a pixel of the plots
constexpr double kShortestPiece_s = 0.001;

constexpr double kMostBins = 200000.0;

/// Bins of a bar: the fewest, 1, 2 or 5 times a power of ten, so that `most` bars cover `bins`.
std::size_t round_bins(double bins, int most) {
    for (std::size_t power = 1;; power *= 10) {
        for (const std::size_t factor : {1U, 2U, 5U}) {
            if (std::ceil(bins / static_cast<double>(factor * power)) <= most)
                return factor * power;
        }
    }
}

constexpr double kMostPixels = 65536.0;  // along a side; larger images are not read

int column_of(std::uint64_t pixel) {
    return static_cast<int>(pixel & 0xffffU);
}

int row_of(std::uint64_t pixel) {
    return static_cast<int>(pixel >> 16U);
}

/// Weights that sum to one, the middle first.
std::vector<float> gaussian(double sigma_px) {
    constexpr double kReach = 3.0;
    const int reach = std::max(0, static_cast<int>(std::ceil(kReach * sigma_px)));
    std::vector<double> weights;
    double sum = 0.0;
    for (int k = 0; k <= reach; ++k) {
        weights.push_back(reach == 0 ? 1.0 : std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
        sum += (k == 0 ? 1.0 : 2.0) * weights.back();
    }
    std::vector<float> shares;
    for (const double weight : weights) shares.push_back(static_cast<float>(weight / sum));
    return shares;
}

/// Spreads every value along a line of `count` values that are `step` apart.
void spread_line(float* line, int count, std::size_t step, const std::vector<float>& weights,
                 std::vector<float>& spread) {
    const int reach = static_cast<int>(weights.size()) - 1;
    spread.assign(static_cast<std::size_t>(count), 0.0F);
    for (int k = 0; k < count; ++k) {
        const float value = line[static_cast<std::size_t>(k) * step];
        if (value == 0.0F) continue;
        const int last = std::min(count - 1, k + reach);
        for (int to = std::max(0, k - reach); to <= last; ++to) {
            spread[static_cast<std::size_t>(to)] +=
                value * weights[static_cast<std::size_t>(std::abs(to - k))];
        }
    }
    for (int k = 0; k < count; ++k)
        line[static_cast<std::size_t>(k) * step] = spread[static_cast<std::size_t>(k)];
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
        if (++number % kProgressTicks == 0 && progress)
            progress(static_cast<double>(number) / static_cast<double>(session.rows()));
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
        if (below_s >= share * total_s_)
            return std::min((static_cast<double>(bin) + 0.5) * resolution_, peak_);
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

void TouchedPlaces::add(Vec2 place_px, double media_s, double seconds) {
    total_s_ += seconds;
    frame_s_[media_s] += seconds;
    const double column = std::round(place_px.x);
    const double row = std::round(place_px.y);
    if (!(column >= 0.0 && row >= 0.0 && column < kMostPixels && row < kMostPixels)) return;
    pixel_s_[static_cast<std::uint64_t>(row) << 16U | static_cast<std::uint64_t>(column)] +=
        seconds;
}

double TouchedPlaces::longest_frame_s() const {
    const auto longest =
        std::ranges::max_element(frame_s_, {}, [](const auto& frame) { return frame.second; });
    return longest == frame_s_.end() ? 0.0 : longest->first;
}

PixelBounds TouchedPlaces::bounds() const {
    if (pixel_s_.empty()) return {};
    constexpr int kFar = static_cast<int>(kMostPixels);
    PixelBounds bounds{kFar, kFar, 0, 0};
    for (const auto& [pixel, seconds] : pixel_s_) {
        bounds.left = std::min(bounds.left, column_of(pixel));
        bounds.top = std::min(bounds.top, row_of(pixel));
        bounds.right = std::max(bounds.right, column_of(pixel) + 1);
        bounds.bottom = std::max(bounds.bottom, row_of(pixel) + 1);
    }
    return bounds;
}

bool TouchedPlaces::touches(int columns, int rows) const {
    return std::any_of(pixel_s_.begin(), pixel_s_.end(), [&](const auto& touched) {
        return column_of(touched.first) < columns && row_of(touched.first) < rows;
    });
}

PixelValues TouchedPlaces::smoothed(int columns, int rows, double sigma_px) const {
    PixelValues map{columns, rows, {}};
    const auto width = static_cast<std::size_t>(columns);
    map.values.resize(width * static_cast<std::size_t>(rows), 0.0F);
    for (const auto& [pixel, seconds] : pixel_s_) {
        if (column_of(pixel) >= columns || row_of(pixel) >= rows) continue;
        map.values[static_cast<std::size_t>(row_of(pixel)) * width +
                   static_cast<std::size_t>(column_of(pixel))] += static_cast<float>(seconds);
    }
    const std::vector<float> weights = gaussian(sigma_px);
    std::vector<float> line;
    for (int row = 0; row < rows; ++row)
        spread_line(&map.values[static_cast<std::size_t>(row) * width], columns, 1, weights, line);
    for (int column = 0; column < columns; ++column)
        spread_line(&map.values[static_cast<std::size_t>(column)], rows, width, weights, line);
    return map;
}

}  // namespace dibhr
