// Makes recorded depth pleasant and safe to touch: all steps, in their order.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_memory.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/fingertip.hpp"
#include "core/video/cleaning/frame_scale.hpp"
#include "core/video/cleaning/large_holes.hpp"
#include "core/video/cleaning/noise_smoothing.hpp"
#include "core/video/cleaning/silhouettes.hpp"
#include "core/video/cleaning/small_holes.hpp"
#include "core/video/cleaning/spikes.hpp"
#include "core/video/cleaning/step_smoothing.hpp"
#include "core/video/cleaning/temporal_filter.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// What is done to the frames of one clip.
struct CleaningPlan {
    CleaningSteps steps{};
    Fingertip finger{};
    DepthNoise noise{};  ///< of the clip

    bool operator==(const CleaningPlan&) const = default;
};

/// Images of more pixels take longer with all steps than most machines have.
inline constexpr std::size_t kMostForSensor = 1'000'000;

/// The steps that `options` mean for a clip of such noise and size: `auto` takes what there is use
/// and time for.
[[nodiscard]] CleaningPlan plan_of(const CleaningOptions& options, const DepthNoise& noise,
                                   std::size_t pixels = 0);

/// Whether `options` depend on the noise of the clip, which then is to be measured first.
[[nodiscard]] bool needs_noise(const CleaningOptions& options);

/// Whether frames cleaned alone are the same by both.
[[nodiscard]] inline bool same_alone(const CleaningSteps& a, const CleaningSteps& b) noexcept {
    return a.remove_spikes == b.remove_spikes && a.fill_holes == b.fill_holes &&
           a.sharpen_silhouettes == b.sharpen_silhouettes &&  // by the noise, which is the clip's
           a.colour_edges == b.colour_edges;
}

/// In one line, for a person: "auto: sensor, noise 0.9 px near, 6.9 far".
[[nodiscard]] std::string in_words(const CleaningOptions& options, const CleaningPlan& plan);

/// Cleans frames, each in two parts: alone, and then with those before and after it. What is off
/// leaves every level as it is, but no data (NaN) becomes level 0, the farthest; the same frames
/// give the same bits. Scratch memory is kept inside and reused: one thread at a time may call
/// alone(), and one, that or another, finished().
class CleaningChain {
  public:
    /// Spikes, holes and silhouettes of one frame. `held`: what pixels without data were before;
    /// `colour`: of the same view, null where there is none.
    [[nodiscard]] LoneDepth alone(DepthImage image, const CleaningPlan& plan,
                                  std::span<const HeldLevel> held = {},
                                  const ColourImage* colour = nullptr);

    /// All that is left, of frame `now` of `frames`, which follow each other in time and may be
    /// only one: the depth of `frame`, which has none, and how it was cleaned.
    [[nodiscard]] Frame finished(std::span<const LoneDepth* const> frames, std::size_t now,
                                 const CleaningPlan& plan, Frame frame = {});

    /// Both parts of a frame that has none before or after it.
    [[nodiscard]] Frame cleaned(DepthImage image, const CleaningPlan& plan,
                                std::span<const HeldLevel> held = {});

  private:
    [[nodiscard]] DepthImage steadied(std::span<const LoneDepth* const> frames, std::size_t now,
                                      const DepthNoise& noise);
    void close_holes(LoneDepth& lone, bool fill, std::span<const HeldLevel> held);

    SpikeRemover spikes_{};
    DepthImage seen_{};  ///< without anything filled
    HeldFiller held_{};
    SmallHoleFiller small_holes_{};
    LargeHoleFiller large_holes_{};
    SilhouetteSharpener silhouettes_{};
    FrameScale scale_{};
    TemporalFilter temporal_{};
    StepSmoother steps_{};
    NoiseSmoother noise_{};
    FingertipDilation finger_{};
};

}  // namespace dibhr
