// The drawing is recorded by cairo and replayed on an image, an SVG or a PDF; pango sets the text.
#include "core/plot/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/sources/picture_files.hpp"

namespace dibhr {
namespace {

constexpr int kScale = 2;  // of a PNG while it is drawn: cairo puts letters on whole pixels
constexpr int kLargest_px = 16383;    // half of cairo's largest image
constexpr double kFarthest_px = 3e4;  // cairo's coordinates are 24 bits: nothing drawn reaches it
constexpr double kPoint_per_px = 0.425;  // 1200 px are 180 mm, a paper's two columns
constexpr const char* kFonts = "DejaVu Sans, Sans";

template <auto kFree>
struct Freed {
    template <typename T>
    void operator()(T* object) const noexcept {
        kFree(object);
    }
};
/// Finishes a surface before it is destroyed: cairo leaks a recording that an SVG was made of.
void end_surface(cairo_surface_t* surface) noexcept {
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
}
using Surface = std::unique_ptr<cairo_surface_t, Freed<end_surface>>;
using Pen = std::unique_ptr<cairo_t, Freed<cairo_destroy>>;
using Layout = std::unique_ptr<PangoLayout, Freed<g_object_unref>>;

/// Letters keep their shapes and distances at every scale.
Layout layout_of(std::string_view text, double size_px, bool bold) {
    const std::unique_ptr<PangoContext, Freed<g_object_unref>> context(
        pango_font_map_create_context(pango_cairo_font_map_get_default()));
    const std::unique_ptr<cairo_font_options_t, Freed<cairo_font_options_destroy>> options(
        cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(context.get(), options.get());
    const std::unique_ptr<PangoFontDescription, Freed<pango_font_description_free>> font(
        pango_font_description_from_string(kFonts));
    pango_font_description_set_weight(font.get(), bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_font_description_set_absolute_size(font.get(), size_px * PANGO_SCALE);
    Layout layout(pango_layout_new(context.get()));
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_auto_dir(layout.get(), FALSE);
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
    const std::string letters = utf8_text(text);
    pango_layout_set_text(layout.get(), letters.data(), static_cast<int>(letters.size()));
    return layout;
}

/// The font size at which a capital letter is so high.
double size_of(const TextStyle& style) {
    static const double cap_per_size = [] {
        constexpr double kLarge_px = 1000.0;
        PangoRectangle ink{};
        pango_layout_get_pixel_extents(layout_of("H", kLarge_px, false).get(), &ink, nullptr);
        return ink.height > 0 ? ink.height / kLarge_px : 0.73;
    }();
    return style.cap_px / cap_per_size;
}

double width_of(PangoLayout* layout) {
    int width = 0;
    pango_layout_get_size(layout, &width, nullptr);
    return static_cast<double>(width) / PANGO_SCALE;
}

void set_ink(cairo_t* pen, Ink ink) {
    cairo_set_source_rgba(pen, ink.red / 255.0, ink.green / 255.0, ink.blue / 255.0, ink.opacity);
}

/// Lengths of line and gap by turns, in widths of the line; ends are round, so a dot is short.
std::vector<double> pattern_of(Dash dash) {
    switch (dash) {
        case Dash::dashed:
            return {4.0, 3.0};
        case Dash::dotted:
            return {0.1, 2.4};
        case Dash::dash_dot:
            return {4.5, 2.4, 0.1, 2.4};
        case Dash::solid:
            break;
    }
    return {};
}

void stroke_path(cairo_t* pen, const Stroke& stroke) {
    std::vector<double> dashes = pattern_of(stroke.dash);
    for (double& length : dashes) length *= stroke.width_px;
    cairo_set_dash(pen, dashes.data(), static_cast<int>(dashes.size()), 0.0);
    cairo_set_line_width(pen, stroke.width_px);
    set_ink(pen, stroke.ink);
    cairo_stroke(pen);
}

std::vector<Vec2> shape_of(Marker marker, Vec2 c, double r) {
    switch (marker) {
        case Marker::square:
            return {{c.x - r, c.y - r}, {c.x + r, c.y - r}, {c.x + r, c.y + r}, {c.x - r, c.y + r}};
        case Marker::triangle:
            return {{c.x, c.y - 1.2 * r},
                    {c.x + 1.15 * r, c.y + 0.6 * r},
                    {c.x - 1.15 * r, c.y + 0.6 * r}};
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

Vec2 reachable(Vec2 p) {
    return glm::clamp(p, Vec2(-kFarthest_px), Vec2(kFarthest_px));
}

void path_through(cairo_t* pen, std::span<const Vec2> points) {
    constexpr double kNear_px = 0.1;  // nearer to the point before: not visible
    Vec2 last = reachable(points.front());
    cairo_move_to(pen, last.x, last.y);
    for (std::size_t k = 1; k < points.size(); ++k) {
        const Vec2 next = reachable(points[k]);
        if (k + 1 < points.size() && glm::distance(last, next) < kNear_px) continue;
        cairo_line_to(pen, next.x, next.y);
        last = next;
    }
}

/// Which of `count` pixels, spread from `low` to `high`, can be seen between `first` and `last`.
std::pair<int, int> seen_pixels(int count, double low, double high, double first, double last) {
    const double each = (high - low) / count;
    const auto pixel = [&](double at) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count)));
    };
    return {pixel(std::floor((first - low) / each)), pixel(std::ceil((last - low) / each))};
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int count) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), count);
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string_view name_of(PlotFormat format) noexcept {
    switch (format) {
        case PlotFormat::png:
            return "png";
        case PlotFormat::svg:
            return "svg";
        case PlotFormat::pdf:
            break;
    }
    return "pdf";
}

struct Canvas::Drawing {
    int columns;
    int rows;
    Box clip{};
    Surface recording{};
    Pen pen{};
    std::string texts{};  ///< as SVG has them: cairo writes shapes, which nobody can search

    /// Replays the drawing, larger by `scale`.
    void replay(cairo_surface_t* target, double scale) const {
        const Pen onto(cairo_create(target));
        cairo_scale(onto.get(), scale, scale);
        cairo_set_source_surface(onto.get(), recording.get(), 0.0, 0.0);
        cairo_paint(onto.get());
    }

    [[nodiscard]] std::string svg() const {
        std::string bytes;
        const Surface target(cairo_svg_surface_create_for_stream(append, &bytes, columns, rows));
        cairo_svg_surface_set_document_unit(target.get(), CAIRO_SVG_UNIT_PX);
        replay(target.get(), 1.0);
        cairo_surface_finish(target.get());
        const auto end = bytes.rfind("</svg>");
        if (end != std::string::npos) {
            bytes.insert(end, "<g fill-opacity=\"0\" font-family=\"" + std::string(kFonts) +
                                  "\">\n" + texts + "</g>\n");
        }
        return bytes;
    }

    [[nodiscard]] std::string pdf() const {
        std::string bytes;
        const Surface target(cairo_pdf_surface_create_for_stream(
            append, &bytes, kPoint_per_px * columns, kPoint_per_px * rows));
        cairo_pdf_surface_restrict_to_version(target.get(), CAIRO_PDF_VERSION_1_4);  // any reader's
        // Any fixed moment: the same drawing gives the same file.
        cairo_pdf_surface_set_metadata(target.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                       "2000-01-01T00:00:00Z");
        replay(target.get(), kPoint_per_px);
        cairo_surface_finish(target.get());
        return bytes;
    }
};

Canvas::Canvas(int columns, int rows, Ink paper) {
    if (columns < 1 || rows < 1 || columns > kLargest_px || rows > kLargest_px)
        throw InputError("A picture of " + std::to_string(columns) + "x" + std::to_string(rows) +
                         " pixels cannot be drawn: choose 1 to " + std::to_string(kLargest_px));
    const cairo_rectangle_t extent{0.0, 0.0, static_cast<double>(columns),
                                   static_cast<double>(rows)};
    drawing_ = std::make_unique<Drawing>(Drawing{columns, rows});
    drawing_->recording.reset(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extent));
    drawing_->pen.reset(cairo_create(drawing_->recording.get()));
    cairo_set_line_cap(drawing_->pen.get(), CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(drawing_->pen.get(), CAIRO_LINE_JOIN_ROUND);
    clip_to_whole();
    paper.opacity = 1.0;
    fill(whole(), paper);
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&& other) noexcept = default;

Box Canvas::whole() const noexcept {
    return {0.0, 0.0, static_cast<double>(drawing_->columns), static_cast<double>(drawing_->rows)};
}

void Canvas::clip_to(Box box) noexcept {
    const Box all = whole();
    drawing_->clip = {
        std::clamp(box.left, all.left, all.right), std::clamp(box.top, all.top, all.bottom),
        std::clamp(box.right, all.left, all.right), std::clamp(box.bottom, all.top, all.bottom)};
    const Box& clip = drawing_->clip;
    cairo_t* pen = drawing_->pen.get();
    cairo_reset_clip(pen);
    cairo_rectangle(pen, clip.left, clip.top, clip.width(), clip.height());
    cairo_clip(pen);
}

void Canvas::line(Vec2 from, Vec2 to, const Stroke& stroke) {
    polyline(std::array{from, to}, stroke);
}

void Canvas::polyline(std::span<const Vec2> points, const Stroke& stroke) {
    if (points.size() < 2) return;
    path_through(drawing_->pen.get(), points);
    stroke_path(drawing_->pen.get(), stroke);
}

void Canvas::polygon(std::span<const Vec2> corners, Ink ink) {
    if (corners.size() < 3) return;
    path_through(drawing_->pen.get(), corners);
    set_ink(drawing_->pen.get(), ink);
    cairo_fill(drawing_->pen.get());
}

void Canvas::fill(Box box, Ink ink) {
    polygon(std::array<Vec2, 4>{Vec2{box.left, box.top}, Vec2{box.right, box.top},
                                Vec2{box.right, box.bottom}, Vec2{box.left, box.bottom}},
            ink);
}

void Canvas::outline(Box box, const Stroke& stroke) {
    cairo_rectangle(drawing_->pen.get(), box.left, box.top, box.width(), box.height());
    stroke_path(drawing_->pen.get(), stroke);
}

void Canvas::disc(Vec2 centre, double radius_px, Ink ink) {
    cairo_arc(drawing_->pen.get(), centre.x, centre.y, radius_px, 0.0, 2.0 * std::numbers::pi);
    set_ink(drawing_->pen.get(), ink);
    cairo_fill(drawing_->pen.get());
}

void Canvas::ring(Vec2 centre, double radius_px, const Stroke& stroke) {
    cairo_arc(drawing_->pen.get(), centre.x, centre.y, radius_px, 0.0, 2.0 * std::numbers::pi);
    stroke_path(drawing_->pen.get(), stroke);
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
    const Box& clip = drawing_->clip;
    const auto [left, right] =
        seen_pixels(picture.columns, box.left, box.right, clip.left, clip.right);
    const auto [top, bottom] =
        seen_pixels(picture.rows, box.top, box.bottom, clip.top, clip.bottom);
    if (picture.rgb.empty() || left >= right || top >= bottom) return;
    const Surface seen(cairo_image_surface_create(CAIRO_FORMAT_RGB24, right - left, bottom - top));
    for (int row = top; row < bottom; ++row) {
        const std::uint8_t* rgb = &picture.rgb[3 * (static_cast<std::size_t>(row) *
                                                        static_cast<std::size_t>(picture.columns) +
                                                    static_cast<std::size_t>(left))];
        auto* pixels = reinterpret_cast<std::uint32_t*>(
            cairo_image_surface_get_data(seen.get()) +
            static_cast<std::ptrdiff_t>(row - top) * cairo_image_surface_get_stride(seen.get()));
        for (int column = left; column < right; ++column, rgb += 3) {
            *pixels++ = std::uint32_t{rgb[0]} << 16U | std::uint32_t{rgb[1]} << 8U | rgb[2];
        }
    }
    cairo_surface_mark_dirty(seen.get());
    cairo_t* pen = drawing_->pen.get();
    const bool enlarged = box.width() > picture.columns;
    cairo_save(pen);
    cairo_translate(pen, box.left, box.top);
    cairo_scale(pen, box.width() / picture.columns, box.height() / picture.rows);
    cairo_set_source_surface(pen, seen.get(), left, top);
    cairo_pattern_set_filter(cairo_get_source(pen),
                             enlarged ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
    cairo_paint_with_alpha(pen, opacity);
    cairo_restore(pen);
}

void Canvas::text(Vec2 where, std::string_view text, const TextStyle& style) {
    cairo_t* pen = drawing_->pen.get();
    const double size_px = size_of(style);
    const Layout layout = layout_of(text, size_px, style.bold);
    const double width_px = width_of(layout.get());
    const double part = style.align == Align::left ? 0.0 : style.align == Align::centre ? 0.5 : 1.0;
    cairo_save(pen);
    cairo_translate(pen, where.x, where.y);
    if (style.upwards) cairo_rotate(pen, -std::numbers::pi / 2.0);
    cairo_move_to(pen, -part * width_px, 0.0);
    set_ink(pen, style.ink);
    pango_cairo_show_layout_line(pen, pango_layout_get_line_readonly(layout.get(), 0));
    cairo_new_path(pen);  // no line from the text's end to what is drawn next
    cairo_restore(pen);
    const auto number = [](double value) { return std::to_string(std::lround(value)); };
    const std::string x = number(where.x - (style.upwards ? 0.0 : part * width_px));
    const std::string y = number(where.y + (style.upwards ? part * width_px : 0.0));
    drawing_->texts += "<text x=\"" + x + "\" y=\"" + y + "\" font-size=\"" + number(size_px) +
                       "\" textLength=\"" + number(width_px) + "\"" +
                       (style.upwards ? " transform=\"rotate(-90 " + x + " " + y + ")\"" : "") +
                       ">" + html_text(text) + "</text>\n";
}

ColourImage Canvas::finished() const {
    const auto [columns, rows] = std::pair(drawing_->columns, drawing_->rows);
    const Surface large(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns * kScale, rows * kScale));
    drawing_->replay(large.get(), kScale);
    cairo_surface_flush(large.get());
    ColourImage small{columns, rows, {}};
    small.rgb.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 3);
    const unsigned char* pixels = cairo_image_surface_get_data(large.get());
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(large.get());
    for (int row = 0; row < rows; ++row) {
        const unsigned char* both = pixels + std::ptrdiff_t{kScale} * row * stride;
        const auto* upper = reinterpret_cast<const std::uint32_t*>(both);
        const auto* lower = reinterpret_cast<const std::uint32_t*>(both + stride);
        for (int column = 0; column < columns; ++column, upper += kScale, lower += kScale) {
            for (const unsigned shift : {16U, 8U, 0U}) {
                unsigned sum = 2;  // half of what it is divided by
                for (const std::uint32_t pixel : {upper[0], upper[1], lower[0], lower[1]}) {
                    sum += pixel >> shift & 255U;
                }
                small.rgb.push_back(static_cast<std::uint8_t>(sum / 4U));
            }
        }
    }
    return small;
}

std::string Canvas::encoded(PlotFormat format) const {
    switch (format) {
        case PlotFormat::png:
            return png_of(finished());
        case PlotFormat::svg:
            return drawing_->svg();
        case PlotFormat::pdf:
            break;
    }
    return drawing_->pdf();
}

double text_width(std::string_view text, const TextStyle& style) {
    return width_of(layout_of(text, size_of(style), style.bold).get());
}

}  // namespace dibhr
