// What a folder holds that can be opened: recordings, with colour and depth of one as one entry.
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
    std::filesystem::path file{};   ///< colour, where there is a pair; whole
    std::filesystem::path depth{};  ///< of the same recording; empty: none
    std::uintmax_t bytes{0};        ///< both; 0 of a folder
    std::filesystem::file_time_type changed{};

    /// "take_color.mp4 + take_depth.mp4"
    [[nodiscard]] std::string name() const;
};

struct Folder {
    std::filesystem::path path{};        ///< whole; empty: none was read
    std::vector<FolderEntry> entries{};  ///< folders first, each in natural order
    std::string trouble{};               ///< why it could not be read; a plain sentence
};

/// Reads it; nothing hidden. Takes the disk's time: not for the window's thread.
[[nodiscard]] Folder read_folder(const std::filesystem::path& path);

/// How the names of files end that the program opens: ".mp4", in small letters.
[[nodiscard]] std::vector<std::string> endings_that_open();

/// Whether it is what the program opens: all but `other`.
[[nodiscard]] bool can_be_opened(const FolderEntry& entry) noexcept;

/// From the root on and without "..", where the current folder is known.
[[nodiscard]] std::filesystem::path whole_path(const std::filesystem::path& file);

/// What a person who typed that means: a file or folder that is there, in `folder` or from the
/// current one on; else `chosen`; else, for the program to say why not, what was typed. Asks the
/// disk: not for the window's thread.
[[nodiscard]] FolderEntry entry_meant(const Folder& folder, const std::string& typed,
                                      const std::optional<FolderEntry>& chosen);

/// The entry that `file` is in, alone or in a pair; nothing: it is not there.
[[nodiscard]] std::optional<std::size_t> entry_of(const Folder& folder,
                                                  const std::filesystem::path& file);

/// What a person typed, so far as it goes on in one way: "/da" as "/data/". Of entries of the same
/// beginning their common part. Relative to `folder`. As it was where nothing goes on. Asks the
/// disk.
[[nodiscard]] std::string completed(const std::string& typed, const std::filesystem::path& folder);

}  // namespace dibhr
