// What is opened, and how it plays: plain data that both windows show.
#pragma once

#include <filesystem>
#include <vector>

#include "app/settings/recent_files.hpp"
#include "app/settings/settings.hpp"
#include "core/video/media.hpp"
#include "core/video/player.hpp"

namespace dibhr {

/// Files a person wants to see; an empty depth is found beside the colour file.
struct OpenRequest {
    std::filesystem::path colour{};
    std::filesystem::path depth{};
    bool in_any_order{false};  ///< dropped together: which is which is found out
    DepthRequest request{usual_depth_request()};
    bool chosen{false};  ///< other words on the panel, to be kept once they have opened it
    double at_s{0.0};    ///< where to go on [s]
    bool paused{false};  ///< and to stand still there
    bool again{false};   ///< what is live has changed: it is tried until it comes
};

/// The window thread's.
struct MediaState : MediaDescription {
    PlaybackStatus playback{};
    OpenRequest opened{};  ///< how it was opened
    std::vector<RecentFile> recent{};
    bool opening{false};
    bool as_recorded{false};  ///< the depth, while its key is held

    void describe(const MediaDescription& now) { static_cast<MediaDescription&>(*this) = now; }
};

}  // namespace dibhr
