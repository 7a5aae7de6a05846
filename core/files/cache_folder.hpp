// A folder of the user's cache, named by a hash of what its files were made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dibhr {

/// A folder, locked while this object lives. Its files stay for the next run.
class CacheFolder {
  public:
    /// Creates the folder in `cache`. `what` is kept there: "estimated depth". Throws InputError
    /// when that fails, or, with the sentence `busy`, where another program has the lock.
    CacheFolder(const std::filesystem::path& cache, const std::string& key, const std::string& what,
                const std::string& busy);
    ~CacheFolder();
    CacheFolder(const CacheFolder&) = delete;
    CacheFolder& operator=(const CacheFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    /// Removes all files but the lock.
    void empty() const;

  private:
    std::filesystem::path path_;
    int lock_{-1};
};

/// The folders in a cache; empty without a cache.
[[nodiscard]] std::vector<std::filesystem::path> cache_folders(const std::filesystem::path& cache);

/// Notes that the files of a folder were used now.
void note_use(const std::filesystem::path& folder) noexcept;
/// When they were used last.
[[nodiscard]] std::filesystem::file_time_type last_use(
    const std::filesystem::path& folder) noexcept;

/// Removes a folder; false when another program has the lock. Throws InputError when that fails.
bool remove_cache_folder(const std::filesystem::path& folder, const std::string& what);

/// Of all files in a folder and below it.
[[nodiscard]] std::uintmax_t bytes_in(const std::filesystem::path& folder) noexcept;

/// Ignores a failure to remove: a later write to that place reports it.
void clear_away(const std::filesystem::path& place) noexcept;

}  // namespace dibhr
