// What the relief is painted with: the video's colour, clay, or its depth in colours.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/words.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

enum class ReliefPaint : std::uint8_t { video, clay, turbo, viridis, grey };

inline constexpr std::array<Word<ReliefPaint>, 5> kReliefPaintWords{
    {{ReliefPaint::video, "video", "Colour of the video"},
     {ReliefPaint::clay, "clay", "Clay"},
     {ReliefPaint::turbo, "turbo", "Depth, turbo"},
     {ReliefPaint::viridis, "viridis", "Depth, viridis"},
     {ReliefPaint::grey, "grey", "Depth, grey"}}};
static_assert(has_all_in_order(kReliefPaintWords, ReliefPaint::grey));

[[nodiscard]] constexpr const auto& words_of(ReliefPaint) noexcept {
    return kReliefPaintWords;
}

/// Colours for depth, from the farthest to the nearest: one row of 256 pixels. Null for a paint
/// that is not of depth.
[[nodiscard]] std::shared_ptr<const ColourImage> depth_colours(ReliefPaint paint);

/// A depth image in those colours, thinned out to at most `most_side` columns and rows. `unseen`,
/// of its pixels: 1 where no surface was ever seen, which is dark blue; null: seen all over. Null
/// for a paint that is not of depth.
[[nodiscard]] std::shared_ptr<const ColourImage> depth_picture(
    const DepthImage& depth, const std::vector<std::uint8_t>* unseen, ReliefPaint paint,
    int most_side);

}  // namespace dibhr
