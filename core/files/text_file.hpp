// Small texts that people write: settings, sidecars, materials, protocols.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// All of an ordinary file of a megabyte at most, which no page of text exceeds; nothing: it is
/// none, or cannot be read.
[[nodiscard]] std::optional<std::string> small_text_in(const std::filesystem::path& file);

}  // namespace dibhr
