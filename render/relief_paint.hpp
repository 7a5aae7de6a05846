// How the relief is painted: with the video's colour, as clay, or with its depth in colours.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

enum class ReliefPaint : std::uint8_t { video, clay, turbo, viridis, grey };

inline constexpr std::array<NamedValue<ReliefPaint>, 5> kReliefPaintNames{
    {{ReliefPaint::video, "video", "Colour of the video"},
     {ReliefPaint::clay, "clay", "Clay"},
     {ReliefPaint::turbo, "turbo", "Depth, turbo"},
     {ReliefPaint::viridis, "viridis", "Depth, viridis"},
     {ReliefPaint::grey, "grey", "Depth, grey"}}};
static_assert(has_all_in_order(kReliefPaintNames, ReliefPaint::grey));

[[nodiscard]] constexpr const auto& name_table(ReliefPaint) noexcept {
    return kReliefPaintNames;
}

/// Colours for depth, from the farthest to the nearest: one row of 256 pixels. Null for the video's
/// colour and clay.
[[nodiscard]] std::shared_ptr<const ColourImage> depth_colours(ReliefPaint paint);

/// A depth image in those colours, subsampled to at most `most_side` columns and rows. `unseen`: 1
/// for each pixel where no surface was ever seen, painted dark blue; may be null. Returns null for
/// the video's colour and clay.
[[nodiscard]] std::shared_ptr<const ColourImage> depth_picture(
    const DepthImage& depth, const std::vector<std::uint8_t>* unseen, ReliefPaint paint,
    int most_side);

}  // namespace dibhr
