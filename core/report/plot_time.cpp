// Forces and speeds over time, above the video's time, with contacts and marks.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/plot/axes.hpp"
#include "core/report/report_plots.hpp"

namespace dibhr {

namespace {

constexpr Box kPanel{110.0, 112.0, 1160.0, 442.0};
constexpr Box kVideoPanel{110.0, 502.0, 1160.0, 582.0};
// The strip that shows when there was contact.
constexpr Box kContacts{110.0, 452.0, 1160.0, 466.0};
constexpr double kMarkNames_px = 44.0;  // above the panels, where there are marks
constexpr double kPale = 0.45;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr Ink kContactInk{213, 94, 0};  // Okabe and Ito's vermillion

/// One quantity of the pieces.
struct Curve {
    ValueRange TimePiece::*range;
    SeriesStyle look{};
};

/// A round number at or above the highest value.
double round_top(double highest) {
    if (!(highest > 0.0)) return 1.0;
    const double step = std::pow(10.0, std::floor(std::log10(highest))) / 2.0;
    return step * std::ceil(highest / step - 1e-9);
}

Box lowered(Box box, double by_px) {
    return {box.left, box.top + by_px, box.right, box.bottom + by_px};
}

double highest_of(const TimeLine& line, ValueRange TimePiece::*range) {
    double highest = 0.0;
    for (const TimePiece& piece : line.pieces()) highest = std::fmax(highest, (piece.*range).high);
    return highest;
}

/// The pieces' ranges as one line, which ends where there is nothing.
std::vector<Vec2> line_of(const TimeLine& line, ValueRange TimePiece::*range) {
    constexpr double kLongestHole_s = 0.010;  // a late tick, not a gap
    std::vector<Vec2> points;
    double last_s = 0.0;
    for (std::size_t k = 0; k < line.pieces().size(); ++k) {
        const ValueRange& values = line.pieces()[k].*range;
        if (values.empty()) continue;
        const double t_s = line.middle_s(k);
        if (!points.empty() && t_s - last_s > std::max(kLongestHole_s, 1.5 * line.piece_s()))
            points.emplace_back(t_s, kNothing);
        last_s = t_s;
        points.emplace_back(t_s, values.low);
        if (values.high > values.low) points.emplace_back(t_s, values.high);
    }
    return points;
}

/// The means over so many pieces as one line, which ends where there is nothing.
std::vector<Vec2> mean_line(const TimeLine& line, ValueRange TimePiece::*range) {
    constexpr std::size_t kPieces = 16;
    std::vector<Vec2> points;
    for (std::size_t first = 0; first < line.pieces().size(); first += kPieces) {
        const std::size_t end = std::min(first + kPieces, line.pieces().size());
        double sum = 0.0;
        double seconds = 0.0;
        for (std::size_t k = first; k < end; ++k) {
            sum += (line.pieces()[k].*range).sum;
            seconds += (line.pieces()[k].*range).seconds;
        }
        const double middle_s = (line.middle_s(first) + line.middle_s(end - 1)) / 2.0;
        points.emplace_back(middle_s, seconds > 0.0 ? sum / seconds : kNothing);
    }
    return points;
}

/// The video's time, which ends where it jumps: at a loop or a seek back.
std::vector<Vec2> video_line(const TimeLine& line) {
    std::vector<Vec2> points;
    const auto add = [&points](double t_s, double video_s) {
        const bool jumped = !points.empty() && video_s < points.back().y;
        if (jumped) points.emplace_back(t_s, kNothing);
        points.emplace_back(t_s, video_s);
    };
    for (std::size_t k = 0; k < line.pieces().size(); ++k) {
        const TimePiece& piece = line.pieces()[k];
        if (std::isnan(piece.video_first_s)) continue;
        add(line.middle_s(k), piece.video_first_s);
        add(line.middle_s(k), piece.video_last_s);
    }
    return points;
}

double highest_video_s(const TimeLine& line) {
    double highest = 0.0;
    for (const TimePiece& piece : line.pieces())
        highest = std::fmax(highest, std::fmax(piece.video_first_s, piece.video_last_s));
    return highest;
}

Axis time_axis(double duration_s, bool numbered) {
    Axis axis{{0.0, std::max(duration_s, 0.001)}, numbered ? "time since the start [s]" : ""};
    axis.numbered = numbered;
    axis.most_ticks = 12;
    return axis;
}

void draw_contacts(Canvas& canvas, Box strip, const Axes& axes, const SessionNumbers& numbers,
                   double begin_s) {
    canvas.clip_to(strip);
    for (const Episode& episode : numbers.episodes) {
        const double left = axes.at(episode.begin_s - begin_s, 0.0).x;
        const double right = axes.at(episode.end_s - begin_s, 0.0).x;
        canvas.fill({left, strip.top, std::max(right, left + 0.5), strip.bottom}, kContactInk);
    }
    canvas.clip_to_whole();
    canvas.text({strip.left - 9.0, strip.bottom - 2.0}, "contact",
                {kTextInk, kNumberCap_px, Align::right});
}

/// A line through all panels for each mark, and its name above where there is room.
void draw_marks(Canvas& canvas, const Axes& axes, double bottom_px, const PlotContext& context) {
    constexpr std::size_t kLongestName = 18;
    constexpr double kRow_px = 17.0;
    constexpr int kNameRows = 3;
    const TextStyle style{kTextInk, kNumberCap_px, Align::left};
    const Box area = axes.area();
    std::vector<double> taken_px(kNameRows, area.left);  // how far each row of names is full
    for (const SessionMark& mark : context.marks) {
        const double x = axes.at(mark.t_s - context.begin_s, 0.0).x;
        if (!(x >= area.left - 0.5 && x <= area.right + 0.5)) continue;
        canvas.line({x, area.top}, {x, bottom_px}, {kTextInk, 1.0, Dash::dashed});
        const std::string name = one_line(mark.tag, kLongestName);
        const double width = text_width(name, style);
        const double left = std::min(x - 2.0, area.right + 24.0 - width);
        for (int row = 0; row < kNameRows; ++row) {
            double& taken = taken_px[static_cast<std::size_t>(row)];
            if (left < taken) continue;
            canvas.text({left, area.top - 8.0 - row * kRow_px}, name, style);
            taken = left + width + 10.0;
            break;
        }
    }
}

Canvas plot_over_time(const std::string& title, const std::string& label,
                      const std::vector<Curve>& curves, const SessionNumbers& numbers,
                      const PlotContext& context) {
    const double down_px = context.marks.empty() ? 0.0 : kMarkNames_px;
    Canvas canvas(1200, 652 + static_cast<int>(down_px), kPaper);
    draw_title(canvas, title, context.subtitle);
    double highest = 0.0;
    for (const Curve& curve : curves)
        highest = std::max(highest, highest_of(numbers.time_line, curve.range));
    const Axes axes(lowered(kPanel, down_px), time_axis(numbers.duration_s, false),
                    {{0.0, round_top(1.02 * highest)}, label});
    axes.draw_ground(canvas);
    std::vector<SeriesStyle> entries;
    const bool means = shows_means(numbers.time_line);
    for (const Curve& curve : curves) {
        Stroke stroke = curve.look.stroke;
        if (means) stroke.ink.opacity = kPale;
        axes.draw_series(canvas, line_of(numbers.time_line, curve.range), stroke);
        entries.push_back(curve.look);
    }
    if (means) {
        const Curve& felt = curves.back();
        SeriesStyle mean{"its mean", {kTextInk, 2.0, Dash::solid}, {}};
        axes.draw_series(canvas, mean_line(numbers.time_line, felt.range), mean.stroke);
        entries.push_back(mean);
    }
    axes.draw_frame(canvas);
    draw_contacts(canvas, lowered(kContacts, down_px), axes, numbers, context.begin_s);

    Axis video_time{{0.0, round_top(highest_video_s(numbers.time_line))}, "video [s]"};
    video_time.most_ticks = 4;
    const Axes video(lowered(kVideoPanel, down_px), time_axis(numbers.duration_s, true),
                     std::move(video_time));
    video.draw_ground(canvas);
    video.draw_series(canvas, video_line(numbers.time_line), {kGoalInk, 1.5, Dash::solid});
    video.draw_frame(canvas);
    draw_marks(canvas, axes, video.area().bottom, context);
    draw_legend(canvas, {920.0, 12.0}, entries);
    return canvas;
}

}  // namespace

bool shows_means(const TimeLine& line) {
    constexpr double kLong_s = 0.25;  // a piece; a session of 1000 s
    return line.piece_s() >= kLong_s;
}

Canvas plot_force_over_time(const SessionNumbers& numbers, const PlotContext& context) {
    const Stroke sent = style_of(Algorithm::dibhr).stroke;
    return plot_over_time(
        "Force over time", "force [N]",
        {{&TimePiece::spring_newton, {"spring", {kExactInk, 4.5, Dash::solid}, {}}},
         {&TimePiece::sent_newton, {"sent to the hand", {sent.ink, 1.5}, {}}}},
        numbers, context);
}

Canvas plot_speed_over_time(const SessionNumbers& numbers, const PlotContext& context) {
    const Stroke proxy = style_of(Algorithm::dibhr).stroke;
    return plot_over_time(
        "Speed in contact over time", "speed [mm/s]",
        {{&TimePiece::goal_mm_per_s, {"goal (the hand)", {kExactInk, 4.5, Dash::solid}, {}}},
         {&TimePiece::proxy_mm_per_s, {"proxy (on the surface)", {proxy.ink, 1.5}, {}}}},
        numbers, context);
}

}  // namespace dibhr
