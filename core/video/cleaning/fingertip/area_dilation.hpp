// Dilates parts of an image by a ball.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"
#include "core/video/cleaning/fingertip/edges.hpp"
#include "core/video/cleaning/fingertip/grounds.hpp"
#include "core/video/cleaning/fingertip/squares.hpp"
#include "core/video/cleaning/fingertip/tiles.hpp"
#include "core/video/cleaning/fingertip/triangles.hpp"
#include "core/video/cleaning/fingertip/vertices.hpp"

namespace dibhr::fingertip {

/// The image needs so many pixels of padding beyond the ball's reach: eight are raised at once.
inline constexpr int kPadding_px = 10;

/// An image to touch, and the ball that touches it.
struct TouchedImage {
    int columns{0}, rows{0};
    PaddedImage levels{};
    Ball ball{};
    Squares squares{};

    /// Pixels from a piece of the surface to those that it may raise, and one more.
    [[nodiscard]] int reach() const { return static_cast<int>(ball.radius_px) + 1; }
};

/// Keeps its scratch memory from image to image.
class AreaDilation {
  public:
    /// Dilates the wanted tiles in rows from `top` to before `bottom`: the height of whole tiles,
    /// but for the image's end.
    void dilate(const TouchedImage& image, const Tiles& wanted, int top, int bottom);
    /// A pixel of a wanted tile in those rows.
    [[nodiscard]] const float* felt(int column, int row) const {
        return felt_.data() + felt_at(column, row);
    }

  private:
    void begin(const Tiles& wanted);
    void raise_by_pieces_of(const Area& area);
    void prepare(const Area& area);
    void raise_by_cells(int row);
    void raise_by_row(int row);
    [[nodiscard]] const std::uint8_t* in_reach(int row);
    [[nodiscard]] const float* touched(int row) const { return image_->levels.pixel(left_, row); }
    [[nodiscard]] float* raised(int row) { return felt_.data() + felt_at(left_, row); }
    /// In the middle of such a padding as the touched image has.
    [[nodiscard]] std::ptrdiff_t felt_at(int column, int row) const {
        return std::ptrdiff_t{row - from_top_ + padding_} * image_->levels.pitch() + column +
               padding_;
    }

    const TouchedImage* image_{nullptr};
    int top_{0}, bottom_{0};  ///< wanted rows
    int from_top_{0};         ///< the first row of pieces that reach them
    int padding_{0};
    std::vector<float> felt_{};  ///< rows like those of the touched image
    int left_{0};                ///< the first column whose cells are known, and
    std::size_t own_{0};         ///< how many columns the area has, from
    std::size_t skipped_{0};     ///< so many columns farther on,
    std::size_t own_cells_{0};   ///< and how many cells in a row
    int grounds_left_{0};
    CellRow above_{}, below_{};
    Triangles triangles_{};
    EdgePass in_rows_{}, in_columns_{}, diagonal_{};
    VertexPass vertices_{};
    Grounds grounds_{};
    const std::uint8_t* in_reach_{nullptr};       ///< of the row
    const std::uint8_t* next_in_reach_{nullptr};  ///< of the next row
};

}  // namespace dibhr::fingertip
