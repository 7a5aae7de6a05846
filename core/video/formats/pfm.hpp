// Portable float maps (.pfm), as stereo datasets leave them; inside the room.
#pragma once

#include <filesystem>

#include "core/video/formats/still_picture.hpp"

namespace dibhr {

/// The values as they stand in the file: of its scale only the sign counts, which says the byte
/// order, as in the readers of the datasets themselves (OpenCV divides by it). Throws InputError.
[[nodiscard]] StillPicture read_pfm(const std::filesystem::path& file, PictureRole role);

}  // namespace dibhr
