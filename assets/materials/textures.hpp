// The height of each material at a place of its map, in units of its own.
#pragma once

#include "assets/materials/texture.hpp"

namespace dibhr::materials {

/// Ridges and furrows of an old pine's bark, upright.
[[nodiscard]] double bark_at(Place at) noexcept;
/// Molten and frozen again, with scratches.
[[nodiscard]] double ice_at(Place at) noexcept;
/// Over and under of warp and weft with uneven threads.
[[nodiscard]] double linen_at(Place at) noexcept;
/// Blunt pyramids, as on a mat or a grip.
[[nodiscard]] double rubber_at(Place at) noexcept;
/// Sharp grains of many sizes in a bed of glue.
[[nodiscard]] double sandpaper_at(Place at) noexcept;
/// Small plateaus between the crossing creases of the back of a hand.
[[nodiscard]] double skin_at(Place at) noexcept;
/// Rough-hewn faces with pits.
[[nodiscard]] double stone_at(Place at) noexcept;
/// Weathered grain from left to right, with pores.
[[nodiscard]] double wood_at(Place at) noexcept;
/// Plain knitting: columns of stitches, each of two legs of yarn.
[[nodiscard]] double wool_at(Place at) noexcept;

}  // namespace dibhr::materials
