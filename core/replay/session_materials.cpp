// Reads bump maps and touch maps once, and lays them over images of a size.
#include "core/replay/session_materials.hpp"

#include <utility>

#include "core/error.hpp"
#include "core/haptics/surface.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/touch_map_files.hpp"

namespace dibhr {

SessionMaterials::SessionMaterials(const Session& session, const Options& options, SurfaceSize size,
                                   const ReadBump& read)
    : session_(session), size_(size) {
    read_bumps(options, read);
    if (options.maps) read_maps();
}

void SessionMaterials::read_bumps(const Options& options, const ReadBump& read) {
    if (!options.bump.empty()) {
        other_bump_ = std::make_shared<const BumpMap>(read_bump_map(options.bump));
        stretch(other_bump_, size_.columns, size_.rows, options.bump_size_px);
        return;
    }
    for (const SessionParameters& parameters : session_.parameters()) {
        const SessionMedia& bump = parameters.bump;
        if (!bump.file.empty() && !bumps_.contains(bump.file)) bumps_[bump.file] = read(bump);
    }
}

std::shared_ptr<const BumpMap> SessionMaterials::bump(const SessionParameters& parameters) {
    if (other_bump_) return other_bump_;
    const auto found = bumps_.find(parameters.bump.file);
    if (found == bumps_.end()) return nullptr;
    stretch(found->second, size_.columns, size_.rows, parameters.touch.shape.bump_size_px);
    return found->second;
}

void SessionMaterials::read_maps() {
    for (const SessionSource& each : session_.sources()) {
        const std::uint32_t version = each.source.maps;
        if (version == 0 || maps_.contains(version)) continue;
        std::vector<SessionMap> maps = session_.maps_of(version);
        if (maps.empty())
            throw InputError(session_.file().string() +
                             ": does not hold the touch maps that were felt, as its recording was "
                             "broken off; replay it with --maps off");
        maps_.emplace(version, std::move(maps));
    }
}

std::shared_ptr<const TouchMaps> SessionMaterials::maps_of(const FrameSource& source,
                                                           SurfaceSize size) {
    const auto kept = maps_.find(source.maps);
    if (kept == maps_.end()) return nullptr;
    if (decoded_maps_ && decoded_maps_->version == source.maps) return decoded_maps_;
    auto maps = std::make_shared<TouchMaps>();
    maps->version = source.maps;
    for (const SessionMap& map : kept->second) {
        const auto kind = touch_map_kind_named(map.kind);
        if (!kind) continue;
        maps->of(*kind) =
            touch_map_in(map.png, {map.lowest, map.highest}, session_.file().string());
    }
    lay_heights(*maps, size.columns, size.rows);
    decoded_maps_ = std::move(maps);
    return decoded_maps_;
}

}  // namespace dibhr
