// What can be said about a given file before any decoder sees it.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

/// Refuses what no decoder could read: missing, a directory, a pipe or device, no permission,
/// empty, text. Throws InputError: what, which file, what to do next.
void require_readable(const std::filesystem::path& file);

/// Throws InputError when a picture is too small to touch or show (less than 2 x 2).
void require_size(const std::filesystem::path& file, int columns, int rows);

/// The name in quotes, as messages show it, without control characters: always one line.
[[nodiscard]] std::string shown(const std::filesystem::path& file);

/// Whether the file's name says that it holds depth.
[[nodiscard]] bool named_depth(const std::filesystem::path& file);

}  // namespace dibhr
