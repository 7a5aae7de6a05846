// Where estimated depth is kept: a folder for each colour and command, by what they hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/estimate/colour_frames.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// What is known of one estimation, written down beside it.
struct EstimateRecord {
    ColourFrames colour{};
    std::string command{};
    DepthStatement said{};    ///< of the estimator's numbers, the last time
    std::string depth{};      ///< name of the finished file; empty: it is on its way
    std::string sha256{};     ///< of that file
    DepthStatement levels{};  ///< of that file, as write_depth() gives it
};

/// The folder of one estimation. What is in it goes with a new one of the same only when it is
/// asked to.
class EstimateFolder {
  public:
    /// In `cache`, for a colour's content and a command; is made. Throws InputError where it cannot
    /// be, or where another program is at it.
    EstimateFolder(const std::filesystem::path& cache, const std::string& colour_sha256,
                   const std::string& command);
    ~EstimateFolder();
    EstimateFolder(const EstimateFolder&) = delete;
    EstimateFolder& operator=(const EstimateFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    [[nodiscard]] std::filesystem::path frames() const { return path_ / "frames"; }
    [[nodiscard]] std::filesystem::path output() const { return path_ / "output"; }
    /// All that the estimator said the last time.
    [[nodiscard]] std::filesystem::path said() const { return path_ / "said.txt"; }

    /// Nothing: there is none that can be understood.
    [[nodiscard]] std::optional<EstimateRecord> record() const;
    /// Whole or not at all. Throws InputError.
    void keep(const EstimateRecord& record) const;
    /// All but its lock.
    void empty() const;
    /// What only the estimator needed.
    void drop_work() const;

  private:
    std::filesystem::path path_;
    int lock_{-1};
};

/// A row of `dibhr depth --list`.
struct KeptEstimate {
    std::filesystem::path folder{};
    EstimateRecord record{};
    std::size_t frames_there{0};
    std::uintmax_t bytes{0};
};

/// All in the cache, by the colour's name; no cache is an empty one.
[[nodiscard]] std::vector<KeptEstimate> kept_estimates(const std::filesystem::path& cache);

/// Removes one; false where another program is at it. Throws InputError when it cannot be.
bool forget_estimate(const KeptEstimate& kept);

}  // namespace dibhr
