#include "core/video/cleaning/fingertip/area_dilation.hpp"

#include <algorithm>
#include <utility>

namespace dibhr::fingertip {

namespace {

/// The rows of so many columns fit into a processor's nearest cache.
constexpr int kStrip_px = 384;
/// Grounds of pieces are found in the ball's reach around them, too.
constexpr int kStripReaches = 6;

}  // namespace

void AreaDilation::dilate(const TouchedImage& image, const Tiles& wanted, int top, int bottom) {
    image_ = &image;
    top_ = top;
    bottom_ = bottom;
    const int reach = image.reach();
    const Area rows = Area{0, image.columns, top, bottom}.widened(reach, image.columns, image.rows);
    from_top_ = rows.top;
    padding_ = reach + kPadding_px;
    const auto buffer_rows = static_cast<std::size_t>(rows.rows() + 2 * padding_);
    felt_.resize(
        std::max(felt_.size(), buffer_rows * static_cast<std::size_t>(image.levels.pitch())));
    begin(wanted);
    Tiles pieces = wanted;
    pieces.keep_rows(top, bottom);
    pieces.widen(reach);
    const int strip_px = std::max(kStrip_px, kStripReaches * reach);
    for (Area area : pieces.areas(reach)) {
        area.top = std::max(area.top, rows.top);
        area.bottom = std::min(area.bottom, rows.bottom);
        const int strips = (area.columns() + strip_px - 1) / strip_px;
        const int left = area.left;
        const int across = area.columns();
        for (int k = 0; k < strips; ++k)
            raise_by_pieces_of({left + across * k / strips, left + across * (k + 1) / strips,
                                area.top, area.bottom});
    }
}

/// A wanted pixel is no lower than the surface.
void AreaDilation::begin(const Tiles& wanted) {
    for (int row = top_; row < bottom_; ++row)
        wanted.each_run(row, [&](int left, int right) {
            std::copy_n(image_->levels.pixel(left, row), right - left,
                        felt_.data() + felt_at(left, row));
        });
}

/// Raises pixels by the TRIANGLEs and EDGEs to the right of and below each VERTEX of an area, and
/// by the VERTEX.
void AreaDilation::raise_by_pieces_of(const Area& area) {
    prepare(area);
    if (area.top > 0)
        triangles_.move(touched(area.top - 1), touched(area.top), above_);
    else
        above_.make_wall(static_cast<int>(skipped_ + own_) + 1, image_->ball.radius, -1.0F);
    next_in_reach_ = in_reach(area.top);
    for (int row = area.top; row < area.bottom; ++row) {
        in_reach_ = next_in_reach_;
        if (row + 1 < image_->rows)
            raise_by_cells(row);
        else
            below_.make_wall(static_cast<int>(skipped_ + own_) + 1, image_->ball.radius, 1.0F);
        raise_by_row(row);
        std::swap(above_, below_);
    }
}

void AreaDilation::prepare(const Area& area) {
    left_ = std::max(area.left - 1, 0);
    skipped_ = static_cast<std::size_t>(area.left - left_);
    own_ = static_cast<std::size_t>(area.columns());
    own_cells_ = static_cast<std::size_t>(std::min(area.right, image_->columns - 1) - area.left);
    const int columns = std::min(area.right + 1, image_->columns) - left_;
    const int pitch = image_->levels.pitch();
    const Ball& ball = image_->ball;
    triangles_.prepare(ball, columns, pitch);
    in_rows_.prepare(ball, edges_in_rows(pitch), columns);
    in_columns_.prepare(ball, edges_in_columns(pitch), columns);
    diagonal_.prepare(ball, diagonal_edges(pitch), columns);
    vertices_.prepare(ball, area.columns(), pitch);
    const Area balls = area.widened(image_->reach(), image_->columns, image_->rows);
    grounds_left_ = balls.left;
    grounds_.prepare(image_->levels, balls.left, balls.columns(), ball, image_->squares,
                     std::max(balls.top, top_), std::min(balls.bottom, bottom_));
}

const std::uint8_t* AreaDilation::in_reach(int row) {
    return grounds_.in_reach(row) + (left_ - grounds_left_);
}

/// Raises pixels by the TRIANGLEs of the cells below a row, and the EDGEs inside and between them.
void AreaDilation::raise_by_cells(int row) {
    next_in_reach_ = in_reach(row + 1);
    triangles_.move(touched(row), touched(row + 1), below_);
    triangles_.raise(in_reach_, next_in_reach_, raised(row));
    const std::size_t k = skipped_;
    in_columns_.raise(below_.far.x.data() + k, below_.near.x.data() + k, touched(row) + k,
                      in_reach_ + k, next_in_reach_ + k, own_, raised(row) + k);
    diagonal_.raise(below_.near.both.data() + k, below_.far.both.data() + k + 1,
                    touched(row) + k + 1, in_reach_ + k + 1, next_in_reach_ + k, own_cells_,
                    raised(row) + k + 1);
}

/// Raises pixels by a row's EDGEs and VERTICES.
void AreaDilation::raise_by_row(int row) {
    const std::size_t k = skipped_;
    in_rows_.raise(above_.far.y.data() + k + 1, below_.near.y.data() + k, touched(row) + k,
                   in_reach_ + k, in_reach_ + k + 1, own_cells_, raised(row) + k);
    vertices_.raise(touched(row) + k, in_reach_ + k, raised(row) + k);
}

}  // namespace dibhr::fingertip
