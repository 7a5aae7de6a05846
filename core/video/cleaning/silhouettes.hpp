// Turns ramps between near and far into steps: drawn and touched outlines have one crisp edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/silhouette_sides.hpp"

namespace dibhr {

struct ColourImage;

/// Sensors, codecs, scaling and estimators blur an object's outline into a ramp from near to far,
/// which is neither. A pixel on a ramp of up to 13 px is moved to one of its sides, where that
/// side's surface is continued. Pixels of a ramp go together: where fewer than a third around
/// can be decided, none is moved, since an outline would be crisp in some rows only. Unchanged:
/// slopes that go on beyond (a cone, a sphere's side, a cheek), steps that are crisp already, and
/// pictures with more ramps, or pixels on ramps, than kMostRamps, which bounds memory. The same
/// input gives the same bits. Scratch memory is kept inside.
class SilhouetteSharpener {
  public:
    static constexpr std::size_t kMostRamps = std::size_t{3} << 20;  ///< 38 % of 4K video

    /// `image`: without NaN. `colour`: of the same view, of any size; null: none, or unregistered.
    /// The step is half way up the ramp; on a wide ramp where the colour has its one sharp edge.
    /// `noise_levels`: standard deviation of the depth's noise [levels], 0 or more. Ramps of a few
    /// deviations are no step.
    void sharpen(DepthImage& image, const ColourImage* colour, float noise_levels);

  private:
    struct Scene;

    // There are millions of both structures, so their members are small.

    /// A ramp on a straight line of pixels, which are numbered uphill.
    struct FoundRamp {
        std::int32_t zero, stride;      ///< index of pixel number 0, and step to the next number
        std::int16_t begin, step, end;  ///< [begin, step) go to the low side, [step, end) up
        std::uint16_t seen;             ///< from this many pixels the ramp was found
        float low, low_slope;           ///< the faces' levels at number 0, and per number
        float high, high_slope;

        [[nodiscard]] std::size_t pixel(int k) const noexcept {
            return static_cast<std::size_t>(zero + k * stride);
        }
    };

    /// The votes of a pixel's ramps for a side and a level, and the result.
    struct Votes {
        std::uint32_t pixel{0};
        std::uint32_t ramp{0};            ///< number of the last wide one found, from 1
        float low{0.0F}, high{0.0F};      ///< sums of the pixel's levels on either side
        std::uint16_t lows{0}, highs{0};  ///< votes for either side
        std::uint16_t steps{0};           ///< sum of the ramps' widths
        std::uint8_t side{0};
        float level{0.0F};     ///< on that side; later the recorded one
        float smoothed{0.0F};  ///< with those around
    };

    /// Finds the ramps of the whole image. False: there are more than kMostRamps.
    bool find_ramps(const Scene& scene);
    void scan_row(const Scene& scene, int row, int begin, int end, int reach);
    void find_ramp_at(const Scene& scene, int column, int row);
    Votes& votes_of(std::size_t pixel);
    void vote(const FoundRamp& found);
    [[nodiscard]] bool are_too_many() const noexcept {
        return ramps_.size() > kMostRamps || votes_.size() > kMostRamps;
    }
    void forget(std::size_t pixels);
    static void decide(Votes& votes);
    void decide_together(const DepthImage& image);
    void smooth_sides(DepthImage& image);
    template <typename Visit>
    void visit_runs_of(const DepthImage& image, const Visit& visit);
    [[nodiscard]] static float within(const DepthImage& image, float recorded,
                                      float level) noexcept;

    struct Free {
        void operator()(void* memory) const noexcept { std::free(memory); }
    };
    /// Place in votes_ of each pixel, from 1; 0: not on a ramp. Memory without ramps stays unused.
    std::unique_ptr<std::uint32_t[], Free> votes_number_{};
    std::vector<std::uint8_t> sides_{};  ///< SideOfPixel of each; kReadBeyond more
    std::vector<Votes> votes_{};
    std::vector<FoundRamp> ramps_{};
    std::vector<std::uint32_t> steep_{};  ///< pixels that may be on a ramp
    SideBalances balances_{};
};

}  // namespace dibhr
