// Recordings that only their maker's programs read: what they are and how to convert them; inside
// the room.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

/// The rest of a sentence that begins with the file's name: what it is, and what to do. Empty for
/// every other file.
[[nodiscard]] std::string advice_on_foreign(const std::filesystem::path& file);

}  // namespace dibhr
