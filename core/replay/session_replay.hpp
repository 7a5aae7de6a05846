// A recorded session run again, tick by tick, through the same or other parameters, and how each
// run differs from the recording.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/touch.hpp"
#include "core/loop/recorded_run.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/session/felt_surface.hpp"
#include "core/session/session.hpp"
#include "core/session/tick_record.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/motion/frame_motion.hpp"

namespace dibhr {

/// The two frames that a surface blends.
struct TouchedFrames {
    Frame from{}, to{};
};

/// Gives the surfaces that a session touched. Throws InputError for one that there is not.
class RecordedSurfaces {
  public:
    virtual ~RecordedSurfaces() = default;
    /// The frames of a tick with a surface, with what is wanted between them. `before`: those of
    /// the tick before; null: none.
    [[nodiscard]] virtual TouchedFrames touched(const TickRecord& tick, const MotionRequest& wanted,
                                                const TouchedFrames* before) = 0;
    /// Null: none was laid over the surface.
    [[nodiscard]] virtual std::shared_ptr<const BumpMap> bump(
        const SessionParameters& parameters) = 0;
    /// Whether that part of the surface last given is known, at that blend of its frames.
    [[nodiscard]] virtual bool holds(const SurfaceRead& /*read*/, double /*blend*/) const {
        return true;
    }
};

/// Reads them frame by frame, all of each.
class RecordedFrames : public RecordedSurfaces {
  public:
    /// The frame at exactly this presentation time, cleaned. Throws InputError when there is none.
    [[nodiscard]] virtual Frame frame(const FrameSource& source, double media_s) = 0;
    /// Adds to `from` the motion to `to`, the next frame, as when they were touched. A frame that
    /// has its motion is left as it is.
    virtual void connect(Frame& /*from*/, const Frame& /*to*/, const MotionRequest& /*wanted*/) {}
    [[nodiscard]] TouchedFrames touched(const TickRecord& tick, const MotionRequest& wanted,
                                        const TouchedFrames* before) override;

  private:
    FramePair last_{};  // given last
};

/// Makes the parameters of a run from those recorded.
using ParameterChange = std::function<void(TouchParameters&)>;

/// When runs begin so that their proxies are in place at `from_s`: a second before it, or where the
/// hand was free last before that, as the place of a proxy in contact depends on its whole way
/// since it touched; at most ten seconds before it. [s]
[[nodiscard]] double warm_up_s(const Session& session, double from_s);

/// Several runs side by side, each with its own proxy; every frame is decoded once. With the
/// recorded parameters a run gives the recorded bits, unless ticks are missing.
class SessionReplay {
  public:
    /// A run for each change; an empty change keeps the recorded parameters. Begins with the first
    /// tick at or after `from_s`: in the middle of a session a run needs some time to reach the
    /// recorded proxy. Session and frames must outlive it.
    SessionReplay(const Session& session, RecordedSurfaces& frames,
                  std::vector<ParameterChange> changes,
                  double from_s = -std::numeric_limits<double>::infinity());

    /// Computes the next tick in all runs. False after the last one. Throws InputError for a
    /// session that cannot be read on, and the exceptions of the frames.
    [[nodiscard]] bool next();

    [[nodiscard]] const TickRecord& recorded() const noexcept { return tick_; }
    [[nodiscard]] const Touch& touch(std::size_t run) const { return runs_.at(run).run.touch(); }
    /// The run's update may have read surface that is not known: see RecordedSurfaces::holds().
    [[nodiscard]] bool left_known(std::size_t run) const { return runs_.at(run).left_known; }
    /// Null before the first tick with a surface.
    [[nodiscard]] const std::shared_ptr<const TouchedFrames>& frames() const noexcept {
        return touched_;
    }
    /// Of the last tick with a surface; null: none was laid over it.
    [[nodiscard]] const std::shared_ptr<const BumpMap>& bump() const noexcept { return bump_; }
    /// Time of the run's update; 0 without a surface.
    [[nodiscard]] double update_us(std::size_t run) const {
        return std::chrono::duration<double, std::micro>(runs_.at(run).run.update_time()).count();
    }

  private:
    struct Run {
        ParameterChange change{};
        TouchParameters parameters{};
        RecordedRun run{};
        bool left_known{false};
    };

    void take_parameters();
    void take_frames();
    void run_tick(Run& run);
    [[noreturn]] void refuse_tick(const std::string& before, const std::string& after) const;

    const Session& session_;
    RecordedSurfaces& frames_;
    Session::Ticks ticks_;
    TickRecord tick_{};
    std::vector<Run> runs_{};
    const SessionParameters* parameters_{nullptr};  ///< of the tick
    std::shared_ptr<const BumpMap> bump_{};
    FramePair pair_{};
    std::int64_t pair_number_{0};
    std::shared_ptr<const TouchedFrames> touched_{};  ///< of the pair
};

/// Whether an update gave what was recorded, bit by bit.
[[nodiscard]] bool same_bits(const Touch& touch, const TickRecord& recorded) noexcept;

/// Any number of samples: beyond 65,536, only every second, fourth, ... is kept for quantiles.
class Samples {
  public:
    void add(double value);
    /// Count, mean and highest are of all samples.
    [[nodiscard]] SampleStatistics statistics() const;
    [[nodiscard]] double sd() const noexcept { return spread_.sd(); }

  private:
    std::vector<double> kept_{};
    std::size_t stride_{1};
    Spread spread_{};
    double highest_{0.0};
};

/// One run compared with the recording. Ticks without a surface count only for the bits and the
/// share of ticks in contact.
class RunComparison {
  public:
    /// `left_known`: see SessionReplay.
    void add(const TickRecord& recorded, const Touch& touch, double update_us,
             bool left_known = false);

    /// The update in which the run first gave other bits than recorded.
    struct Difference {
        TickRecord recorded{};
        Touch touch{};
    };
    [[nodiscard]] const std::optional<Difference>& first_difference() const noexcept {
        return first_difference_;
    }
    [[nodiscard]] std::int64_t differing() const noexcept { return differing_; }

    /// Ticks that updated, and those of them that ended before the proxy had caught up.
    [[nodiscard]] std::size_t updates() const noexcept { return updates_; }
    [[nodiscard]] std::size_t bounds_met() const noexcept { return bounds_met_; }

    /// Updates that may have read surface that is not known.
    [[nodiscard]] std::size_t left_known() const noexcept { return left_known_; }

    /// What the line below says, but for the time that it took, by name with unit.
    [[nodiscard]] std::vector<std::pair<std::string, double>> numbers() const;
    /// A line of the table under `comparison_heading()`.
    [[nodiscard]] std::string table_row(const std::string& name) const;

  private:
    [[nodiscard]] double contact_share() const noexcept;

    std::int64_t ticks_{0};
    std::size_t updates_{0};
    std::size_t bounds_met_{0};
    std::size_t left_known_{0};
    std::int64_t in_contact_{0};
    std::int64_t differing_{0};
    std::optional<Difference> first_difference_{};
    std::optional<Vec3> last_lag_{};  ///< goal to proxy in the update before, if in contact
    Samples time_us_{};
    Samples turn_deg_{};    ///< of the force from update to update, as in the paper
    Samples off_px_{};      ///< proxy from the recorded one
    Samples astray_deg_{};  ///< force from the recorded one, both in contact
};

[[nodiscard]] std::string comparison_heading();

}  // namespace dibhr
