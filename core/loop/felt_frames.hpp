// The frames that were published to the haptic loop, kept until the recorder has stored what of
// them was felt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/loop/recorded_run.hpp"
#include "core/session/felt_surface.hpp"
#include "core/session/tick_record.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Every method may be called from any thread but the haptic one: each waits for the others, for
/// microseconds.
class FeltFrames final : public FeltSurfaces {
  public:
    /// Frames that are published to the loop: to be called before they are.
    void add(const FrameWindow& window);

    /// While on, frames are kept until a tick of later ones is asked for; else only those of the
    /// last window, which the loop holds as well. A recording begins with on. `pictures`: of each
    /// second of a video preview() gives one, unless it cannot be encoded.
    void keep(bool on, bool pictures = false);

    [[nodiscard]] std::optional<FeltSurface> surface_of(const TickRecord& tick) override;
    [[nodiscard]] std::string preview() override;
    [[nodiscard]] std::vector<SurfaceRead> read_by_others(const TickRecord& tick,
                                                          const SessionParameters& parameters,
                                                          const BumpMap* bump) override;

  private:
    struct Felt {
        Frame frame{};          ///< without what is only drawn; see `pictured`
        bool shown{false};      ///< in the last window
        bool was_shown{false};  ///< in the one before
        bool pictured{false};   ///< keeps its colour, also when it is not shown any more
    };
    struct Other {
        std::optional<Algorithm> algorithm{};  ///< nothing: the recorded ones, one after the other
        bool slides{false};                    ///< without friction
        RecordedRun run{};
    };

    /// A second of a video, by the video's number.
    using Second = std::pair<std::uint32_t, std::int64_t>;

    [[nodiscard]] static Second second_of(const Frame& frame) noexcept;
    void drop_unused();

    std::mutex guard_{};
    std::vector<Felt> frames_{};  // in the order in which they were published
    bool keeps_{false};
    bool pictures_{false};
    std::optional<Second> last_kept_{};  // of which a frame keeps its colour
    std::set<Second> pictured_{};        // of which a picture was given
    Frame from_{}, to_{};                // of the surface last given
    std::vector<Other> others_{};        // as recorded, all algorithms, and without friction
};

}  // namespace dibhr
