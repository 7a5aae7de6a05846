// A recorded session run again, tick by tick, through the same or other parameters.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/touch.hpp"
#include "core/session/session.hpp"

namespace dibhr {

/// Gives what a session touched.
class RecordedFrames {
  public:
    virtual ~RecordedFrames() = default;
    /// The depth at exactly this presentation time, cleaned. Throws InputError when there is none.
    [[nodiscard]] virtual std::shared_ptr<const DepthImage> depth(const FrameSource& source,
                                                                  double media_s) = 0;
    /// Null: none was laid over the surface. Throws InputError.
    [[nodiscard]] virtual const BumpMap* bump(const SessionParameters& parameters) = 0;
};

/// Makes the parameters of a run from those recorded.
using ParameterChange = std::function<void(TouchParameters&)>;

/// Several runs side by side, each with its own proxy: every frame is decoded once. With the
/// parameters as recorded a run gives the recorded bits, unless ticks are missing.
class SessionReplay {
  public:
    /// A run for each change; an empty one leaves the parameters as they were. Begins with the
    /// first tick at or after `from_s`: in the midst of a session a run needs a moment to come to
    /// where the recording was. Session and frames must outlive it.
    SessionReplay(const Session& session, RecordedFrames& frames,
                  std::vector<ParameterChange> changes,
                  double from_s = -std::numeric_limits<double>::infinity());

    /// The next tick, through all runs. False after the last one. Throws InputError for a session
    /// that cannot be read on, and what the frames throw.
    [[nodiscard]] bool next();

    [[nodiscard]] const TickRecord& recorded() const noexcept { return tick_; }
    [[nodiscard]] const Touch& touch(std::size_t run) const { return runs_.at(run).touch; }
    /// Time of the run's update; 0 without a surface.
    [[nodiscard]] double update_us(std::size_t run) const { return runs_.at(run).update_us; }

  private:
    struct Run {
        ParameterChange change{};
        TouchParameters parameters{};
        TouchRenderer renderer{};
        Touch touch{};
        bool holds{
            false};  ///< the renderer's proxy is in contact, whether there is a surface or not
        double update_us{0.0};
    };

    void take_parameters();
    void take_frames();
    void update(Run& run);

    const Session& session_;
    RecordedFrames& frames_;
    Session::Ticks ticks_;
    TickRecord tick_{};
    std::vector<Run> runs_{};
    const SessionParameters* parameters_{nullptr};  ///< of the tick
    const BumpMap* bump_{nullptr};
    FramePair pair_{};
    std::shared_ptr<const DepthImage> from_{}, to_{};  ///< of the pair
};

/// Whether an update gave what was recorded, bit by bit.
[[nodiscard]] bool same_bits(const Touch& touch, const TickRecord& recorded) noexcept;

}  // namespace dibhr
