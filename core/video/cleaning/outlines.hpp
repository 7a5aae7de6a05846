// Takes the teeth off outlines: where near meets far, a pixel on the other side than those around.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// Noise and each pixel's own decision leave outlines ragged. A pixel beside a step changes sides
/// where most around it are on the other one, and takes the level of its neighbours there. Then
/// each tooth that is left changes sides where that leaves fewer. Unchanged: ramps, and straight
/// lines of pixels, but for three at their ends and beside teeth that remain. The same input gives
/// the same bits. Scratch memory is kept inside.
class OutlineSmoother {
  public:
    /// `image`: without NaN. `recorded_teeth`: of the picture before any cleaning. While there are
    /// more, lines one pixel wide are shortened, too, at most 64 times; last, the pixels around
    /// teeth become medians of 3 x 3 and then 5 x 5. `unseen`: 1 for each pixel never seen, or
    /// empty; a pixel that changes sides takes the mark of its new neighbours, too.
    void smooth(DepthImage& image, std::size_t recorded_teeth, std::span<std::uint8_t> unseen = {});

  private:
    struct Turned {
        std::uint32_t pixel;
        float level;
        bool unseen;
    };
    void find_steps(const DepthImage& image, float step);
    void turn_sides(DepthImage& image, std::span<std::uint8_t> unseen);
    void keep_teeth(const DepthImage& image, float step);
    void take_teeth(DepthImage& image, float step, std::size_t as_many,
                    std::span<std::uint8_t> unseen);
    void take_medians(DepthImage& image, std::uint32_t pixel, float step, int reach,
                      std::span<std::uint8_t> unseen);

    std::vector<std::uint32_t> pixels_{};   ///< beside a step; later teeth
    std::vector<std::uint32_t> touched_{};  ///< all that were teeth, at one time or another
    std::vector<Turned> turned_{};
    std::size_t teeth_{0};  ///< that are left
};

/// The teeth of a picture: pixels of an outline, which is a step of more than 5 % of the range,
/// that differ in side from both neighbours along it. Pixels without data (NaN) are on no side.
[[nodiscard]] std::size_t teeth_of(const DepthImage& image);

}  // namespace dibhr
