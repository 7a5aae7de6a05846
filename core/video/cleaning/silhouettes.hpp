// Makes ramps between near and far steps: what is drawn and what is touched has one crisp edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

struct ColourImage;

/// Sensors, codecs, scaling and estimators blur an object's outline into a ramp from near to far,
/// which is neither. A pixel on a ramp of up to 13 px goes to one side of it, as that side's
/// surface goes on; a slope that goes on beyond (a cone, a sphere's side, a cheek) and a step that
/// is crisp already stay as they are, and so does a picture with more ramps, or pixels on
/// ramps, than kMostRamps, which would take memory without bound. The same input gives the same
/// bits. Scratch memory is kept inside.
class SilhouetteSharpener {
  public:
    static constexpr std::size_t kMostRamps = std::size_t{3} << 20;  ///< 38 % of 4K video

    /// `image`: levels, no NaN. `colour`: of the same view, of any size; null where there is none
    /// or it is not registered. The step is half way up the ramp, or where the colour has its one
    /// sharp edge across a wide one. `noise_levels`: standard deviation of the depth's noise
    /// [levels], 0 or more: what is no higher than a few of them is no step.
    void sharpen(DepthImage& image, const ColourImage* colour, float noise_levels);

  private:
    struct Scene;
    enum class Side : std::uint8_t { neither, low, high };

    // Millions of both: no member is wider than it must be.

    /// A ramp on a straight line of pixels, which are numbered uphill.
    struct Found {
        std::int32_t zero, stride;      ///< where number 0 is, and how far it is to the next
        std::int16_t begin, step, end;  ///< [begin, step) go to the low side, [step, end) up
        std::uint16_t seen;             ///< so many pixels see it
        float low, low_slope;           ///< the faces' levels at number 0, and per number
        float high, high_slope;

        [[nodiscard]] std::size_t pixel(int k) const noexcept {
            return static_cast<std::size_t>(zero + k * stride);
        }
    };

    /// What the ramps that a pixel is on say of it, and what follows.
    struct Votes {
        std::uint32_t pixel{0};
        std::uint32_t ramp{0};            ///< number of the last wide one found, from 1
        float low{0.0F}, high{0.0F};      ///< sums of the levels that it would have on that side
        std::uint16_t lows{0}, highs{0};  ///< how many say so
        std::uint16_t steps{0};           ///< sum of their widths
        Side side{Side::neither};
        float level{0.0F};
    };

    /// Everywhere. False: there are more than kMostRamps.
    bool find_ramps(const Scene& scene);
    void look_along(const Scene& scene, int row, int begin, int end, int reach);
    void look_at(const Scene& scene, int column, int row);
    Votes& votes_of(std::size_t pixel);
    void vote(const Found& found);
    [[nodiscard]] bool are_too_many() const noexcept {
        return found_.size() > kMostRamps || votes_.size() > kMostRamps;
    }
    static void decide(Votes& votes);
    [[nodiscard]] static float within(const DepthImage& image, float recorded,
                                      float level) noexcept;
    [[nodiscard]] float smoothed(const DepthImage& image, const Votes& own) const;

    std::vector<std::uint32_t> votes_of_{};  ///< each pixel, counted from 1; 0: it is on no ramp
    std::vector<Votes> votes_{};
    std::vector<Found> found_{};
};

}  // namespace dibhr
