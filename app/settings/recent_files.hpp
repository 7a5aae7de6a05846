// Which files were opened before: a text file in the user's state folder, a line each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr {

/// A colour file or a session, and the depth file that was named with it; empty: none.
struct RecentFile {
    std::filesystem::path colour{};
    std::filesystem::path depth{};

    bool operator==(const RecentFile&) const = default;
};

/// $XDG_STATE_HOME/dibhr/recent, or ~/.local/state/dibhr/recent.
[[nodiscard]] std::filesystem::path recent_files_path();

/// At most twelve, the last opened first; empty where the file is missing or has no valid line.
[[nodiscard]] std::vector<RecentFile> read_recent_files(const std::filesystem::path& file);

/// The list with `opened` moved or added to its front, with absolute paths.
[[nodiscard]] std::vector<RecentFile> with_first(const RecentFile& opened,
                                                 std::vector<RecentFile> files);

/// The same in the file. Throws InputError when the file cannot be written.
void add_recent_file(const RecentFile& opened, const std::filesystem::path& file);

/// A typed path: ~ and ~/... are replaced by the home folder.
[[nodiscard]] std::filesystem::path expand_home(const std::string& text);

}  // namespace dibhr
