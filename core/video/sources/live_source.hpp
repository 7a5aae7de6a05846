// Gives the pictures of a live source as PictureSources, as files do; inside the room.
#pragma once

#include <filesystem>
#include <memory>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/live/live_feed.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

/// Whether one of the two is live.
[[nodiscard]] bool any_live(const std::filesystem::path& colour,
                            const std::filesystem::path& depth);

/// Colour and depth of two connections, or of the halves of one connection's pictures, or depth
/// alone: as the statement says, else as the first pictures look. `feed`: open already for these
/// places; null: opens it. Waits for the first pictures. Throws InputError when none arrive, when
/// only one of the two is live, and when there is no depth.
[[nodiscard]] Sources find_live_sources(const std::filesystem::path& colour,
                                        const std::filesystem::path& depth,
                                        const DepthStatement& statement,
                                        std::shared_ptr<LiveFeed> feed);

}  // namespace dibhr
