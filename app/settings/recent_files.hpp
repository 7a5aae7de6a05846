// Which files were opened before: a text file in the user's state folder, a line each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr {

/// A colour file or a session, and the depth file that was named with it; empty: none was.
struct RecentFile {
    std::filesystem::path colour{};
    std::filesystem::path depth{};

    bool operator==(const RecentFile&) const = default;
};

/// $XDG_STATE_HOME/dibhr/recent, or ~/.local/state/dibhr/recent.
[[nodiscard]] std::filesystem::path recent_files_path();

/// The last one opened first, at most twelve; none where the file is not there or holds nothing
/// that can be understood.
[[nodiscard]] std::vector<RecentFile> read_recent_files(const std::filesystem::path& file);

/// With it first, with absolute paths, and nowhere else.
[[nodiscard]] std::vector<RecentFile> with_first(const RecentFile& opened,
                                                 std::vector<RecentFile> files);

/// The same in the file. Throws InputError when the file
/// cannot be written.
void remember(const RecentFile& opened, const std::filesystem::path& file);

/// A path as people type it: ~ and ~/... are in their home folder.
[[nodiscard]] std::filesystem::path typed_path(const std::string& text);

}  // namespace dibhr
