// The bump maps of a session.
#include "core/replay/bumps.hpp"

#include "core/video/media.hpp"

namespace dibhr {

SessionBumps::SessionBumps(const Session& session, SessionMediaFinder& finder) {
    for (const SessionParameters& parameters : session.parameters()) {
        const SessionMedia& bump = parameters.bump;
        if (bump.file.empty() || maps_.contains(bump.file)) continue;
        maps_.emplace(bump.file, std::make_shared<const BumpMap>(
                                     read_bump_map(finder.find(bump, "bump map"))));
    }
}

std::shared_ptr<const BumpMap> SessionBumps::of(const SessionParameters& parameters) const {
    const auto found = maps_.find(parameters.bump.file);
    return found == maps_.end() ? nullptr : found->second;
}

}  // namespace dibhr
