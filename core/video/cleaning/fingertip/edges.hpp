// A part of a cylinder around every convex EDGE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"

namespace dibhr::fingertip {

/// EDGEs of one direction, and where their neighbours are.
struct EdgeFamily {
    double length_px;           ///< of an EDGE
    std::ptrdiff_t to_end;      ///< from an EDGE's begin, in the padded image
    std::ptrdiff_t aside;       ///< from an EDGE to the next one straight across it
    double aside_px;            ///< length of that step
    double line_px;             ///< between two lines of pixels along such EDGEs
    double line_shift;          ///< of a line's pixels along the EDGE, in EDGE lengths
    std::ptrdiff_t along_line;  ///< to a line's next pixel
    std::ptrdiff_t to_line;     ///< to the next line
};

[[nodiscard]] EdgeFamily edges_in_rows(int pitch);
[[nodiscard]] EdgeFamily edges_in_columns(int pitch);
/// From the pixel to the right of a cell's origin to the one below.
[[nodiscard]] EdgeFamily diagonal_edges(int pitch);

/// The pixels around an EDGE lie on lines parallel to it, numbered from the one that it is on. Over
/// each line the ball touches the EDGE's line in one point.
struct Lines {
    int last{0};                  ///< last line that the ball reaches
    std::vector<float> shifts{};  ///< of a line's pixels along the EDGE, in EDGE lengths
    std::vector<float> reach{};   ///< of the ball over a line, in EDGE lengths
    std::vector<float> height{};  ///< of the ball over a line [levels]
    std::vector<int> steps{};     ///< to a line, in the padded image

    void lay(const Ball& ball, const EdgeFamily& family);
};

/// The EDGEs of a row that the ball may touch: their numbers, levels, slopes (as sine and cosine),
/// and the lines over which the ball touches them.
struct TouchedEdges {
    std::vector<int> number{};
    std::vector<float> begin{}, rise{};  ///< [levels]
    std::vector<float> sine{}, cosine{};
    std::vector<int> first{}, last{};
    std::size_t count{0};

    void make_room(std::size_t most);
};

/// Raises pixels by the EDGEs of one family.
class EdgePass {
  public:
    void prepare(const Ball& ball, const EdgeFamily& family, int most);

    /// By the EDGEs of a row. `before`, `after`: how far the ball's centre is from where it touches
    /// the TRIANGLEs on the two sides [lines]. `begins`: the first EDGE's begin in the padded
    /// image; `origin`: the same pixel of the raised image. `begin_in_reach`, `end_in_reach`: 1
    /// where the ball may touch that VERTEX.
    void raise(const float* before, const float* after, const float* begins,
               const std::uint8_t* begin_in_reach, const std::uint8_t* end_in_reach,
               std::size_t count, float* origin);

  private:
    void find(const float* before, const float* after, const float* begins);
    void narrow_wide(const float* begins);
    void narrow(const float* begins, int distance);

    Ball ball_{};
    EdgeFamily family_{};
    Lines lines_{};
    std::vector<std::uint8_t> flags_{};
    TouchedEdges edges_{};
    TouchedEdges wide_{};
    std::vector<std::uint8_t> is_wide_{};
    std::vector<int> wide_at_{};
    std::vector<float> levels_{};
    std::vector<int> to_{};
};

}  // namespace dibhr::fingertip
