// What lies over the frames of a session: bump maps and touch maps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/touch_maps.hpp"
#include "core/session/session.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

/// The size of the depth images [px].
struct SurfaceSize {
    int columns{0}, rows{0};
};

/// One thread at a time.
class SessionMaterials {
  public:
    /// Reads a recorded bump map. May throw InputError.
    using ReadBump = std::function<std::shared_ptr<const BumpMap>(const SessionMedia&)>;

    struct Options {
        std::filesystem::path bump{};  ///< instead of the recorded ones; empty: those
        double bump_size_px{0.0};      ///< of that one; SurfaceShape::bump_size_px
        bool maps{true};               ///< false: without the recorded touch maps
    };

    /// Throws InputError for one that cannot be read. `session` must outlive it. `size`: of the
    /// first video's images; mostly there is no other, and one of another size works as well.
    SessionMaterials(const Session& session, const Options& options, SurfaceSize size,
                     const ReadBump& read);

    /// Null: none was laid over the surface.
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters& parameters);
    /// Null: the source has no touch maps.
    [[nodiscard]] std::shared_ptr<const TouchMaps> maps_of(const FrameSource& source,
                                                           SurfaceSize size);

  private:
    void read_bumps(const Options& options, const ReadBump& read);
    void read_maps();

    const Session& session_;
    const SurfaceSize size_;
    std::map<std::filesystem::path, std::shared_ptr<const BumpMap>> bumps_{};  // by recorded names
    std::shared_ptr<const BumpMap> other_bump_{};
    std::map<std::uint32_t, std::vector<SessionMap>> maps_{};  // by their versions
    std::shared_ptr<const TouchMaps> decoded_maps_{};          // the last ones read
};

}  // namespace dibhr
