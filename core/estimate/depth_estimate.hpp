// Makes depth for a video that has none by an estimator that the user has installed. The estimator
// runs as a process; its depth is checked, and kept in a cache.
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
    /// On the estimator's numbers. Default: relative (DepthUnit::levels), bright is near, as of
    /// most estimators.
    DepthStatement meaning{};
    std::filesystem::path cache{};
    double timeout_s{600.0};  ///< without output or new bytes
    bool again{false};        ///< ignore the cache
    ChildPriority priority{
        ChildPriority::normal};  ///< of the estimator, and of the thread that waits
};

struct DepthEstimate {
    std::filesystem::path depth{};  ///< with a sidecar beside it
    std::size_t frames{0};
    bool kept_before{false};  ///< from the cache; nothing was started
};

/// Makes the depth, or finds it in the cache by content and command. For a thread that may wait.
/// Nothing after the watch's stop(). Throws InputError: what went wrong, at which frame, and what
/// to do next; finished frames stay for the next run.
[[nodiscard]] std::optional<DepthEstimate> estimate_depth(const EstimateRequest& request,
                                                          EstimateWatch& watch);

/// Copies depth and sidecar to a file, whose ending must be the depth's, or into a folder, as
/// NAME_depth, so that it is found beside its colour. Returns the file. Throws InputError.
std::filesystem::path copy_depth(const DepthEstimate& estimate, const std::filesystem::path& colour,
                                 const std::filesystem::path& out);

}  // namespace dibhr
