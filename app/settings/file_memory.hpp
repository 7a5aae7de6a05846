// What is saved about a shown file for the next time: relief, view, position.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// Only values that the user changed.
struct FileMemory {
    std::optional<double> relief_px{};  ///< the user's; nothing: fitted to the media
    std::string view{};  ///< as text_of(Camera::View) has it; empty: the whole relief
    double at_s{0.0};    ///< playing position when it was closed [s]

    bool operator==(const FileMemory&) const = default;
};

/// $XDG_STATE_HOME/dibhr/files, or ~/.local/state/dibhr/files.
[[nodiscard]] std::filesystem::path file_memories_path();

/// The memory of that media from the folder; empty where there is none or it cannot be parsed.
[[nodiscard]] FileMemory read_memory(const std::filesystem::path& folder,
                                     const std::filesystem::path& media);

/// Writes the file whole or not at all; removes it for an empty memory. Throws InputError when the
/// folder cannot be written.
void keep_memory(const std::filesystem::path& folder, const std::filesystem::path& media,
                 const FileMemory& memory);

}  // namespace dibhr
