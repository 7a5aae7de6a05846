// The text of a CSV file, and pieces of it as people may see them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dibhr {

/// All of the file. Throws InputError: what is wrong with it, then `wanted`, what to give instead.
[[nodiscard]] std::string text_of_file(const std::filesystem::path& file,
                                       const std::string& wanted);

/// Without the mark (BOM) that some editors write first.
[[nodiscard]] std::string_view without_mark(std::string_view text);

/// A cell without the space, tabs, carriage returns and quotation marks around it.
[[nodiscard]] std::string_view trimmed(std::string_view cell);

/// In quotation marks; whatever the file holds, it stays short and on one line.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace dibhr
