// Rows of estimates, psychometric functions and staircases.
#include "core/study_report/study_plots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "core/files/plain_text.hpp"
#include "core/plot/axes.hpp"
#include "core/report/report_plots.hpp"

namespace dibhr {

namespace {

constexpr int kColumns = 1000;
constexpr double kLeft_px = 36.0;
constexpr double kTop_px = 112.0;
constexpr Box kArea{100.0, kTop_px, 960.0, 560.0};
constexpr int kRows = 640;

Ink found_ink() {
    return style_of(Algorithm::dibhr).stroke.ink;
}

Ink faint(Ink ink, double opacity) {
    ink.opacity = opacity;
    return ink;
}

/// Around the values, with a little room.
ValueSpan span_of(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.empty()) return {0.0, 1.0};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    double room = 0.08 * (*high - *low);
    if (!(room > 0.0)) room = std::max(0.1 * std::abs(*high), 0.05);
    return {*low - room, *high + room};
}

ValueSpan span_of(const RowsPlot& plot) {
    if (plot.span) return {plot.span->low, plot.span->high};
    std::vector<double> values;
    if (plot.line) values.push_back(*plot.line);
    for (const PlotRow& row : plot.rows) {
        values.insert(values.end(), {row.value, row.interval.low, row.interval.high});
        values.insert(values.end(), row.each.begin(), row.each.end());
    }
    return span_of(std::move(values));
}

/// Merges levels that lie too close for markers of their own: a staircase in factors has dozens of
/// levels.
LevelCounts grouped(const LevelCounts& counts) {
    constexpr std::size_t kMostGroups = 14;
    LevelCounts sorted = counts;
    std::ranges::sort(sorted, {}, &LevelCount::x);
    while (sorted.size() > kMostGroups) {
        std::size_t nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k + 1 < sorted.size(); ++k) {
            // Levels with few answers are merged first.
            const int trials = sorted[k].count.trials + sorted[k + 1].count.trials;
            const double cost = (sorted[k + 1].x - sorted[k].x) * trials;
            if (cost < least) {
                least = cost;
                nearest = k;
            }
        }
        LevelCount& a = sorted[nearest];
        const LevelCount b = sorted[nearest + 1];
        const double of_a = a.count.trials;
        const double of_b = b.count.trials;
        a.x = (a.x * of_a + b.x * of_b) / (of_a + of_b);
        a.count.hits += b.count.hits;
        a.count.trials += b.count.trials;
        sorted.erase(sorted.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
    }
    return sorted;
}

std::vector<Vec2> curve_of(const PsychometricFunction& function, ValueSpan span) {
    constexpr int kSteps = 240;
    std::vector<Vec2> line;
    for (int k = 0; k <= kSteps; ++k) {
        const double x = span.low + (span.high - span.low) * k / kSteps;
        if (x > 0.0 || function.curve != Curve::weibull) line.emplace_back(x, function.share(x));
    }
    return line;
}

/// On one line, cut short where it is wider than that.
std::string shortened(const std::string& text, double widest_px, const TextStyle& style) {
    constexpr std::size_t kMostLetters = 200;  // no picture is so wide
    std::size_t letters = std::min(text.size(), kMostLetters);
    std::string kept = one_line(text, letters);
    while (letters > 2 && text_width(kept, style) > widest_px) kept = one_line(text, --letters);
    return kept;
}

/// Two lines where one is too short, broken at a space.
std::vector<std::string> in_two_lines(const std::string& text, double widest_px,
                                      const TextStyle& style) {
    if (text_width(text, style) <= widest_px) return {text};
    std::size_t end = text.rfind(' ');
    while (end != std::string::npos && end > 0 &&
           text_width(text.substr(0, end), style) > widest_px)
        end = text.rfind(' ', end - 1);
    if (end == std::string::npos || end == 0) return {shortened(text, widest_px, style)};
    return {text.substr(0, end), shortened(text.substr(end + 1), widest_px, style)};
}

/// Draws a title, cut to the picture's width: a question may be long.
void draw_fitting_title(Canvas& canvas, const std::string& title, const std::string& subtitle) {
    const double widest_px = kColumns - 2.0 * kLeft_px;
    const TextStyle bold{kTextInk, kTitleCap_px, Align::left, true};
    draw_title(canvas, shortened(one_line(title), widest_px, bold),
               shortened(subtitle, widest_px, {kQuietInk, kLabelCap_px}));
}

}  // namespace

Canvas plot_rows(const RowsPlot& plot) {
    constexpr double kRow_px = 46.0;
    const TextStyle label{kTextInk, kLabelCap_px, Align::right};
    double names_px = 0.0;
    for (const PlotRow& row : plot.rows) names_px = std::max(names_px, text_width(row.name, label));
    constexpr double kWidestNames_px = 466.0;
    constexpr double kLine_px = 18.0;
    const double left = kLeft_px + std::min(names_px, kWidestNames_px) + 18.0;
    const Box area{left, kTop_px, 950.0,
                   kTop_px + kRow_px * static_cast<double>(plot.rows.size()) + 12.0};
    Canvas canvas(kColumns, static_cast<int>(area.bottom) + 76, kPaper);
    draw_fitting_title(canvas, plot.title, plot.subtitle);
    Axis y{{0.0, static_cast<double>(plot.rows.size())}, ""};
    y.numbered = false;
    y.ticks = {0.0};  // the rows have names
    const Axes axes(area, {span_of(plot), plot.axis}, y);
    axes.draw_ground(canvas);
    if (plot.line) {
        const double x = axes.at(*plot.line, 0.0).x;
        canvas.line({x, area.top}, {x, area.bottom}, {kTextInk, 1.5, Dash::dashed});
        canvas.text({x, area.top - 8.0}, plot.line_name, {kQuietInk, kNumberCap_px, Align::centre});
    }
    double y_px = area.top + 6.0 + kRow_px / 2.0;
    for (const PlotRow& row : plot.rows) {
        canvas.clip_to_whole();
        const std::vector<std::string> lines = in_two_lines(row.name, kWidestNames_px, label);
        const double first_px =
            y_px + label.cap_px / 2.0 - kLine_px / 2.0 * static_cast<double>(lines.size() - 1);
        for (std::size_t k = 0; k < lines.size(); ++k)
            canvas.text({area.left - 12.0, first_px + kLine_px * static_cast<double>(k)}, lines[k],
                        label);
        canvas.clip_to({area.left - 6.0, area.top, area.right + 6.0, area.bottom});
        for (std::size_t k = 0; k < row.each.size(); ++k) {
            if (!std::isfinite(row.each[k])) continue;
            // Spreads the markers vertically, without a visible pattern.
            const double aside = static_cast<double>(k * 5 % 7) * 3.0 - 9.0;
            canvas.disc({axes.at(row.each[k], 0.0).x, y_px + aside}, 3.5, faint(found_ink(), 0.35));
        }
        const double low = axes.at(std::max(row.interval.low, -1e300), 0.0).x;
        const double high = axes.at(std::min(row.interval.high, 1e300), 0.0).x;
        if (std::isfinite(row.interval.low) || std::isfinite(row.interval.high))
            canvas.line({std::max(low, area.left - 6.0), y_px},
                        {std::min(high, area.right + 6.0), y_px}, {kTextInk, 2.5});
        if (std::isfinite(row.value))
            canvas.marker({axes.at(row.value, 0.0).x, y_px}, Marker::diamond, 13.0, found_ink(),
                          kPaper);
        else
            canvas.text({area.left + 12.0, y_px + kNumberCap_px / 2.0}, plot.no_value,
                        {kQuietInk, kNumberCap_px});
        y_px += kRow_px;
    }
    canvas.clip_to_whole();
    axes.draw_frame(canvas);
    return canvas;
}

Canvas plot_threshold(const ThresholdFinding& finding, const std::string& title,
                      const std::string& subtitle) {
    const LevelCounts points = grouped(finding.all);
    double highest = 0.0;
    for (const LevelCount& point : points) highest = std::max(highest, point.x);
    const ValueSpan span{0.0, 1.06 * highest};
    Canvas canvas(kColumns, kRows, kPaper);
    draw_fitting_title(canvas, title, subtitle);
    const Axes axes(
        kArea,
        {span, "difference in " + finding.parameter + " from " + short_text(finding.reference, 4)},
        {{0.0, 1.02}, finding.settings.guess > 0.0 ? "share right" : "share of yes"});
    axes.draw_ground(canvas);
    const bool alone = finding.fits.size() == 1;
    for (const ParticipantThreshold& one : finding.fits)
        axes.draw_series(canvas, curve_of(one.fit.function, span),
                         {faint(found_ink(), alone ? 1.0 : 0.35), alone ? 2.5 : 1.5});
    int most = 1;
    for (const LevelCount& point : points) most = std::max(most, point.count.trials);
    for (const LevelCount& point : points) {
        const Interval interval = exact_interval(point.count);
        canvas.line(axes.at(point.x, interval.low), axes.at(point.x, interval.high),
                    {faint(kTextInk, 0.45), 1.5});
        canvas.marker(axes.at(point.x, point.count.share()), Marker::circle,
                      6.0 + 10.0 * std::sqrt(static_cast<double>(point.count.trials) / most),
                      kTextInk, kPaper);
    }
    const PsychometricFunction& first = finding.fits.front().fit.function;
    // Of few people only the mean has an interval; else the median is drawn.
    const bool has_median =
        std::isfinite(finding.median.value) && finding.fits.size() >= kFewestForRanks;
    const Estimate& of_people = has_median ? finding.median : finding.participants_mean;
    const Interval interval = alone ? finding.fits.front().fit.threshold : of_people.interval;
    const double confidence = alone ? kConfidence : of_people.confidence;
    const bool has_interval = std::isfinite(interval.low) || std::isfinite(interval.high);
    const double threshold = alone ? first.threshold : of_people.value;
    const double height = first.share(first.threshold);  // half of what is not guessed nor lapsed
    if (std::isfinite(threshold)) {
        const Vec2 at = axes.at(threshold, height);
        canvas.clip_to(kArea);
        if (has_interval)
            canvas.line({axes.at(std::max(interval.low, span.low), height).x, at.y},
                        {axes.at(std::min(interval.high, span.high), height).x, at.y},
                        {style_of(Algorithm::pga).stroke.ink, 4.0});
        canvas.line(at, {at.x, kArea.bottom},
                    {style_of(Algorithm::pga).stroke.ink, 1.5, Dash::dashed});
        canvas.clip_to_whole();
    }
    axes.draw_frame(canvas);
    draw_legend(
        canvas, {kArea.right - 330.0, kArea.bottom - 104.0},
        {{"answers, all participants", {kTextInk, 1.5}, Marker::circle},
         {alone ? "fitted" : "fitted, one each", {found_ink(), 2.5}, Marker::none},
         {has_interval ? "threshold, " + short_text(100.0 * confidence, 3) + " %" : "threshold",
          {style_of(Algorithm::pga).stroke.ink, 4.0},
          Marker::none}});
    return canvas;
}

Canvas plot_tracks(const Study& study, std::size_t block, std::size_t item,
                   const std::string& title, const std::string& subtitle) {
    const Variation& vary = study.protocol.blocks[block].variation;
    std::map<std::pair<std::size_t, int>, std::vector<Vec2>> tracks;
    std::vector<double> levels;
    std::size_t longest = 2;
    for (std::size_t participant = 0; participant < study.participants.size(); ++participant) {
        for (const AnsweredTrial& one : study.participants[participant].answered) {
            const Trial& trial = one.trial;
            if (static_cast<std::size_t>(trial.block) != block ||
                static_cast<std::size_t>(trial.item) != item)
                continue;
            std::vector<Vec2>& track = tracks[{participant, trial.track}];
            track.emplace_back(static_cast<double>(track.size() + 1), *trial.level);
            longest = std::max(longest, track.size());
            levels.push_back(*trial.level);
        }
    }
    const bool logarithmic = vary.staircase->factors && vary.staircase->low > 0.0;
    ValueSpan span = span_of(levels);
    if (logarithmic) {
        const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
        span = {*low / 1.3, *high * 1.3};
    } else {
        span.low = std::max(span.low, 0.0);
    }
    Canvas canvas(kColumns, kRows, kPaper);
    draw_fitting_title(canvas, title, subtitle);
    Axis y{span, "difference in " + vary.parameter, logarithmic};
    if (logarithmic) y.ticks = close_ticks(span);  // a staircase seldom goes through two decades
    const Axes axes(kArea, {{0.0, static_cast<double>(longest) + 1.0}, "trial of the staircase"},
                    y);
    axes.draw_ground(canvas);
    const bool few = tracks.size() <= 4;
    for (const auto& [which, track] : tracks)
        axes.draw_series(canvas, track, {faint(found_ink(), few ? 0.9 : 0.35), few ? 2.0 : 1.25});
    axes.draw_frame(canvas);
    return canvas;
}

}  // namespace dibhr
