// Finds pictures by a pattern of names: depth_%04d.png, rgb/*.jpg.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

struct PictureSet;

/// Whether the name is a pattern, with printf's number (%d, %04d) or with stars, and no file has
/// this name.
[[nodiscard]] bool is_picture_pattern(const std::filesystem::path& place);

/// Whether the file's name matches a pattern with a number: "frame-%06d.png".
[[nodiscard]] bool fits_number_pattern(const std::filesystem::path& file,
                                       const std::string& pattern);

/// The pictures in the pattern's folder whose names match, in order of number; all in `unnamed`.
/// Throws InputError when there are none.
[[nodiscard]] PictureSet pictures_of_pattern(const std::filesystem::path& pattern);

}  // namespace dibhr
