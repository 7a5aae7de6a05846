// The files of a folder that can be opened; colour and depth of a recording are one entry.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dibhr {

enum class FileKind { folder, session, video, picture, other };

/// "folder", "session", ...
[[nodiscard]] const char* name_of(FileKind kind) noexcept;

/// A row of a folder.
struct FolderEntry {
    FileKind kind{FileKind::other};
    std::filesystem::path file{};   ///< colour, where there is a pair; absolute
    std::filesystem::path depth{};  ///< of the same recording; empty: none
    std::uintmax_t bytes{0};        ///< both; 0 of a folder
    std::filesystem::file_time_type changed{};
    bool recording{false};  ///< a folder that opens as one
    int folders{0};         ///< in such a folder, which may hold recordings, too

    /// "take_color.mp4 + take_depth.mp4"
    [[nodiscard]] std::string name() const;
};

struct Folder {
    std::filesystem::path path{};        ///< absolute; empty: none was read
    std::vector<FolderEntry> entries{};  ///< folders first, each in natural order
    std::string trouble{};               ///< why it could not be read; a plain sentence
};

/// Reads a folder, without hidden files. Waits for the disk: not for the window's thread.
[[nodiscard]] Folder read_folder(const std::filesystem::path& path);

/// Extensions of the files that the program opens: ".mp4", in small letters.
[[nodiscard]] std::vector<std::string> endings_that_open();

/// Whether the entry is a place to look into, and no recording.
[[nodiscard]] bool is_only_folder(const FolderEntry& entry) noexcept;

/// Whether the program opens it: all kinds except `other`.
[[nodiscard]] bool can_be_opened(const FolderEntry& entry) noexcept;

/// The absolute path without ".."; unchanged where the current folder is unknown.
[[nodiscard]] std::filesystem::path whole_path(const std::filesystem::path& file);

/// The entry for a typed name: an existing file or folder in `folder` or in the current one (with a
/// slash behind its name, a folder to look into); else `chosen`; nothing: there is no such file.
/// Waits for the disk: not for the window's thread.
[[nodiscard]] std::optional<FolderEntry> resolve_typed(const Folder& folder,
                                                       const std::string& typed,
                                                       const std::optional<FolderEntry>& chosen);

/// Index of the entry that contains `file`, alone or in a pair; nothing: none.
[[nodiscard]] std::optional<std::size_t> index_of_entry(const Folder& folder,
                                                        const std::filesystem::path& file);

/// Completes a typed path: "/da" gives "/data/"; for several matches their common beginning;
/// without a match the typed path. Relative paths begin in `folder`. Waits for the disk: not for
/// the window's thread.
[[nodiscard]] std::string completed(const std::string& typed, const std::filesystem::path& folder);

}  // namespace dibhr
