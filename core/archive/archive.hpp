// A folder of sessions and studies to publish or to hand in. README.md describes it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dibhr {

struct ArchiveRequest {
    std::vector<std::filesystem::path> files{};  ///< sessions and studies
    std::filesystem::path folder{};              ///< new, or empty
    std::string program{};                       ///< its version, "1.2.3"
    std::string name{};                          ///< empty: the folder's
    std::string licence{};                       ///< empty: not stated
    std::vector<std::string> authors{};
    bool copy_media{false};  ///< else their sums only
    /// Called with the share that is done, 0 to 1; what it throws ends the work.
    std::function<void(double)> progress{[](double) {}};
};

struct ArchiveSummary {
    std::size_t sessions{0};  ///< those of studies too
    std::size_t participants{0};
    std::size_t files{0};                 ///< but for the manifest
    std::vector<std::string> warnings{};  ///< sentences: media that were not copied, missing logs
};

/// Writes the whole folder or nothing; `files` stay as they are. Throws InputError for a file that
/// cannot be archived whole, and when the folder cannot be written.
ArchiveSummary write_archive(const ArchiveRequest& request);

struct ArchiveCheck {
    std::vector<std::string> faults{};  ///< sentences; none: the archive is complete
    ArchiveSummary found{};
};

/// Checks the sum of every file, and that the tables say what the sessions and studies say. Throws
/// InputError where there is no archive.
[[nodiscard]] ArchiveCheck check_archive(const std::filesystem::path& folder,
                                         const std::function<void(double)>& progress);

}  // namespace dibhr
