// The surface that a session holds, as frames: a replay without the video.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/replay/session_materials.hpp"
#include "core/replay/session_replay.hpp"
#include "core/session/session.hpp"
#include "core/session/surface_reader.hpp"
#include "core/video/frames/colour_image.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Where no surface is stored the surface is as low as the lowest level, and holds() is false. One
/// thread at a time.
class StoredFrames final : public RecordedSurfaces {
  public:
    /// `colour`: with the pictures that the session holds. Throws InputError for a session that
    /// holds no surface. `session` must outlive it.
    StoredFrames(const Session& session, const SessionMaterials::Options& options,
                 bool colour = false);

    [[nodiscard]] TouchedFrames touched(const TickRecord& tick, const MotionRequest& wanted,
                                        const TouchedFrames* before) override;
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters& parameters) override;
    [[nodiscard]] bool holds(const SurfaceRead& read, double blend) const override {
        return surface_.holds(read, blend);
    }

    /// As far as the session knows it.
    [[nodiscard]] MediaDescription description() const;

  private:
    [[nodiscard]] StoredSurface surface_of(std::int64_t pair);

    [[nodiscard]] std::shared_ptr<const ColourImage> colour_of(const Frame& frame);

    const Session& session_;
    const bool in_colour_;
    SurfaceReader reader_;
    std::string jpeg_{};  // of the picture last shown
    std::shared_ptr<const ColourImage> picture_{std::make_shared<const ColourImage>()};
    StoredSurface surface_{};  // of the last tick
    std::optional<SessionMaterials> materials_{};
};

}  // namespace dibhr
