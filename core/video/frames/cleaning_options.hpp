// Options of cleaning: the steps applied to recorded depth before it is drawn and touched.
#pragma once

#include <array>
#include <cstdint>

#include "core/haptics/enum_names.hpp"

namespace dibhr {

/// The steps of cleaning in their order; each is on or off by itself.
struct CleaningSteps {
    bool densify{false};        ///< sparse depth is interpolated, up to the colour's edges
    bool remove_spikes{false};  ///< single pixels that stand out, small patches alone in holes
    bool fill_holes{false};     ///< pixels without data take their last level, or one beside
    bool sharpen_silhouettes{false};  ///< ramps between near and far become steps
    bool colour_edges{false};         ///< wide ramps become a step at the colour's edge
    bool steady{false};               ///< filter in time: what does not move keeps its level
    bool smooth_steps{false};         ///< 8-bit terraces, within half a level of the data
    bool smooth_noise{false};         ///< within the noise of the recording
    bool smooth_outlines{false};      ///< outlines lose their teeth

    bool operator==(const CleaningSteps&) const = default;
};

/// Each step of a CleaningSteps and its name: visit(name, step).
template <typename Steps, typename Visit>
void visit_steps(Steps& steps, const Visit& visit) {
    visit("densify", steps.densify);
    visit("remove-spikes", steps.remove_spikes);
    visit("fill-holes", steps.fill_holes);
    visit("sharpen-silhouettes", steps.sharpen_silhouettes);
    visit("colour-edges", steps.colour_edges);
    visit("steady", steps.steady);
    visit("smooth-steps", steps.smooth_steps);
    visit("smooth-noise", steps.smooth_noise);
    visit("smooth-outlines", steps.smooth_outlines);
}

/// Whether these steps depend on the colour picture, too.
[[nodiscard]] constexpr bool need_colour(const CleaningSteps& steps) noexcept {
    return steps.densify || (steps.sharpen_silhouettes && steps.colour_edges);
}

/// No step: levels as they are in the file; no data becomes the farthest level.
inline constexpr CleaningSteps kRawSteps{};
/// The steps that need one frame only, and no measured noise.
inline constexpr CleaningSteps kGentleSteps{
    .remove_spikes = true, .fill_holes = true, .smooth_steps = true, .smooth_outlines = true};
/// For the depth of cameras and estimators: all steps but those that need the colour. (Of presets,
/// sparse depth alone is densified: plan_of.)
inline constexpr CleaningSteps kSensorSteps{.remove_spikes = true,
                                            .fill_holes = true,
                                            .sharpen_silhouettes = true,
                                            .steady = true,
                                            .smooth_steps = true,
                                            .smooth_noise = true,
                                            .smooth_outlines = true};

/// Which steps: a named set, the set that feels best on the clip (automatic), or the user's own.
enum class CleaningPreset : std::uint8_t { automatic, raw, gentle, sensor, own };

inline constexpr std::array<NamedValue<CleaningPreset>, 5> kCleaningPresetNames{
    {{CleaningPreset::automatic, "auto", "Auto"},
     {CleaningPreset::raw, "raw", "Raw"},
     {CleaningPreset::gentle, "gentle", "Gentle"},
     {CleaningPreset::sensor, "sensor", "Sensor"},
     {CleaningPreset::own, "own", "Own"}}};
static_assert(has_all_in_order(kCleaningPresetNames, CleaningPreset::own));

[[nodiscard]] constexpr const auto& name_table(CleaningPreset) noexcept {
    return kCleaningPresetNames;
}

/// The requested steps.
struct CleaningChoice {
    CleaningPreset preset{CleaningPreset::automatic};
    CleaningSteps own{kGentleSteps};  ///< used with CleaningPreset::own

    bool operator==(const CleaningChoice&) const = default;
};

/// A ball that touches instead of a point. Its lowest point is the proxy that is felt and drawn.
struct Fingertip {
    double radius_px{0.0};  ///< 0: a point; at most kWidestFinger_px is used
    double relief_px{0.0};  ///< elevation of the highest level, as in SurfaceShape

    bool operator==(const Fingertip&) const = default;
};

/// Upper limit of the fingertip's radius: thicker than any finger [mm].
inline constexpr double kThickestFinger_mm = 25.0;

/// The requested cleaning.
struct CleaningOptions {
    CleaningPreset preset{CleaningPreset::automatic};
    CleaningSteps own{kGentleSteps};  ///< used with CleaningPreset::own
    Fingertip finger{};

    bool operator==(const CleaningOptions&) const = default;
};

/// The cleaning that was applied to a frame.
struct FrameCleaning {
    CleaningSteps steps{};
    Fingertip finger{};

    bool operator==(const FrameCleaning&) const = default;
};

}  // namespace dibhr
