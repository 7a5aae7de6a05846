// A plot's frame: axes with round tick marks, and the mapping from values to the canvas.
#include "core/plot/axes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr double kTick_px = 5.0;

/// Whether a tick on the span's end counts as inside despite round-off.
bool inside(double value, ValueSpan span) {
    const double slack = 1e-9 * (span.high - span.low);
    return value >= span.low - slack && value <= span.high + slack;
}

ValueSpan ascending(ValueSpan span) {
    return {std::min(span.low, span.high), std::max(span.low, span.high)};
}

double share(double value, const Axis& axis) {
    const auto [low, high] = axis.span;
    if (!axis.logarithmic) return (value - low) / (high - low);
    const double positive = value > 0.0 ? value : std::min(low, high);
    return std::log(positive / low) / std::log(high / low);
}

std::string number_at(double tick, const Axis& axis) {
    return axis.logarithmic ? decade_text(tick) : tick_text(tick);
}

void choose_ticks(Axis& axis) {
    if (!axis.ticks.empty()) return;
    const ValueSpan span = ascending(axis.span);
    axis.ticks =
        axis.logarithmic ? decade_ticks(span, axis.most_ticks) : round_ticks(span, axis.most_ticks);
}

/// Adds the values of one pixel column: all if they are few, else first, range and last.
void add_column(std::vector<Vec2>& line, std::span<const Vec2> column) {
    if (column.size() <= 4) {
        line.insert(line.end(), column.begin(), column.end());
        return;
    }
    const auto [lowest, highest] =
        std::minmax_element(column.begin(), column.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; });
    line.insert(line.end(), {column.front(), *lowest, *highest, column.back()});
}

std::vector<Vec2> thinned(std::span<const Vec2> points) {
    std::vector<Vec2> line;
    std::size_t begin = 0;
    for (std::size_t k = 1; k <= points.size(); ++k) {
        if (k < points.size() && std::floor(points[k].x) == std::floor(points[begin].x)) continue;
        add_column(line, points.subspan(begin, k - begin));
        begin = k;
    }
    return line;
}

// Okabe and Ito, "Color Universal Design" (2008): distinct for every common kind of colour vision.
constexpr Ink kBlue{0, 114, 178};
constexpr Ink kVermillion{213, 94, 0};
constexpr Ink kGreen{0, 158, 115};
constexpr Ink kPurple{204, 121, 167};

}  // namespace

std::vector<double> round_ticks(ValueSpan span, int most) {
    const double rough = (span.high - span.low) / std::max(most, 2);
    if (!(rough > 0.0) || !std::isfinite(rough)) return {span.low};
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0}) {
        const double step = factor * power;
        std::vector<double> ticks;
        for (double n = std::ceil(span.low / step - 1e-9); inside(n * step, span); n += 1.0) {
            ticks.push_back(n * step);
        }
        if (static_cast<int>(ticks.size()) <= std::max(most, 2)) return ticks;
    }
    return {};
}

std::vector<double> decade_ticks(ValueSpan span, int most) {
    const int first = static_cast<int>(std::ceil(std::log10(span.low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(span.high) + 1e-9));
    const int step = std::max(1, (last - first) / std::max(most - 1, 1) +
                                     ((last - first) % std::max(most - 1, 1) == 0 ? 0 : 1));
    std::vector<double> ticks;
    for (int power = last; power >= first; power -= step) ticks.push_back(std::pow(10.0, power));
    std::reverse(ticks.begin(), ticks.end());
    return ticks;
}

std::string tick_text(double value) {
    std::string shown = short_text(std::abs(value) < 1e-300 ? 0.0 : value, 4);
    // short_text writes 1e-05: one digit less means the same.
    if (const auto e = shown.find("e-0"); e != std::string::npos) shown.erase(e + 2, 1);
    if (const auto e = shown.find("e+0"); e != std::string::npos) shown.erase(e + 1, 2);
    return shown;
}

std::string fixed_text(double value, int digits) {
    return value == 0.0 ? "0" : number_text(value, digits);
}

std::string decade_text(double value) {
    if (value > 0.009 && value < 1e4) return tick_text(value);
    return "1e" + std::to_string(std::lround(std::log10(value)));
}

Axes::Axes(Box area, Axis x, Axis y) : area_(area), x_(std::move(x)), y_(std::move(y)) {
    choose_ticks(x_);
    choose_ticks(y_);
}

Vec2 Axes::at(double x, double y) const noexcept {
    return {area_.left + share(x, x_) * area_.width(),
            area_.bottom - share(y, y_) * area_.height()};
}

Vec2 Axes::sharp_at(double x, double y) const noexcept {
    return glm::floor(at(x, y)) + 0.5;
}

void Axes::draw_ground(Canvas& canvas) const {
    canvas.fill(area_, kPlotGround);
    const Stroke grid{kGridInk, 1.0, Dash::solid};
    for (const double tick : x_.ticks) {
        const double x = sharp_at(tick, y_.span.low).x;
        canvas.line({x, area_.top}, {x, area_.bottom}, grid);
    }
    for (const double tick : y_.ticks) {
        const double y = sharp_at(x_.span.low, tick).y;
        canvas.line({area_.left, y}, {area_.right, y}, grid);
    }
}

void Axes::draw_frame(Canvas& canvas) const {
    const Stroke frame{kQuietInk, 1.0, Dash::solid};
    const Vec2 corner = glm::floor(Vec2(area_.left, area_.top)) + 0.5;
    const Vec2 far = glm::floor(Vec2(area_.right, area_.bottom)) + 0.5;
    canvas.outline({corner.x, corner.y, far.x, far.y}, frame);
    const TextStyle numbers{kTextInk, kNumberCap_px, Align::centre};
    for (const double tick : x_.ticks) {
        const double x = sharp_at(tick, y_.span.low).x;
        canvas.line({x, area_.bottom}, {x, area_.bottom + kTick_px}, frame);
        if (x_.numbered) canvas.text({x, area_.bottom + 18.0}, number_at(tick, x_), numbers);
    }
    TextStyle right = numbers;
    right.align = Align::right;
    double widest_px = 0.0;
    for (const double tick : y_.ticks) {
        const double y = sharp_at(x_.span.low, tick).y;
        canvas.line({area_.left - kTick_px, y}, {area_.left, y}, frame);
        if (!y_.numbered) continue;
        const std::string text = number_at(tick, y_);
        canvas.text({area_.left - kTick_px - 4.0, y + kNumberCap_px / 2.0}, text, right);
        widest_px = std::max(widest_px, text_width(text, right));
    }
    TextStyle label{kTextInk, kLabelCap_px, Align::centre};
    canvas.text({(area_.left + area_.right) / 2.0, area_.bottom + (x_.numbered ? 38.0 : 20.0)},
                x_.label, label);
    label.upwards = true;
    canvas.text({area_.left - kTick_px - widest_px - 14.0, (area_.top + area_.bottom) / 2.0},
                y_.label, label);
}

void Axes::draw_series(Canvas& canvas, std::span<const Vec2> values, const Stroke& stroke) const {
    canvas.clip_to(area_);
    std::vector<Vec2> piece;
    const auto draw_piece = [&] {
        canvas.polyline(thinned(piece), stroke);
        piece.clear();
    };
    for (const Vec2 value : values) {
        if (std::isnan(value.y))
            draw_piece();
        else
            piece.push_back(at(value));
    }
    draw_piece();
    canvas.clip_to_whole();
}

SeriesStyle style_of(Algorithm algorithm) {
    const char* const name = entry_of(name_table(algorithm), algorithm).label;
    switch (algorithm) {
        case Algorithm::dibhr:
            return {name, {kBlue, 2.5, Dash::solid}, Marker::circle};
        case Algorithm::pga:
            return {name, {kVermillion, 2.0, Dash::dashed}, Marker::triangle};
        case Algorithm::neighborhood:
            return {name, {kGreen, 2.0, Dash::dash_dot}, Marker::diamond};
        case Algorithm::god_object:
            return {name, {kPurple, 2.5, Dash::dotted}, Marker::square};
    }
    return {};
}

void draw_legend(Canvas& canvas, Vec2 corner, const std::vector<SeriesStyle>& entries) {
    constexpr double kRow_px = 26.0;
    constexpr double kSample_px = 46.0;
    const TextStyle style{kTextInk, kLabelCap_px};
    double y = corner.y + kRow_px / 2.0;
    for (const SeriesStyle& entry : entries) {
        canvas.line({corner.x, y}, {corner.x + kSample_px, y}, entry.stroke);
        canvas.marker({corner.x + kSample_px / 2.0, y}, entry.marker, 10.0, entry.stroke.ink,
                      kPaper);
        canvas.text({corner.x + kSample_px + 12.0, y + style.cap_px / 2.0}, entry.name, style);
        y += kRow_px;
    }
}

void draw_title(Canvas& canvas, const std::string& title, const std::string& settings) {
    constexpr double kLeft_px = 36.0;
    canvas.text({kLeft_px, 38.0}, title, {kTextInk, kTitleCap_px, Align::left, true});
    canvas.text({kLeft_px, 64.0}, settings, {kQuietInk, kLabelCap_px});
}

}  // namespace dibhr
