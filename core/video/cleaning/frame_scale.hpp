// Frames that each have a scale and a shift of their own are brought onto one.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/lone_depth.hpp"

namespace dibhr {

/// Levels of one frame as those of another scale: gain * level + offset.
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

/// Estimators of depth from single pictures are right but for a scale and a shift, which differ
/// from frame to frame (R. Ranftl et al., Towards robust monocular depth estimation, TPAMI 2022):
/// the whole scene flickers. Between frames that follow each other both are found where most of the
/// picture agrees on them, and their means over kReachInTime frames to each side are put in their
/// place. So what really changes evenly is followed without lag, but for the first and last frames.
///
/// What does not flicker so stays as it is, to the bit: noise, holes, steps of levels, and what
/// moves in one part of the picture or evenly in all of it. Same frames, same bits, whatever was
/// asked for before; scratch memory is kept inside.
class FrameScale {
  public:
    /// What brings each of `frames`, which follow each other in time, onto the scale that frame
    /// `now` should have. Only the frames within kReachInTime of it are looked at; of the others,
    /// of those behind a cut or of another size, and if nothing flickers of all, it is the
    /// identity. NaN and what was made up do not count.
    [[nodiscard]] std::vector<LevelMap> maps(std::span<const LoneDepth* const> frames,
                                             std::size_t now);

    /// The frames so mapped, or themselves where none needs to be. Valid until the next call, and
    /// as long as they are.
    [[nodiscard]] std::span<const LoneDepth* const> on_one_scale(
        std::span<const LoneDepth* const> frames, std::size_t now);

  private:
    /// What two frames that follow each other say.
    struct Pair {
        LevelMap map{};              ///< from the earlier one's levels to the later one's
        LevelMap change{};           ///< the same: what is added, by the level between the two
        double low{0.0}, high{0.0};  ///< most levels are between these
        double off{0.0};             ///< mean of how far levels are from it, outliers less
        bool agreed{false};          ///< on by most of the picture
        bool explains{false};        ///< most of what has changed
    };
    /// Levels half way between two frames, and how much higher they are in the later one: so noise
    /// of the one weighs as much as that of the other, and a gain is not taken for less.
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

    void sample(std::span<const LoneDepth* const> frames, const DepthImage& like);
    [[nodiscard]] Pair compare(std::size_t one);
    void thin();
    void balance();
    [[nodiscard]] Pair fitted(const Samples& samples);
    void judge(Pair& pair, double changed);
    [[nodiscard]] double middle_of_sizes(const Samples& samples, const LevelMap& change);
    [[nodiscard]] bool flickers(std::span<const Pair> pairs) const;

    std::array<std::vector<float>, 2 * kReachInTime + 1> levels_{};  ///< of frames, on a grid
    double highest_{0.0};
    double levels_per_px_{1.0};
    Samples all_{}, thinned_{}, balanced_{};  ///< of two frames
    std::vector<float> sizes_{};
    std::vector<LoneDepth> scaled_{};
    std::vector<const LoneDepth*> frames_{};
};

/// The frame's levels in another scale, within those there are. What was never seen stays.
void scale_levels(const LoneDepth& frame, const LevelMap& map, LoneDepth& scaled);

}  // namespace dibhr
