// Depth for a video that has none: an estimator that a person has installed makes it, as a process
// of its own; it is checked, kept, and found again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "core/estimate/child_program.hpp"
#include "core/estimate/estimate_watch.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

struct EstimateRequest {
    std::filesystem::path colour{};
    std::string command{};  ///< as EstimatorCommand takes it
    /// Of the estimator's numbers; where it says nothing they are relative (DepthUnit::levels) and
    /// near where bright, as those of most estimators are.
    DepthStatement meaning{};
    std::filesystem::path cache{};
    double patience_s{600.0};                   ///< without any sign of life
    bool again{false};                          ///< whatever is kept
    ChildManner manner{ChildManner::ordinary};  ///< of the estimator, and of the thread that waits
};

struct DepthEstimate {
    std::filesystem::path depth{};  ///< beside it a sidecar
    std::size_t frames{0};
    bool kept_before{false};  ///< nothing was started
};

/// Makes the depth, or finds what was made before for the same content and the same command. For a
/// thread that may wait. Nothing where the watch's stop() came first. Throws InputError: what went
/// wrong, how far it came, and what to do next; what is done stays for the next time.
[[nodiscard]] std::optional<DepthEstimate> estimate_depth(const EstimateRequest& request,
                                                          EstimateWatch& watch);

/// Copies depth and sidecar: into a file of that name, which ends as the depth's does, or into a
/// folder, as NAME_depth beside whose colour it is found. Gives the file. Throws InputError.
std::filesystem::path copy_depth(const DepthEstimate& estimate, const std::filesystem::path& colour,
                                 const std::filesystem::path& out);

}  // namespace dibhr
