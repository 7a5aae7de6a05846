// What is done to recorded depth before it is drawn and touched.
#pragma once

#include <array>
#include <cstdint>

#include "core/haptics/words.hpp"

namespace dibhr {

/// The steps, in the order in which they are done; each on its own.
struct CleaningSteps {
    bool remove_spikes{false};  ///< single pixels that stand out, small patches alone in holes
    bool fill_holes{false};     ///< where there is no data, take what was there, or is around
    bool sharpen_silhouettes{false};  ///< ramps between near and far become steps
    bool colour_edges{false};         ///< of wide ramps: where the colour has its edge
    bool steady{false};               ///< what does not move keeps its level, frame after frame
    bool smooth_steps{false};         ///< 8-bit terraces, within half a level of the data
    bool smooth_noise{false};         ///< within the noise of the recording

    bool operator==(const CleaningSteps&) const = default;
};

/// Each step of a CleaningSteps and its name: visit(name, step).
template <typename Steps, typename Visit>
void visit_steps(Steps& steps, const Visit& visit) {
    visit("remove-spikes", steps.remove_spikes);
    visit("fill-holes", steps.fill_holes);
    visit("sharpen-silhouettes", steps.sharpen_silhouettes);
    visit("colour-edges", steps.colour_edges);
    visit("steady", steps.steady);
    visit("smooth-steps", steps.smooth_steps);
    visit("smooth-noise", steps.smooth_noise);
}

/// Nothing: levels as they are in the file, no data the farthest.
inline constexpr CleaningSteps kRawSteps{};
/// What can be told from one frame without knowing its noise.
inline constexpr CleaningSteps kGentleSteps{
    .remove_spikes = true, .fill_holes = true, .smooth_steps = true};
/// All of it but the colour's edges, so that a surface is of its depth alone: for what cameras and
/// estimators measure.
inline constexpr CleaningSteps kSensorSteps{.remove_spikes = true,
                                            .fill_holes = true,
                                            .sharpen_silhouettes = true,
                                            .steady = true,
                                            .smooth_steps = true,
                                            .smooth_noise = true};

/// Which steps: those of a name, those that the noise of the clip asks for, or one's own.
enum class CleaningPreset : std::uint8_t { automatic, raw, gentle, sensor, own };

inline constexpr std::array<Word<CleaningPreset>, 5> kCleaningWords{
    {{CleaningPreset::automatic, "auto", "Auto"},
     {CleaningPreset::raw, "raw", "Raw"},
     {CleaningPreset::gentle, "gentle", "Gentle"},
     {CleaningPreset::sensor, "sensor", "Sensor"},
     {CleaningPreset::own, "own", "Own"}}};
static_assert(has_all_in_order(kCleaningWords, CleaningPreset::own));

[[nodiscard]] constexpr const auto& words_of(CleaningPreset) noexcept {
    return kCleaningWords;
}

/// Which steps are asked for.
struct CleaningChoice {
    CleaningPreset preset{CleaningPreset::automatic};
    CleaningSteps own{kGentleSteps};  ///< of CleaningPreset::own

    bool operator==(const CleaningChoice&) const = default;
};

/// A ball that touches instead of a point; its lowest point is what is felt and drawn as the proxy.
struct Fingertip {
    double radius_px{0.0};  ///< 0: a point; not more than kWidestFinger_px counts
    double relief_px{0.0};  ///< elevation of the highest level, as in SurfaceShape

    bool operator==(const Fingertip&) const = default;
};

/// A thicker finger than anybody's [mm].
inline constexpr double kThickestFinger_mm = 25.0;

/// What is asked for.
struct CleaningOptions {
    CleaningPreset preset{CleaningPreset::automatic};
    CleaningSteps own{kGentleSteps};  ///< of CleaningPreset::own
    Fingertip finger{};

    bool operator==(const CleaningOptions&) const = default;
};

/// What was done to a frame.
struct FrameCleaning {
    CleaningSteps steps{};
    Fingertip finger{};

    bool operator==(const FrameCleaning&) const = default;
};

}  // namespace dibhr
