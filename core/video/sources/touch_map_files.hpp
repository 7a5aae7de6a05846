// Reads and writes the touch maps of a recording: pictures beside it, found by their names.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/haptics/touch_maps.hpp"

namespace dibhr {

/// The file of the map of that kind, as beside_recording() has it: "cup_depth.mp4" has
/// cup_stiffness.png, cup_friction.png, cup_height.png.
[[nodiscard]] std::filesystem::path touch_map_file(const std::filesystem::path& depth,
                                                   TouchMapKind kind);

/// Whether the file's name is that of a map and not of a recording: of stiffness or friction, of
/// height where a file with the limits of maps is beside it, or of regions where their names are.
[[nodiscard]] bool names_touch_map(const std::filesystem::path& file);

/// The maps beside a recording whose depth has columns x rows, ready to be used; null: none. Levels
/// of 8 or 16 bits, of grey or luma, are linear from the lowest to the highest value of the map,
/// which cup_maps.toml or standard_limits() gives; alpha, if any, is how much the map covers a
/// pixel. Throws InputError: which file, and what to do.
[[nodiscard]] std::shared_ptr<const TouchMaps> read_touch_maps(const std::filesystem::path& depth,
                                                               int columns, int rows);

/// Writes the maps and their limits beside the depth, each file whole or not at all; removes the
/// file of a map that covers nothing. Throws InputError.
void write_touch_maps(const TouchMaps& maps, const std::filesystem::path& depth);

/// The bytes of a map's picture: PNG, 16 bits, its level in red, green and blue, its cover in
/// alpha. Throws InputError for one without pixels.
[[nodiscard]] std::string png_of(const TouchMap& map);

/// The map of such bytes, to the same bits. Throws InputError that begins with `name`.
[[nodiscard]] TouchMap touch_map_in(const std::string& png, const MapLimits& limits,
                                    const std::string& name);

}  // namespace dibhr
