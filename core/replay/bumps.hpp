// The bump maps that were laid over the surface in a session.
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "core/haptics/depth_image.hpp"
#include "core/replay/media.hpp"
#include "core/session/session.hpp"

namespace dibhr {

class SessionBumps {
  public:
    SessionBumps() = default;
    /// Reads all of them. Throws InputError for one that is not found, or has changed.
    SessionBumps(const Session& session, SessionMediaFinder& finder);

    /// Null: none was laid over the surface.
    [[nodiscard]] std::shared_ptr<const BumpMap> of(const SessionParameters& parameters) const;

  private:
    std::map<std::filesystem::path, std::shared_ptr<const BumpMap>> maps_{};  // by recorded names
};

}  // namespace dibhr
