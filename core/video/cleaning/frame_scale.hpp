// Brings frames that each have their own scale and shift onto one scale.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/single_frame_depth.hpp"

namespace dibhr {

/// Maps levels to another scale: gain * level + offset.
struct LevelMap {
    double gain{1.0};
    double offset{0.0};  ///< [levels]

    bool operator==(const LevelMap&) const = default;

    [[nodiscard]] double operator()(double level) const noexcept { return gain * level + offset; }
    /// First this one, then `next`.
    [[nodiscard]] LevelMap then(const LevelMap& next) const noexcept {
        return {next.gain * gain, next.gain * offset + next.offset};
    }
    [[nodiscard]] LevelMap inverse() const noexcept { return {1.0 / gain, -offset / gain}; }
};

/// Estimators of depth from single pictures are right except for a scale and a shift, which differ
/// from frame to frame (R. Ranftl et al., Towards robust monocular depth estimation, TPAMI 2022):
/// the whole scene flickers. Both are measured between consecutive frames, where most of the
/// picture agrees on them, and replaced by their means over kNearInTime frames to each side. So
/// even changes are followed without lag, except in the first and last frames.
///
/// Without such flicker levels keep their bits: with noise, holes, steps of levels, and motion in
/// one part of the picture or evenly in all of it. The same frames give the same bits, whatever
/// was computed before; scratch memory is kept inside.
class FrameScale {
  public:
    /// The maps that bring each of `frames`, which follow each other in time, onto the scale that
    /// frame `now` should have. The identity for frames farther than kNearInTime, behind a cut or
    /// of another size, and for all frames if nothing flickers. NaN and filled pixels do not count.
    [[nodiscard]] std::vector<LevelMap> maps(std::span<const SingleFrameDepth* const> frames,
                                             std::size_t now);

    /// The mapped frames; those that need no map are returned themselves. Valid until the next
    /// call, and as long as `frames` are.
    [[nodiscard]] std::span<const SingleFrameDepth* const> on_one_scale(
        std::span<const SingleFrameDepth* const> frames, std::size_t now);

  private:
    /// The map between two consecutive frames, and how far to trust it.
    struct Pair {
        LevelMap map{};              ///< from the earlier one's levels to the later one's
        LevelMap change{};           ///< likewise the change, by the mean level of the two
        double low{0.0}, high{0.0};  ///< most levels are between these
        double off{0.0};             ///< robust mean of the levels' distances from it
        bool agreed{false};          ///< most of the picture agrees on the map
        bool explains{false};        ///< the map explains most of the changes
    };
    /// Mean levels of two frames, and how much higher they are in the later one: so the noise of
    /// both weighs the same, and the gain is not underestimated.
    struct Samples {
        std::vector<float> from{}, change{};

        void clear() {
            from.clear();
            change.clear();
        }
        void add(float level, float higher) {
            from.push_back(level);
            change.push_back(higher);
        }
    };

    void sample(std::span<const SingleFrameDepth* const> frames, const DepthImage& like);
    [[nodiscard]] Pair compare(std::size_t one);
    void thin();
    void balance();
    [[nodiscard]] Pair fitted(const Samples& samples);
    void judge(Pair& pair, double changed);
    [[nodiscard]] double median_residual(const Samples& samples, const LevelMap& change);
    [[nodiscard]] bool flickers(std::span<const Pair> pairs) const;

    std::array<std::vector<float>, 2 * kNearInTime + 1> levels_{};  ///< of frames, on a grid
    double highest_{0.0};
    double levels_per_px_{1.0};
    Samples all_{}, thinned_{}, balanced_{};  ///< of two frames
    std::vector<float> residuals_{};
    std::vector<SingleFrameDepth> scaled_{};
    std::vector<const SingleFrameDepth*> frames_{};
};

/// Maps a frame's levels, clamped to [0, highest]. Unseen pixels keep their level.
void scale_levels(const SingleFrameDepth& frame, const LevelMap& map, SingleFrameDepth& scaled);

}  // namespace dibhr
