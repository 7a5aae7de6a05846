// The touch maps of a recording as pictures beside it, found by their names.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/haptics/touch_maps.hpp"

namespace dibhr {

/// Where the map of that kind is kept, beside the depth of a recording: "cup_depth.mp4" has
/// cup_stiffness.png, cup_friction.png, cup_height.png. One that is there under the whole name,
/// "cup_depth_stiffness.png", is that one.
[[nodiscard]] std::filesystem::path touch_map_file(const std::filesystem::path& depth,
                                                   TouchMapKind kind);

/// Whether the file is called as a map and is no recording of its own: of stiffness or friction, or
/// of height where the limits of maps are beside it.
[[nodiscard]] bool names_touch_map(const std::filesystem::path& file);

/// The maps beside a recording whose depth has columns x rows, ready to be felt; null: there are
/// none. A picture of 8 or 16 bits, grey or its luma, is linear from the lowest to the highest
/// value of its kind, as cup_maps.toml says them or standard_limits(); alpha, where it has some, is
/// how much of it covers a pixel. Throws InputError: which file, and what to do.
[[nodiscard]] std::shared_ptr<const TouchMaps> read_touch_maps(const std::filesystem::path& depth,
                                                               int columns, int rows);

/// Writes them there, each whole or not at all, with their limits; removes the file of a map that
/// covers nothing. Throws InputError.
void write_touch_maps(const TouchMaps& maps, const std::filesystem::path& depth);

/// The bytes of a map's picture: PNG, 16 bits, its level in red, green and blue, its cover in
/// alpha. Throws InputError for one without pixels.
[[nodiscard]] std::string png_of(const TouchMap& map);

/// And back, to the same bits. Throws InputError that begins with `name`.
[[nodiscard]] TouchMap touch_map_in(const std::string& png, const MapLimits& limits,
                                    const std::string& name);

}  // namespace dibhr
