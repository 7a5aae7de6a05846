// What is refused before any reader sees it, and with which advice; inside the room.
#pragma once

#include <filesystem>

namespace dibhr {

/// Refuses what no decoder could read: missing, a directory, a pipe or device, no permission,
/// empty, text, recordings that only their maker's programs read. Throws InputError: what,
/// which file, what to do next.
void require_readable(const std::filesystem::path& file);

/// Throws InputError when a picture is too small to touch or show (less than 2 x 2).
void require_size(const std::filesystem::path& file, int columns, int rows);

}  // namespace dibhr
