// Small texts that people write: settings, sidecars, materials, protocols.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// The content of an ordinary file of at most a megabyte, more than any such text needs; nothing:
/// it is larger, no ordinary file, or cannot be read.
[[nodiscard]] std::optional<std::string> small_text_in(const std::filesystem::path& file);

}  // namespace dibhr
