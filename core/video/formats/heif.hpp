// HEIC photos: a colour picture, and the depth that portraits have beside it; inside the room.
#pragma once

#include <filesystem>

#include "core/video/formats/still_picture.hpp"

namespace dibhr {

/// The primary picture, or its depth picture, each turned as it says itself. Throws InputError,
/// also when depth is asked for and there is none.
[[nodiscard]] StillPicture read_heif(const std::filesystem::path& file, PictureRole role);

/// False when the file cannot be read.
[[nodiscard]] bool heif_has_depth(const std::filesystem::path& file);

}  // namespace dibhr
