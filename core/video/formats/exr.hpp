// OpenEXR pictures: depth as renderers and estimators leave it, often beside colours; inside the
// room.
#pragma once

#include <filesystem>

#include "core/video/formats/still_picture.hpp"

namespace dibhr {

/// Of its display window; outside its data window, and at renderers' infinity, is no data. Depth is
/// the channel Z, else V, Y or R, of a layer that says depth before others; of R, G and B that
/// differ all three. Throws InputError.
[[nodiscard]] StillPicture read_exr(const std::filesystem::path& file, PictureRole role);

/// Channels R, G and B, and a Z or V. False when the file cannot be read.
[[nodiscard]] bool exr_has_colour_and_depth(const std::filesystem::path& file);

}  // namespace dibhr
