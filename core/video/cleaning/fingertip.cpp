// A surface dilated by a ball is made of pieces: every TRIANGLE moved by the radius along its
// normal, a part of a cylinder around every convex EDGE, a part of a ball around every convex
// VERTEX. Each piece lies over few pixels, together they cover every pixel, and the highest piece
// over a pixel is where the ball rests. On a smooth surface that is about one candidate a pixel
// whatever the radius. A candidate too many does no harm, as each is a point of the surface that
// the ball must not enter. So the code first leaves out pieces, with generous rounding: those not
// convex, those deeper than a ball can get (grounds.hpp), and of pieces over many pixels the part
// where the ball would enter the surface nearby (narrowing.hpp).
#include "core/video/cleaning/fingertip.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <future>
#include <utility>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"
#include "core/video/cleaning/fingertip/edges.hpp"
#include "core/video/cleaning/fingertip/grounds.hpp"
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
constexpr int kLarge_px = 300'000;  ///< a smaller area is dilated in the time of a thread's start
constexpr int kPadding_px = 10;     ///< beyond the ball's reach, as eight pixels are raised at once

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

/// Levels that rounding has raised too far are cut to `most`.
DIBHR_VECTOR_CLONES void copy_up_to(float most, const float* __restrict from, std::size_t count,
                                    float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = from[i] < most ? from[i] : most;
}

/// Pixels from `left` to before `right`, and so on.
struct Area {
    int left, right, top, bottom;

    [[nodiscard]] bool is_empty() const { return left >= right || top >= bottom; }
    /// With as many more pixels on all sides, as far as they are in an image of that size.
    [[nodiscard]] Area widened(int more, int columns, int rows) const {
        return {std::max(left - more, 0), std::min(right + more, columns), std::max(top - more, 0),
                std::min(bottom + more, rows)};
    }
};

/// Copies the image over the one before, and returns where they differed.
Area replace(PaddedImage& before, const DepthImage& image) {
    const auto columns = static_cast<std::size_t>(image.columns);
    Area changed{image.columns, 0, image.rows, 0};
    for (int row = 0; row < image.rows; ++row) {
        float* const old = before.pixel(0, row);
        const float* const now = image.levels.data() + image.index(0, row);
        if (std::memcmp(old, now, columns * sizeof(float)) == 0) continue;
        changed.top = std::min(changed.top, row);
        changed.bottom = row + 1;
        const auto differ = [old, now](int i) {
            return std::memcmp(old + i, now + i, sizeof(float)) != 0;
        };
        for (int i = 0; i < changed.left; ++i)
            if (differ(i)) changed.left = i;
        for (int i = image.columns - 1; i >= changed.right; --i)
            if (differ(i)) changed.right = i + 1;
        std::copy_n(now, columns, old);
    }
    return changed;
}

/// Dilates an area of an image.
class AreaDilation {
  public:
    void dilate(const PaddedImage& touched, int columns, int rows, const Ball& ball,
                const Squares& squares, const Area& area);
    /// A pixel in the area.
    [[nodiscard]] const float* felt(int column, int row) const {
        return felt_.data() + felt_at(column, row);
    }

  private:
    void prepare(int columns, const Ball& ball);
    void raise_by_cells(int row);
    void raise_by_row(int row);
    [[nodiscard]] const float* touched(int row) const { return touched_->pixel(from_.left, row); }
    [[nodiscard]] float* raised(int row) { return felt_.data() + felt_at(from_.left, row); }
    /// In the middle of such a padding as the touched image has.
    [[nodiscard]] std::ptrdiff_t felt_at(int column, int row) const {
        return std::ptrdiff_t{row - from_.top + padding_} * touched_->pitch() + column + padding_;
    }

    const PaddedImage* touched_{nullptr};
    Area from_{};  ///< its pieces reach the dilated area
    int padding_{0};
    std::vector<float> felt_{};  ///< rows like those of the touched image
    CellRow above_{}, below_{};
    Triangles triangles_{};
    EdgePass in_rows_{}, in_columns_{}, diagonal_{};
    VertexPass vertices_{};
    Grounds grounds_{};
    const std::uint8_t* in_reach_{nullptr};       ///< of the row
    const std::uint8_t* next_in_reach_{nullptr};  ///< of the next row
};

/// Pieces at the rim of `from_` count as if nothing were beyond: what they raise too far is outside
/// the area.
void AreaDilation::dilate(const PaddedImage& touched, int columns, int rows, const Ball& ball,
                          const Squares& squares, const Area& area) {
    touched_ = &touched;
    const int reach = static_cast<int>(ball.radius_px) + 1;
    from_ = area.widened(reach, columns, rows);
    padding_ = reach + kPadding_px;
    const int from_columns = from_.right - from_.left;
    prepare(from_columns, ball);
    grounds_.prepare(touched, from_.left, from_columns, ball, squares, area.top, area.bottom);
    above_.make_wall(from_columns, ball.radius, -1.0F);
    next_in_reach_ = grounds_.in_reach(from_.top);
    for (int row = from_.top; row < from_.bottom; ++row) {
        in_reach_ = next_in_reach_;
        if (row + 1 < from_.bottom)
            raise_by_cells(row);
        else
            below_.make_wall(from_columns, ball.radius, 1.0F);
        raise_by_row(row);
        std::swap(above_, below_);
    }
}

void AreaDilation::prepare(int columns, const Ball& ball) {
    const int pitch = touched_->pitch();
    const auto rows = static_cast<std::size_t>(from_.bottom - from_.top + 2 * padding_);
    felt_.resize(std::max(felt_.size(), rows * static_cast<std::size_t>(pitch)));
    for (int row = from_.top; row < from_.bottom; ++row)
        std::copy_n(touched(row), columns, raised(row));
    triangles_.prepare(ball, columns, pitch);
    in_rows_.prepare(ball, edges_in_rows(pitch), columns);
    in_columns_.prepare(ball, edges_in_columns(pitch), columns);
    diagonal_.prepare(ball, diagonal_edges(pitch), columns);
    vertices_.prepare(ball, columns, pitch);
}

/// Raises pixels by the TRIANGLEs of the cells below a row, and the EDGEs inside and between them.
void AreaDilation::raise_by_cells(int row) {
    const auto cells = static_cast<std::size_t>(from_.right - from_.left - 1);
    next_in_reach_ = grounds_.in_reach(row + 1);
    triangles_.move(touched(row), touched(row + 1), below_);
    triangles_.raise(in_reach_, next_in_reach_, raised(row));
    in_columns_.raise(below_.far.x.data(), below_.near.x.data(), touched(row), in_reach_,
                      next_in_reach_, cells + 1, raised(row));
    diagonal_.raise(below_.near.both.data(), below_.far.both.data() + 1, touched(row) + 1,
                    in_reach_ + 1, next_in_reach_, cells, raised(row) + 1);
}

/// Raises pixels by a row's EDGEs and VERTICES.
void AreaDilation::raise_by_row(int row) {
    const auto cells = static_cast<std::size_t>(from_.right - from_.left - 1);
    in_rows_.raise(above_.far.y.data() + 1, below_.near.y.data(), touched(row), in_reach_,
                   in_reach_ + 1, cells, raised(row));
    vertices_.raise(touched(row), in_reach_, raised(row));
}

}  // namespace

struct FingertipDilation::Scratch {
    int columns{0}, rows{0};
    Fingertip finger{};
    double highest_level{0.0};
    bool is_dilated{false};     ///< whether `felt` is `touched` dilated
    PaddedImage touched{};      ///< the last image
    std::vector<float> felt{};  ///< dilated
    Ball ball{};
    Squares squares{};
    std::array<AreaDilation, 2> halves{};

    [[nodiscard]] DepthImage dilated(const DepthImage& image, const Fingertip& by, float most);

  private:
    [[nodiscard]] Area take(const DepthImage& image, const Fingertip& by);
    void dilate(const Area& area);
    void dilate_half(AreaDilation& half, const Area& area);
};

/// What lies farther from all changes than the ball reaches stays as it was.
DepthImage FingertipDilation::Scratch::dilated(const DepthImage& image, const Fingertip& by,
                                               float most) {
    const Area changed = take(image, by);
    if (!changed.is_empty()) {
        squares.find(touched, columns, rows, ball);
        dilate(changed.widened(static_cast<int>(ball.radius_px) + 2, columns, rows));
    }
    is_dilated = true;
    DepthImage result{columns, rows, highest_level, {}};
    result.levels.resize(felt.size());
    copy_up_to(most, felt.data(), felt.size(), result.levels.data());
    return result;
}

/// Returns where `felt` is to be found anew.
Area FingertipDilation::Scratch::take(const DepthImage& image, const Fingertip& by) {
    const bool is_next = is_dilated && columns == image.columns && rows == image.rows &&
                         finger == by && highest_level == image.highest_level;
    is_dilated = false;
    if (is_next) return replace(touched, image);
    columns = image.columns;
    rows = image.rows;
    finger = by;
    highest_level = image.highest_level;
    ball = Ball(finger, highest_level);
    touched.fit(columns, rows, static_cast<int>(ball.radius_px) + 1 + kPadding_px, kNothing);
    touched.copy(image);
    felt.resize(image.levels.size());
    return {0, columns, 0, rows};
}

/// Another thread dilates the lower half of a large area.
void FingertipDilation::Scratch::dilate(const Area& area) {
    const int down = area.bottom - area.top;
    if ((area.right - area.left) * down < kLarge_px || down < 4 * ball.radius_px) {
        dilate_half(halves[0], area);
        return;
    }
    const int middle = area.top + down / 2;
    std::future<void> lower = std::async(std::launch::async, [&] {
        dilate_half(halves[1], {area.left, area.right, middle, area.bottom});
    });
    dilate_half(halves[0], {area.left, area.right, area.top, middle});
    lower.get();
}

void FingertipDilation::Scratch::dilate_half(AreaDilation& half, const Area& area) {
    half.dilate(touched, columns, rows, ball, squares, area);
    for (int row = area.top; row < area.bottom; ++row)
        std::copy_n(half.felt(area.left, row), area.right - area.left,
                    felt.data() + std::ptrdiff_t{row} * columns + area.left);
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
    return scratch_->dilated(image, finger, range.highest);
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
