// The heat map: where the surface was touched, over the picture that was touched longest.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/plot/axes.hpp"
#include "core/report/report_plots.hpp"

namespace dibhr {

namespace {

// ColorBrewer 2.0 (Brewer and Harrower), "YlOrRd", nine classes: marked there as safe for
// colour-blind readers; without the palest, which is lost on paper.
constexpr std::array kStops{Ink{255, 237, 160}, Ink{254, 217, 118}, Ink{254, 178, 76},
                            Ink{253, 141, 60},  Ink{252, 78, 42},   Ink{227, 26, 28},
                            Ink{189, 0, 38},    Ink{128, 0, 38}};

std::uint8_t between(std::uint8_t from, std::uint8_t to, double share) {
    return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
}

constexpr double kLeft_px = 36.0;
constexpr double kTop_px = 92.0;
constexpr double kWidth_px = 960.0;  // of the picture, at most
constexpr double kHeight_px = 960.0;
constexpr double kBarRoom_px = 190.0;
constexpr double kDecades = 2.0;  // what is shown below the longest time
constexpr int kFine = 2;          // the canvas draws at twice its size

/// The contact time from which a pixel is coloured, and that of the darkest colour [s].
struct HeatScale {
    double least_s{0.0};
    double most_s{1.0};

    /// In [0, 1]; negative for what is not coloured.
    [[nodiscard]] double share(double seconds) const {
        if (!(seconds >= least_s)) return -1.0;
        return std::log(seconds / least_s) / std::log(most_s / least_s);
    }
};

HeatScale scale_of(const PixelValues& map) {
    constexpr double kLeast_s = 1e-9;  // shorter than any tick
    const double most_s =
        std::max<double>(*std::max_element(map.values.begin(), map.values.end()), kLeast_s);
    return {most_s * std::pow(10.0, -kDecades), most_s};
}

/// A light grey, so that only the heat has a colour.
std::uint8_t ground_grey(const ColourImage& picture, double x_share, double y_share) {
    constexpr double kDarkest = 70.0;
    constexpr double kContrast = 0.62;
    const auto at = [](double share, int count) {
        return std::clamp(static_cast<int>(share * count), 0, count - 1);
    };
    const std::size_t pixel = 3 * (static_cast<std::size_t>(at(y_share, picture.rows)) *
                                       static_cast<std::size_t>(picture.columns) +
                                   static_cast<std::size_t>(at(x_share, picture.columns)));
    const double luma = 0.299 * picture.rgb[pixel] + 0.587 * picture.rgb[pixel + 1] +
                        0.114 * picture.rgb[pixel + 2];  // ITU-R BT.601
    return static_cast<std::uint8_t>(std::lround(kDarkest + kContrast * luma));
}

/// Interpolates between the four pixels around a place.
double value_at(const PixelValues& map, double x_share, double y_share) {
    const double x = std::clamp(x_share * map.columns - 0.5, 0.0, map.columns - 1.0);
    const double y = std::clamp(y_share * map.rows - 0.5, 0.0, map.rows - 1.0);
    const int i = std::min(static_cast<int>(x), std::max(map.columns - 2, 0));
    const int j = std::min(static_cast<int>(y), std::max(map.rows - 2, 0));
    const int right = std::min(i + 1, map.columns - 1);
    const int below = std::min(j + 1, map.rows - 1);
    return std::lerp(std::lerp<double>(map.at(i, j), map.at(right, j), x - i),
                     std::lerp<double>(map.at(i, below), map.at(right, below), x - i), y - j);
}

ColourImage heated(const ColourImage& picture, const PixelValues& map, HeatScale scale, int columns,
                   int rows) {
    constexpr double kOpacity = 0.88;
    ColourImage image{columns, rows, {}};
    image.rgb.reserve(3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double x = (column + 0.5) / columns;
            const double y = (row + 0.5) / rows;
            const std::uint8_t grey =
                picture.rgb.empty() ? kPlotGround.red : ground_grey(picture, x, y);
            const double share = scale.share(value_at(map, x, y));
            const double cover = share < 0.0 ? 0.0 : kOpacity;
            const Ink heat = heat_ink(share);
            for (const std::uint8_t ink : {heat.red, heat.green, heat.blue})
                image.rgb.push_back(
                    static_cast<std::uint8_t>(std::lround(grey + cover * (ink - grey))));
        }
    }
    return image;
}

Box picture_box(const HeatMapGround& ground) {
    const double size = std::min(kWidth_px / ground.columns, kHeight_px / ground.rows);
    return {kLeft_px, kTop_px, kLeft_px + std::max(1.0, std::round(size * ground.columns)),
            kTop_px + std::max(1.0, std::round(size * ground.rows))};
}

void draw_colour_bar(Canvas& canvas, Box box, HeatScale scale) {
    ColourImage colours{1, static_cast<int>(box.height()), {}};
    for (int k = 0; k < colours.rows; ++k) {
        const Ink heat = heat_ink(1.0 - (k + 0.5) / colours.rows);
        colours.rgb.insert(colours.rgb.end(), {heat.red, heat.green, heat.blue});
    }
    canvas.picture(colours, box, 1.0);
    const Stroke frame{kQuietInk, 1.0, Dash::solid};
    canvas.outline(box, frame);
    for (const double tick : close_ticks({scale.least_s, scale.most_s})) {
        const double y = box.bottom - scale.share(tick) * box.height();
        canvas.line({box.right, y}, {box.right + 5.0, y}, frame);
        canvas.text({box.right + 10.0, y + kNumberCap_px / 2.0}, tick_text(tick) + " s",
                    {kTextInk, kNumberCap_px});
    }
}

/// A bar of a round length, in millimetres and pixels.
void draw_length_bar(Canvas& canvas, Vec2 left, const HeatMapGround& ground, double px_per_pixel) {
    constexpr double kAbout_px = 110.0;
    if (!(ground.pitch_mm > 0.0)) return;  // the file may be damaged
    const double px_per_mm = px_per_pixel / ground.pitch_mm;
    const std::vector<double> lengths = round_ticks({0.0, kAbout_px / px_per_mm}, 2);
    const double length_mm = lengths.back();
    const double right = left.x + length_mm * px_per_mm;
    const Stroke bar{kTextInk, 2.0, Dash::solid};
    canvas.line(left, {right, left.y}, bar);
    for (const double x : {left.x, right}) canvas.line({x, left.y - 5.0}, {x, left.y + 5.0}, bar);
    const TextStyle words{kTextInk, kNumberCap_px};
    canvas.text({left.x, left.y + 24.0}, tick_text(length_mm) + " mm", words);
    canvas.text({left.x, left.y + 44.0}, fixed_text(length_mm / ground.pitch_mm, 1) + " px at",
                {kQuietInk, kNumberCap_px});
    canvas.text({left.x, left.y + 64.0}, fixed_text(ground.pitch_mm, 4) + " mm per px",
                {kQuietInk, kNumberCap_px});
}

/// Draws the numbers of the longest episodes at their centres, where there is room.
void number_episodes(Canvas& canvas, Box box, const HeatMapGround& ground,
                     const std::vector<Episode>& episodes, std::uint32_t media) {
    constexpr std::size_t kMostNumbers = 12;
    constexpr double kRadius_px = 12.0;
    std::vector<Vec2> taken;
    for (const std::size_t k : longest_first(episodes)) {
        if (taken.size() == kMostNumbers) break;
        const Vec2 centre = episodes[k].centre_px;
        const Vec2 at{box.left + (centre.x + 0.5) / ground.columns * box.width(),
                      box.top + (centre.y + 0.5) / ground.rows * box.height()};
        const bool free = std::all_of(taken.begin(), taken.end(), [at](Vec2 other) {
            return std::hypot(at.x - other.x, at.y - other.y) > 2.2 * kRadius_px;
        });
        if (episodes[k].media != media || !box.holds(at) || !free) continue;
        taken.push_back(at);
        canvas.disc(at, kRadius_px + 1.0, kPaper);
        canvas.disc(at, kRadius_px, kTextInk);
        canvas.text({at.x, at.y + kNumberCap_px / 2.0}, std::to_string(k + 1),
                    {kPaper, kNumberCap_px, Align::centre, true});
    }
}

}  // namespace

Ink heat_ink(double share) {
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(kStops.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const double part = at - static_cast<double>(first);
    const Ink from = kStops[first];
    const Ink to = kStops[first + 1];
    return {between(from.red, to.red, part), between(from.green, to.green, part),
            between(from.blue, to.blue, part)};
}

std::vector<double> close_ticks(ValueSpan span) {
    std::vector<double> ticks;
    for (double power = std::pow(10.0, std::floor(std::log10(span.low))); power <= span.high;
         power *= 10.0) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double tick = factor * power;
            if (tick >= span.low && tick <= span.high) ticks.push_back(tick);
        }
    }
    return ticks;
}

double heat_map_sigma_px(int columns) {
    constexpr double kColumns = 160.0;
    return std::max(1.0, std::round(2.0 * columns / kColumns) / 2.0);
}

Canvas plot_heat_map(const TouchedPlaces& places, const HeatMapGround& ground,
                     const std::vector<Episode>& episodes, std::uint32_t media,
                     const std::string& subtitle) {
    const double sigma_px = heat_map_sigma_px(ground.columns);
    const PixelValues map = places.smoothed(ground.columns, ground.rows, sigma_px);
    const HeatScale scale = scale_of(map);
    const Box box = picture_box(ground);
    constexpr double kLeastHeight_px = 560.0;  // for the scales
    const double bottom = std::max(box.bottom, kTop_px + kLeastHeight_px);
    Canvas canvas(static_cast<int>(std::max(box.right, kLeft_px + 700.0) + kBarRoom_px),
                  static_cast<int>(bottom + 56.0), kPaper);
    draw_title(canvas, "Where the surface was touched, and for how long", subtitle);
    canvas.picture(heated(ground.picture, map, scale, kFine * static_cast<int>(box.width()),
                          kFine * static_cast<int>(box.height())),
                   box, 1.0);
    canvas.outline(box, {kQuietInk, 1.0, Dash::solid});
    number_episodes(canvas, box, ground, episodes, media);
    const double right = box.right + 28.0;
    canvas.text({right, box.top + 12.0}, "contact time", {kTextInk, kLabelCap_px});
    canvas.text({right, box.top + 32.0}, "per pixel", {kTextInk, kLabelCap_px});
    draw_colour_bar(canvas, {right, box.top + 52.0, right + 24.0, box.top + 400.0}, scale);
    draw_length_bar(canvas, {right, box.top + 450.0}, ground, box.width() / ground.columns);
    canvas.text({kLeft_px, bottom + 30.0},
                "Spread by a Gaussian of " + tick_text(sigma_px) +
                    " px (standard deviation); numbers: the longest contacts, at their centres",
                {kQuietInk, kNumberCap_px});
    return canvas;
}

}  // namespace dibhr
