// The frames that were published to the haptic loop, kept until the recorder has stored what of
// them was felt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
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
    /// last window, which the loop holds as well. A recording begins with on.
    void keep(bool on);

    [[nodiscard]] std::optional<FeltSurface> surface_of(const TickRecord& tick) override;
    [[nodiscard]] std::vector<PixelBox> read_by_others(const TickRecord& tick,
                                                       const SessionParameters& parameters,
                                                       const BumpMap* bump) override;

  private:
    struct Felt {
        Frame frame{};          ///< without its colours and what is only drawn
        bool shown{false};      ///< in the last window
        bool was_shown{false};  ///< in the one before
    };
    struct Other {
        Algorithm algorithm{Algorithm::dibhr};
        bool slides{false};  ///< without friction
        RecordedRun run{};
    };

    void drop_unused();

    std::mutex guard_{};
    std::vector<Felt> frames_{};  // in the order in which they were published
    bool keeps_{false};
    Frame from_{}, to_{};          // of the surface last given
    std::vector<Other> others_{};  // all algorithms, and one without friction
};

}  // namespace dibhr
