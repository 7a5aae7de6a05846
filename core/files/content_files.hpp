// The files of a content, and whether a file has it.
#pragma once

#include <filesystem>
#include <vector>

#include "core/files/content_hash.hpp"

namespace dibhr {

/// The file itself, or all files in a folder, in order, without those whose names begin with a
/// point: file managers write them. Throws std::filesystem::filesystem_error.
[[nodiscard]] std::vector<std::filesystem::path> content_files(const std::filesystem::path& place);

/// Whether a file has the size and the sum of `content`; false for one that is not there. Throws
/// InputError when it cannot be read.
[[nodiscard]] bool has_content(const std::filesystem::path& file, const FileContent& content);

}  // namespace dibhr
