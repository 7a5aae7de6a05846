// Names of pictures by a pattern: depth_%04d.png, rgb/*.jpg.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

struct PictureSet;

/// Whether the name is a pattern, with a number as printf has it (%d, %04d) or with stars, and no
/// file is called so.
[[nodiscard]] bool is_picture_pattern(const std::filesystem::path& place);

/// Whether the file's name is of that pattern, which has a number: "frame-%06d.png".
[[nodiscard]] bool fits_number_pattern(const std::filesystem::path& file,
                                       const std::string& pattern);

/// The pictures in the pattern's folder whose names it matches, by number; as unnamed, whatever
/// they are called. Throws InputError when there are none.
[[nodiscard]] PictureSet pictures_of_pattern(const std::filesystem::path& pattern);

}  // namespace dibhr
