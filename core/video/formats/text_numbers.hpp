// Numbers in text, which no reader reads: what they are, and the command that converts them; inside
// the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dibhr {

/// Whether the file begins like text: no zero and no control bytes. Also true for playlists, which
/// would have the decoder open other files. A video of plain pictures has a header in text.
[[nodiscard]] bool begins_like_text(const std::filesystem::path& file);

/// What to do about a file of numbers in text, as the rest of a sentence that begins with its name.
struct TextAdvice {
    std::string words{};       ///< "{}" and "{sides}" as in the table of forms; empty: no numbers
    std::uint64_t numbers{0};  ///< that "{sides}" stands for
};
[[nodiscard]] TextAdvice advice_on_numbers_in_text(const std::filesystem::path& file);

}  // namespace dibhr
