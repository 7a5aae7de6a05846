// Names of files and folders: in messages, in natural order, and those in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// The name in quotes, as messages show it, without control characters: always one line.
[[nodiscard]] std::string shown(const std::filesystem::path& file);

/// Whether there is an ordinary file, or a folder, of that name.
[[nodiscard]] bool is_file(const std::filesystem::path& place);
[[nodiscard]] bool is_folder(const std::filesystem::path& place);

/// The entries of a folder, in natural order. Throws InputError when it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

/// The words of a name in small letters: letters and bytes beyond ASCII, or digits.
/// "depthInMeters_02" has four.
[[nodiscard]] std::vector<std::string> words_of_name(std::string_view name);

/// 97 before 100: compares runs of digits by their value, everything else by its letters.
[[nodiscard]] bool in_natural_order(const std::string& a, const std::string& b);

}  // namespace dibhr
