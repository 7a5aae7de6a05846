// What is live, as sources of pictures like files' ones; inside the room.
#pragma once

#include <filesystem>
#include <memory>

#include "core/video/depth/depth_meaning.hpp"
#include "core/video/live/live_feed.hpp"
#include "core/video/sources/sources.hpp"

namespace dibhr {

/// Whether any of the two is live.
[[nodiscard]] bool any_live(const std::filesystem::path& colour,
                            const std::filesystem::path& depth);

/// Colour and depth of two connections, in the halves of one's pictures, or depth alone, as
/// somebody says or as the first pictures look. `feed`: of these places, open already; null: they
/// are opened. Waits for the first pictures. Throws InputError when none come, when only one of the
/// two is live, and when there is no depth.
[[nodiscard]] Sources find_live_sources(const std::filesystem::path& colour,
                                        const std::filesystem::path& depth,
                                        const DepthStatement& said, std::shared_ptr<LiveFeed> feed);

}  // namespace dibhr
