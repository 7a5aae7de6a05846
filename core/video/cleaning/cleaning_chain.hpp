// The chain of cleaning: applies all steps in their order to recorded depth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/depth_noise.hpp"
#include "core/video/cleaning/fingertip.hpp"
#include "core/video/cleaning/frame_scale.hpp"
#include "core/video/cleaning/holes/depth_memory.hpp"
#include "core/video/cleaning/holes/large_holes.hpp"
#include "core/video/cleaning/holes/small_holes.hpp"
#include "core/video/cleaning/noise_smoothing.hpp"
#include "core/video/cleaning/outlines.hpp"
#include "core/video/cleaning/silhouettes.hpp"
#include "core/video/cleaning/sparse_interpolation.hpp"
#include "core/video/cleaning/spikes.hpp"
#include "core/video/cleaning/step_smoothing.hpp"
#include "core/video/cleaning/temporal_filter.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/frames/object_pool.hpp"

namespace dibhr {

/// What a sliding finger would feel of a way of cleaning, on ground that stands still.
struct FeltCleaning {
    CleaningSteps steps{};
    /// Predicted buzz, RMS in 30 to 500 Hz, of a point at 100 mm/s with the default spring and
    /// pitch. On relief that stands out of the noise: of the difference from it.
    double buzz_N{0.0};
    double raw_N{0.0};               ///< the same without cleaning
    std::optional<double> relief{};  ///< the share of such relief that is kept; nothing: none

    bool operator==(const FeltCleaning&) const = default;
};

/// The cleaning of the frames of one clip.
struct CleaningPlan {
    CleaningSteps steps{};
    Fingertip finger{};
    DepthNoise noise{};                  ///< measured in the clip
    std::optional<FeltCleaning> felt{};  ///< why `automatic` takes these steps; else by the noise

    bool operator==(const CleaningPlan&) const = default;
};

/// Depth after all steps but the fingertip.
struct SettledDepth {
    std::shared_ptr<const DepthImage> depth{};
    std::shared_ptr<const std::vector<std::uint8_t>> unseen{};  ///< as of a Frame
    CleaningPlan plan{};
};

/// `automatic` does not take all steps for larger images: most machines have no time for them.
inline constexpr std::size_t kMostPixelsForSensor = 1'000'000;

/// The steps for a clip of this noise and size. `automatic` chooses the steps that the clip needs
/// and that there is time for: what felt best of ways_of_automatic(), or by the noise. Sparse depth
/// is densified, except with `raw` and `own`.
[[nodiscard]] CleaningPlan plan_of(const CleaningOptions& options, const DepthNoise& noise,
                                   std::size_t pixels = 0, bool is_sparse = false,
                                   const std::optional<FeltCleaning>& felt = {});

/// What `automatic` chooses from, for pictures of this size: the first one if they feel alike.
[[nodiscard]] std::vector<CleaningSteps> ways_of_automatic(std::size_t pixels);

/// Whether the clip's noise must be measured before its steps are known.
[[nodiscard]] bool needs_noise(const CleaningOptions& options);

/// Whether any of the steps depends on the clip's noise: then spikes do, too, which in `gentle`
/// must be the same whether the noise was measured or not.
[[nodiscard]] constexpr bool depend_on_noise(const CleaningSteps& steps) noexcept {
    return steps.steady || steps.smooth_noise || steps.sharpen_silhouettes;
}

/// Whether the steps that need one frame only are the same in both.
[[nodiscard]] inline bool same_single_frame_steps(const CleaningSteps& a,
                                                  const CleaningSteps& b) noexcept {
    return depend_on_noise(a) == depend_on_noise(b) && a.densify == b.densify &&
           a.remove_spikes == b.remove_spikes && a.fill_holes == b.fill_holes &&
           a.sharpen_silhouettes == b.sharpen_silhouettes &&  // by the noise, which is the clip's
           a.colour_edges == b.colour_edges &&
           a.smooth_outlines == b.smooth_outlines;  // the recorded ones are looked at
}

/// In one line, for a person: "auto: sensor, noise 0.9 to 6.9 px; a slide buzzes by 0.01 N, 0.07
/// raw".
[[nodiscard]] std::string in_words(const CleaningOptions& options, const CleaningPlan& plan);

/// Cleans frames in three parts: clean_frame() needs one frame only, settle() those before and
/// after it, too, and felt() is the fingertip. Steps that are off change no level, but no data
/// (NaN) becomes level 0, the farthest. The same frames give the same bits. Each part has its own
/// scratch memory: one thread at a time may call each, the same or another one.
class CleaningChain {
  public:
    /// Sparse depth, spikes, holes and silhouettes of one frame. `held`: the last levels of pixels
    /// without data; `colour`: the picture of the same view, null: none.
    [[nodiscard]] SingleFrameDepth clean_frame(DepthImage image, const CleaningPlan& plan,
                                               std::span<const HeldLevel> held = {},
                                               const ColourImage* colour = nullptr);

    /// The other steps for frame `now` of `frames`, which follow each other in time (one frame is
    /// enough).
    [[nodiscard]] SettledDepth settle(std::span<const SingleFrameDepth* const> frames,
                                      std::size_t now, const CleaningPlan& plan);
    /// The same of one frame alone, in its own memory.
    [[nodiscard]] SettledDepth settle(SingleFrameDepth&& alone, const CleaningPlan& plan);

    /// Returns `frame` with its depth and cleaning set.
    [[nodiscard]] Frame felt(const SettledDepth& settled, Frame frame = {});

    /// settle() and felt().
    [[nodiscard]] Frame finish_frame(std::span<const SingleFrameDepth* const> frames,
                                     std::size_t now, const CleaningPlan& plan, Frame frame = {}) {
        return felt(settle(frames, now, plan), std::move(frame));
    }

    /// All parts for a frame without frames before or after it.
    [[nodiscard]] Frame clean_and_finish(DepthImage image, const CleaningPlan& plan,
                                         std::span<const HeldLevel> held = {});

    /// Where the memory of finished frames comes back to, unless they are larger than 4K video.
    [[nodiscard]] const ObjectPool<DepthImage>& images() const noexcept { return images_; }

  private:
    [[nodiscard]] DepthImage filtered_in_time(std::span<const SingleFrameDepth* const> frames,
                                              std::size_t now, const DepthNoise& noise);
    [[nodiscard]] SettledDepth smoothed(std::shared_ptr<DepthImage> made,
                                        const SingleFrameDepth& of, bool steady,
                                        const CleaningPlan& plan);
    void densify(DepthImage& image, const ColourImage* colour);
    /// The held levels of pixels that still have no data.
    [[nodiscard]] std::span<const HeldLevel> in_holes(std::span<const HeldLevel> held,
                                                      const DepthImage& image);
    void close_holes(SingleFrameDepth& single_frame, bool fill, std::span<const HeldLevel> held);

    SparseInterpolator sparse_{};
    std::vector<std::uint8_t> interpolated_{};  ///< 1: no data before; empty: nothing was done
    std::vector<HeldLevel> held_in_holes_{};
    SpikeRemover spikes_{};
    DepthImage seen_{};  ///< before holes are filled
    HeldFiller held_{};
    SmallHoleFiller small_holes_{};
    LargeHoleFiller large_holes_{};
    SilhouetteSharpener silhouettes_{};
    FrameScale scale_{};
    TemporalFilter temporal_{};
    StepSmoother steps_{};
    NoiseSmoother noise_{};
    OutlineSmoother outlines_{};
    FingertipDilation finger_{};
    ObjectPool<DepthImage> images_{};  ///< of finished frames
};

}  // namespace dibhr
