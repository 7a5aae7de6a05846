// Interpolates sparse depth: continues surfaces between seen pixels that lie apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

struct ColourImage;

/// Fills the pixels between seen pixels that are spread over the image, as of a LiDAR.
///
/// A pixel is assigned to the seen pixel to which the path is shortest, where a step across a
/// change of colour is a long one: so surfaces meet at the colour's edge, without colour half way.
/// Two neighbours are joined where the levels that they are assigned differ by no more than those
/// of one surface (outline_levels), or where the surface rises as steeply beyond. Joined levels
/// then are balanced: each pixel gets the mean of its neighbours, so a plane is continued exactly.
///
/// Seen pixels keep their level. A pixel farther than three mean spacings, or a sixteenth of the
/// image's width, from all of them stays without data. The same input gives the same bits.
class SparseInterpolator {
  public:
    /// `image`: at least 2 x 2, NaN is no data. `colour`: of the same view, any size; null: none.
    void fill(DepthImage& image, const ColourImage* colour);

    static constexpr int kMostRounds = 24;
    /// How often all levels of the last image were balanced: more for wider spacings.
    [[nodiscard]] int rounds() const noexcept { return rounds_; }

  private:
    // Planes have a border of one pixel around the image, which no path enters.

    [[nodiscard]] std::ptrdiff_t at(int column, int row) const noexcept {
        return (row + 1) * stride_ + column + 1;
    }
    [[nodiscard]] std::size_t take(const DepthImage& image);
    void find_reach(const DepthImage& image, double reach_px);
    void find_colour_steps(const ColourImage* colour);
    void find_nearest();
    void find_joins(float outline);
    void require_even_rises(std::vector<std::uint8_t>& joined, std::ptrdiff_t step) const;
    [[nodiscard]] bool rises_evenly(std::int32_t one, std::int32_t other) const;
    void balance(double spacing_px);
    void give(DepthImage& image) const;

    int columns_{0}, rows_{0};
    std::ptrdiff_t stride_{0};  ///< of the planes
    int rounds_{0};
    float lowest_{0.0F}, highest_{0.0F};           ///< of the seen levels
    std::vector<std::int32_t> path_cost_{};        ///< to the nearest seen pixel
    std::vector<std::int32_t> nearest_{};          ///< its index in the planes
    std::vector<float> levels_{}, before_{};       ///< now, and a round earlier
    std::vector<std::uint8_t> unseen_{};           ///< of the image's pixels, without a border
    std::vector<std::uint8_t> in_reach_{};         ///< not 0: gets a level, or has one
    std::vector<std::uint8_t> right_{}, below_{};  ///< 1: joined with the pixel there
    std::vector<std::uint8_t> joins_{};            ///< bits: neighbours, and whether free
    /// Differences of colour to the right, below, below right, below left; in [0, 255].
    std::array<std::vector<std::uint8_t>, 4> colour_steps_{};
};

}  // namespace dibhr
