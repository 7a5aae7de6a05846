// A surface dilated by a ball is made of pieces: every TRIANGLE moved by the radius along its
// normal, a part of a cylinder around every convex EDGE, a part of a ball around every convex
// VERTEX. Each piece lies over few pixels, together they cover every pixel, and the highest piece
// over a pixel is where the ball rests. On a smooth surface that is about one candidate a pixel
// whatever the radius. A candidate too many does no harm, as each is a point of the surface that
// the ball must not enter. So the code first leaves out pieces, with generous rounding: those not
// convex, those deeper than a ball can get (squares.hpp), and of pieces over many pixels the part
// where the ball would enter the surface nearby (narrowing.hpp).
#include "core/video/cleaning/fingertip.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/video/cleaning/fingertip/ball.hpp"
#include "core/video/cleaning/fingertip/edges.hpp"
#include "core/video/cleaning/fingertip/squares.hpp"
#include "core/video/cleaning/fingertip/triangles.hpp"
#include "core/video/cleaning/fingertip/vertices.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

using namespace fingertip;

/// A wide ball is two dilations: radius of the first ball, in the pixel steps of the second.
constexpr double kSmoothSteps = 4.0;

/// Largest level, from 0 [px, level]: beyond, the square of a slope would overflow.
constexpr double kMost_px = 1e17;
constexpr double kMost_level = 1e30;
constexpr int kPadding_px = 10;  ///< beyond the ball's reach, as eight pixels are raised at once

/// Every `step`-th pixel in both directions, up to or beyond the last one.
DepthImage thinned_out(const DepthImage& fine, int step) {
    const int columns = (fine.columns + step - 2) / step + 1;
    const int rows = (fine.rows + step - 2) / step + 1;
    return image_of(columns, rows, fine.highest_level, [&fine, step](int i, int j) {
        return fine.at(std::min(i * step, fine.columns - 1), std::min(j * step, fine.rows - 1));
    });
}

/// Raises every pixel to the level between the four pixels of a coarse image around it.
void raise_between(const DepthImage& coarse, int step, DepthImage& fine) {
    for (int j = 0; j < fine.rows; ++j) {
        const int y = std::min(j / step, coarse.rows - 2);
        const float share_y = static_cast<float>(j - y * step) / static_cast<float>(step);
        for (int i = 0; i < fine.columns; ++i) {
            const int x = std::min(i / step, coarse.columns - 2);
            const float share_x = static_cast<float>(i - x * step) / static_cast<float>(step);
            const float above = std::lerp(coarse.at(x, y), coarse.at(x + 1, y), share_x);
            const float below = std::lerp(coarse.at(x, y + 1), coarse.at(x + 1, y + 1), share_x);
            fine.at(i, j) = std::max(fine.at(i, j), std::lerp(above, below, share_y));
        }
    }
}

struct Range {
    float highest;
    bool touchable;  ///< every level is a number, and no slope's square overflows
};

DIBHR_VECTOR_CLONES Range range_of(const float* __restrict levels, std::size_t count, float most) {
    constexpr std::size_t kLanes = 16;
    std::array<float, kLanes> highest;
    std::array<int, kLanes> beyond{};
    highest.fill(levels[0]);
    for (std::size_t i = 0; i + kLanes <= count; i += kLanes) {
        for (std::size_t l = 0; l < kLanes; ++l) {
            const float level = levels[i + l];
            highest[l] = highest[l] > level ? highest[l] : level;
            beyond[l] |= std::fabs(level) <= most ? 0 : 1;
        }
    }
    for (std::size_t i = count - count % kLanes; i < count; ++i) {
        highest[0] = highest[0] > levels[i] ? highest[0] : levels[i];
        beyond[0] |= std::fabs(levels[i]) <= most ? 0 : 1;
    }
    return {*std::max_element(highest.begin(), highest.end()),
            *std::max_element(beyond.begin(), beyond.end()) == 0};
}

DIBHR_VECTOR_CLONES void copy_up_to(float most, const float* __restrict from, std::size_t count,
                                    float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = from[i] < most ? from[i] : most;
}

}  // namespace

struct FingertipDilation::Scratch {
    int columns{0}, rows{0};
    Ball ball{};
    PaddedImage touched{}, felt{};  ///< the given image, and the dilated one
    CellRow above{}, below{};
    Triangles triangles{};
    EdgePass in_rows{}, in_columns{}, diagonal{};
    VertexPass vertices{};
    Squares squares{};
    const float* ground{nullptr};  ///< of the row

    void prepare(const DepthImage& image, const Fingertip& finger);
    void dilate();
    void raise_by_cells(int row);
    void raise_by_row(int row);
    [[nodiscard]] DepthImage cropped(const DepthImage& image, float most) const;
};

void FingertipDilation::Scratch::prepare(const DepthImage& image, const Fingertip& finger) {
    columns = image.columns;
    rows = image.rows;
    ball = Ball(finger, image.highest_level);
    const int padding = static_cast<int>(ball.radius_px) + kPadding_px;
    touched.fit(columns, rows, padding, kNothing);
    felt.fit(columns, rows, padding, kNothing);
    touched.copy(image);
    felt.copy(image);
    const int pitch = felt.pitch();
    triangles.prepare(ball, columns, pitch);
    in_rows.prepare(ball, edges_in_rows(pitch), columns);
    in_columns.prepare(ball, edges_in_columns(pitch), columns);
    diagonal.prepare(ball, diagonal_edges(pitch), columns);
    vertices.prepare(ball, columns, pitch);
}

void FingertipDilation::Scratch::dilate() {
    above.make_wall(columns, ball.radius, -1.0F);
    squares.find(touched, columns, rows, ball);
    for (int row = 0; row < rows; ++row) {
        ground = squares.ground(row);
        if (row + 1 < rows)
            raise_by_cells(row);
        else
            below.make_wall(columns, ball.radius, 1.0F);
        raise_by_row(row);
        std::swap(above, below);
    }
}

/// Raises pixels by the TRIANGLEs of the cells below a row, and the EDGEs inside and between them.
void FingertipDilation::Scratch::raise_by_cells(int row) {
    const auto cells = static_cast<std::size_t>(columns - 1);
    triangles.move(touched.pixel(0, row), touched.pixel(0, row + 1), below);
    triangles.raise(felt.pixel(0, row));
    in_columns.raise(below.far.x.data(), below.near.x.data(), touched.pixel(0, row), ground,
                     cells + 1, felt.pixel(0, row));
    diagonal.raise(below.near.both.data(), below.far.both.data() + 1, touched.pixel(1, row), ground,
                   cells, felt.pixel(1, row));
}

/// Raises pixels by a row's EDGEs and VERTICES.
void FingertipDilation::Scratch::raise_by_row(int row) {
    const auto cells = static_cast<std::size_t>(columns - 1);
    in_rows.raise(above.far.y.data() + 1, below.near.y.data(), touched.pixel(0, row), ground, cells,
                  felt.pixel(0, row));
    vertices.raise(touched.pixel(0, row), ground, felt.pixel(0, row));
}

/// Without the padding, and with levels that rounding has raised too far cut to `most`.
DepthImage FingertipDilation::Scratch::cropped(const DepthImage& image, float most) const {
    DepthImage dilated{columns, rows, image.highest_level, {}};
    dilated.levels.resize(image.levels.size());
    for (int j = 0; j < rows; ++j)
        copy_up_to(most, felt.pixel(0, j), static_cast<std::size_t>(columns),
                   dilated.levels.data() + dilated.index(0, j));
    return dilated;
}

FingertipDilation::FingertipDilation() : scratch_(std::make_unique<Scratch>()) {}
FingertipDilation::~FingertipDilation() = default;
FingertipDilation::FingertipDilation(FingertipDilation&&) noexcept = default;
FingertipDilation& FingertipDilation::operator=(FingertipDilation&&) noexcept = default;

DepthImage FingertipDilation::exactly_dilated(const DepthImage& image, const Fingertip& finger) {
    const double most_level = kMost_px * image.highest_level / finger.relief_px;
    const Range range = range_of(image.levels.data(), image.levels.size(),
                                 static_cast<float>(std::min(most_level, kMost_level)));
    assert(range.touchable);
    if (!range.touchable) return image;
    scratch_->prepare(image, finger);
    scratch_->dilate();
    return scratch_->cropped(image, range.highest);
}

/// One ball dilates like two after each other whose radii add up to its own. After the first one
/// the surface is smooth enough to be thinned out.
DepthImage FingertipDilation::dilated(const DepthImage& image, const Fingertip& finger) {
    assert(image.columns >= 2 && image.rows >= 2);
    if (!(finger.radius_px > 0.0) || !(finger.relief_px > 0.0)) return image;
    const double radius_px = std::min(finger.radius_px, kWidestFinger_px);
    if (radius_px <= kWidestExactFinger_px) return exactly_dilated(image, finger);
    const int step = static_cast<int>(std::ceil(radius_px / kWidestExactFinger_px));
    const double first_px = kSmoothSteps * step;
    DepthImage fine = exactly_dilated(image, {first_px, finger.relief_px});
    const Fingertip rest{(radius_px - first_px) / step, finger.relief_px / step};
    raise_between(exactly_dilated(thinned_out(fine, step), rest), step, fine);
    return fine;
}

}  // namespace dibhr
