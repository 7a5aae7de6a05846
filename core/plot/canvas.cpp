// A small drawing surface for plots: anti-aliased lines, shapes, pictures and text.
#include "core/plot/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/error.hpp"
#include "core/plot/dashes.hpp"

namespace dibhr {
namespace {

constexpr int kScale = 2;             // drawn larger by this much
constexpr int kFractionBits = 4;      // of OpenCV's fixed-point coordinates
constexpr double kFarthest_px = 3e4;  // OpenCV's coordinates are 32 bits: nothing drawn reaches it
constexpr int kLargest_px = 16384;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kCapOfFont_px = 21.0;  // a capital letter's height at font scale 1, measured

cv::Scalar colour_of(Ink ink) {
    return {static_cast<double>(ink.red), static_cast<double>(ink.green),
            static_cast<double>(ink.blue)};
}

int thickness_of(double width_px) {
    return std::max(1, static_cast<int>(std::lround(width_px * kScale)));
}

/// The part of the enlarged drawing that may be drawn on, and the way there.
struct Region {
    cv::Mat pixels{};
    cv::Point origin{};

    /// OpenCV puts whole numbers on the middle of a pixel, the canvas on its corner.
    [[nodiscard]] cv::Point fixed(Vec2 p) const {
        const auto to_fixed = [](double at_px, int origin_px) {
            const double px =
                std::clamp(at_px * kScale - 0.5 - origin_px, -kFarthest_px, kFarthest_px);
            return static_cast<int>(std::lround(px * (1 << kFractionBits)));
        };
        return {to_fixed(p.x, origin.x), to_fixed(p.y, origin.y)};
    }

    [[nodiscard]] std::vector<cv::Point> fixed(std::span<const Vec2> points) const {
        std::vector<cv::Point> converted;
        converted.reserve(points.size());
        for (const Vec2 p : points) converted.push_back(fixed(p));
        return converted;
    }
};

cv::Rect enlarged(Box box) {
    const auto edge = [](double px) { return static_cast<int>(std::lround(px * kScale)); };
    return {cv::Point(edge(box.left), edge(box.top)), cv::Point(edge(box.right), edge(box.bottom))};
}

Region region_of(std::vector<std::uint8_t>& rgb, int columns, int rows, Box clip) {
    const cv::Mat all(rows * kScale, columns * kScale, CV_8UC3, rgb.data());
    const cv::Rect part = enlarged(clip) & cv::Rect(0, 0, all.cols, all.rows);
    return {all(part), part.tl()};
}

/// Draws with `draw(pixels)`, blended as opaque as the ink is.
template <typename Draw>
void drawn(Region& region, double opacity, Draw draw) {
    if (region.pixels.empty() || opacity <= 0.0) return;
    if (opacity >= 1.0) {
        draw(region.pixels);
        return;
    }
    cv::Mat over = region.pixels.clone();
    draw(over);
    cv::addWeighted(over, opacity, region.pixels, 1.0 - opacity, 0.0, region.pixels);
}

/// Lays ink over the pixels as far as the mask covers them; the mask's corner goes to `corner`.
void ink_through(Region& region, const cv::Mat& mask, cv::Point corner, Ink ink) {
    const cv::Rect wanted(corner - region.origin, mask.size());
    const cv::Rect part = wanted & cv::Rect(cv::Point(0, 0), region.pixels.size());
    const std::array<double, 3> colour{static_cast<double>(ink.red), static_cast<double>(ink.green),
                                       static_cast<double>(ink.blue)};
    for (int y = part.y; y < part.br().y; ++y) {
        for (int x = part.x; x < part.br().x; ++x) {
            const double cover =
                ink.opacity * mask.at<std::uint8_t>(y - wanted.y, x - wanted.x) / 255.0;
            auto& pixel = region.pixels.at<cv::Vec3b>(y, x);
            for (int k = 0; k < 3; ++k) {
                const double blended =
                    pixel[k] + cover * (colour[static_cast<std::size_t>(k)] - pixel[k]);
                pixel[k] = cv::saturate_cast<std::uint8_t>(blended);
            }
        }
    }
}

struct Lettering {
    double font_scale{1.0};
    int thickness{1};
};

Lettering lettering_of(const TextStyle& style) {
    const double cap = style.cap_px * kScale;
    return {cap / kCapOfFont_px,
            std::max(1, static_cast<int>(std::lround(cap * (style.bold ? 0.17 : 0.115))))};
}

std::vector<Vec2> shape_of(Marker marker, Vec2 c, double r) {
    switch (marker) {
        case Marker::square:
            return {{c.x - r, c.y - r}, {c.x + r, c.y - r}, {c.x + r, c.y + r}, {c.x - r, c.y + r}};
        case Marker::triangle:
            return {{c.x, c.y - 1.2 * r},
                    {c.x + 1.1 * r, c.y + 0.6 * r},
                    {c.x - 1.1 * r, c.y + 0.6 * r}};
        case Marker::diamond:
            return {{c.x, c.y - 1.3 * r},
                    {c.x + 1.3 * r, c.y},
                    {c.x, c.y + 1.3 * r},
                    {c.x - 1.3 * r, c.y}};
        case Marker::circle:
        case Marker::none:
            break;
    }
    return {};
}

/// The `part` of the picture stretched to `size`; only the part is made, for a picture may be
/// magnified far beyond the canvas.
cv::Mat stretched(const cv::Mat& picture, cv::Size size, const cv::Rect& part) {
    if (size.width < picture.cols) {
        cv::Mat whole;
        cv::resize(picture, whole, size, 0.0, 0.0, cv::INTER_AREA);
        return whole(part);
    }
    cv::Mat seen(part.size(), picture.type());
    for (int y = 0; y < part.height; ++y) {
        const auto row = std::int64_t{part.y + y} * picture.rows / size.height;
        for (int x = 0; x < part.width; ++x) {
            const auto column = std::int64_t{part.x + x} * picture.cols / size.width;
            seen.at<cv::Vec3b>(y, x) =
                picture.at<cv::Vec3b>(static_cast<int>(row), static_cast<int>(column));
        }
    }
    return seen;
}

}  // namespace

Canvas::Canvas(int columns, int rows, Ink paper) : columns_(columns), rows_(rows) {
    if (columns < 1 || rows < 1 || columns > kLargest_px || rows > kLargest_px)
        throw InputError("A picture of " + std::to_string(columns) + "x" + std::to_string(rows) +
                         " pixels cannot be drawn: choose 1 to 16384");
    rgb_.resize(static_cast<std::size_t>(columns) * kScale * static_cast<std::size_t>(rows) *
                kScale * 3);
    clip_to_whole();
    fill(whole(), with_opacity(paper, 1.0));
}

Box Canvas::whole() const noexcept {
    return {0.0, 0.0, static_cast<double>(columns_), static_cast<double>(rows_)};
}

void Canvas::clip_to(Box box) noexcept {
    const Box all = whole();
    clip_ = {std::clamp(box.left, all.left, all.right), std::clamp(box.top, all.top, all.bottom),
             std::clamp(box.right, all.left, all.right),
             std::clamp(box.bottom, all.top, all.bottom)};
}

void Canvas::line(Vec2 from, Vec2 to, const Stroke& stroke) {
    polyline(std::array{from, to}, stroke);
}

void Canvas::polyline(std::span<const Vec2> points, const Stroke& stroke) {
    if (points.size() < 2) return;
    Region region = region_of(rgb_, columns_, rows_, clip_);
    drawn(region, stroke.ink.opacity, [&](cv::Mat& pixels) {
        for (const auto& piece : dashes_of(points, stroke.dash, stroke.width_px)) {
            cv::polylines(pixels, region.fixed(piece), false, colour_of(stroke.ink),
                          thickness_of(stroke.width_px), cv::LINE_AA, kFractionBits);
        }
    });
}

void Canvas::polygon(std::span<const Vec2> corners, Ink ink) {
    if (corners.size() < 3) return;
    Region region = region_of(rgb_, columns_, rows_, clip_);
    drawn(region, ink.opacity, [&](cv::Mat& pixels) {
        cv::fillPoly(pixels, std::vector{region.fixed(corners)}, colour_of(ink), cv::LINE_AA,
                     kFractionBits);
    });
}

void Canvas::fill(Box box, Ink ink) {
    Region region = region_of(rgb_, columns_, rows_, clip_);
    const cv::Rect part = (enlarged(box) - region.origin) & cv::Rect({0, 0}, region.pixels.size());
    Region filled{region.pixels(part), region.origin + part.tl()};
    drawn(filled, ink.opacity, [&](cv::Mat& pixels) { pixels.setTo(colour_of(ink)); });
}

void Canvas::outline(Box box, const Stroke& stroke) {
    polyline(std::array<Vec2, 5>{Vec2{box.left, box.top}, Vec2{box.right, box.top},
                                 Vec2{box.right, box.bottom}, Vec2{box.left, box.bottom},
                                 Vec2{box.left, box.top}},
             stroke);
}

void Canvas::disc(Vec2 centre, double radius_px, Ink ink) {
    Region region = region_of(rgb_, columns_, rows_, clip_);
    drawn(region, ink.opacity, [&](cv::Mat& pixels) {
        cv::circle(pixels, region.fixed(centre),
                   static_cast<int>(std::lround(radius_px * kScale * (1 << kFractionBits))),
                   colour_of(ink), cv::FILLED, cv::LINE_AA, kFractionBits);
    });
}

void Canvas::ring(Vec2 centre, double radius_px, const Stroke& stroke) {
    constexpr int kSides = 180;
    constexpr double kTurn_rad = 2.0 * 3.14159265358979323846 / kSides;
    std::vector<Vec2> round;
    for (int k = 0; k <= kSides; ++k)
        round.push_back(centre +
                        radius_px * Vec2{std::cos(k * kTurn_rad), std::sin(k * kTurn_rad)});
    polyline(round, stroke);
}

void Canvas::marker(Vec2 centre, Marker marker, double size_px, Ink ink, Ink rim) {
    constexpr double kRim_px = 1.0;
    if (marker == Marker::circle) {
        disc(centre, size_px / 2.0 + kRim_px, rim);
        disc(centre, size_px / 2.0, ink);
    } else if (marker != Marker::none) {
        polygon(shape_of(marker, centre, size_px / 2.0 + 1.4 * kRim_px), rim);
        polygon(shape_of(marker, centre, size_px / 2.0), ink);
    }
}

void Canvas::picture(const ColourImage& picture, Box box, double opacity) {
    if (picture.rgb.empty()) return;
    const cv::Mat source(picture.rows, picture.columns, CV_8UC3,
                         const_cast<std::uint8_t*>(picture.rgb.data()));  // only read
    const cv::Rect place = enlarged(box);
    const Region region = region_of(rgb_, columns_, rows_, clip_);
    const cv::Rect part = (place - region.origin) & cv::Rect({0, 0}, region.pixels.size());
    if (part.empty()) return;
    const cv::Mat seen = stretched(source, place.size(), part + region.origin - place.tl());
    Region covered{region.pixels(part), {}};
    drawn(covered, opacity, [&](cv::Mat& pixels) { seen.copyTo(pixels); });
}

void Canvas::text(Vec2 where, std::string_view text, const TextStyle& style) {
    const Lettering lettering = lettering_of(style);
    const std::string letters(text);
    int below = 0;
    const cv::Size size =
        cv::getTextSize(letters, kFont, lettering.font_scale, lettering.thickness, &below);
    const int margin = lettering.thickness + 2;
    below += margin;
    cv::Mat mask = cv::Mat::zeros(size.height + margin + below, size.width + 2 * margin, CV_8UC1);
    const cv::Point start(margin, size.height + margin);
    cv::putText(mask, letters, start, kFont, lettering.font_scale, 255, lettering.thickness,
                cv::LINE_AA);

    const double part = style.align == Align::left ? 0.0 : style.align == Align::centre ? 0.5 : 1.0;
    const cv::Point baseline(static_cast<int>(std::lround(where.x * kScale)),
                             static_cast<int>(std::lround(where.y * kScale)));
    const int back = start.x + static_cast<int>(std::lround(part * size.width));
    cv::Point corner = baseline - cv::Point(back, start.y);
    if (style.upwards) {
        cv::rotate(mask, mask, cv::ROTATE_90_COUNTERCLOCKWISE);
        corner = baseline - cv::Point(start.y, mask.rows - back);
    }
    Region region = region_of(rgb_, columns_, rows_, clip_);
    ink_through(region, mask, corner, style.ink);
}

ColourImage Canvas::finished() const {
    ColourImage small{columns_, rows_, {}};
    small.rgb.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) * 3);
    const cv::Mat from(rows_ * kScale, columns_ * kScale, CV_8UC3,
                       const_cast<std::uint8_t*>(rgb_.data()));  // only read
    cv::Mat to(rows_, columns_, CV_8UC3, small.rgb.data());
    cv::resize(from, to, to.size(), 0.0, 0.0, cv::INTER_AREA);
    return small;
}

double text_width(std::string_view text, const TextStyle& style) {
    const Lettering lettering = lettering_of(style);
    int below = 0;
    const cv::Size size = cv::getTextSize(std::string(text), kFont, lettering.font_scale,
                                          lettering.thickness, &below);
    return static_cast<double>(size.width) / kScale;
}

}  // namespace dibhr
