// What is remembered of a file that was shown, for the next time: its relief, the view, the moment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// Nothing of what nobody changed.
struct FileMemory {
    std::optional<double> relief_px{};  ///< a person's own, instead of the one that fits
    std::string view{};  ///< as text_of(Camera::View) has it; empty: the whole relief
    double at_s{0.0};    ///< where it was left [s]

    bool operator==(const FileMemory&) const = default;
};

/// $XDG_STATE_HOME/dibhr/files, or ~/.local/state/dibhr/files.
[[nodiscard]] std::filesystem::path file_memories_path();

/// Of that media, from the folder; nothing where there is none or it cannot be understood.
[[nodiscard]] FileMemory read_memory(const std::filesystem::path& folder,
                                     const std::filesystem::path& media);

/// Whole or not at all; of a memory of nothing no file remains. Throws InputError when the folder
/// cannot be written.
void keep_memory(const std::filesystem::path& folder, const std::filesystem::path& media,
                 const FileMemory& memory);

}  // namespace dibhr
