// The cache of estimated depth: a folder for each colour content and command.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/estimate/colour_frames.hpp"
#include "core/files/cache_folder.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// The facts of one estimation, stored in its folder.
struct EstimateRecord {
    ColourFrames colour{};
    std::string command{};
    DepthStatement said{};    ///< on the estimator's numbers, at the last run
    std::string depth{};      ///< name of the finished file; empty: not finished
    std::string sha256{};     ///< of that file
    DepthStatement levels{};  ///< of that file, from write_depth()
};

/// The folder of one estimation, locked while this object lives. Its files stay for the next run.
class EstimateFolder {
  public:
    /// Creates the folder in `cache` for a colour's content and a command. Throws InputError when
    /// that fails, or another program has the lock.
    EstimateFolder(const std::filesystem::path& cache, const std::string& colour_sha256,
                   const std::string& command);

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return folder_.path(); }
    [[nodiscard]] std::filesystem::path frames() const { return path() / "frames"; }
    [[nodiscard]] std::filesystem::path output() const { return path() / "output"; }
    /// The file with the estimator's output of the last run.
    [[nodiscard]] std::filesystem::path said() const { return path() / "said.txt"; }

    /// Nothing: no valid record.
    [[nodiscard]] std::optional<EstimateRecord> record() const;
    /// Writes the record, whole or not at all. Throws InputError.
    void keep(const EstimateRecord& record) const;
    /// Removes all files but the lock.
    void empty() const { folder_.empty(); }
    /// Removes the files that only the estimator needed.
    void remove_work_files() const;

  private:
    CacheFolder folder_;
};

/// An estimation in the cache: a row of `dibhr depth --list`.
struct KeptEstimate {
    std::filesystem::path folder{};
    EstimateRecord record{};
    std::size_t frames_there{0};
    std::uintmax_t bytes{0};
};

/// All estimations in the cache, sorted by the colour's name; empty without a cache.
[[nodiscard]] std::vector<KeptEstimate> kept_estimates(const std::filesystem::path& cache);

/// Removes one; false when another program has the lock. Throws InputError when that fails.
bool forget_estimate(const KeptEstimate& kept);

}  // namespace dibhr
