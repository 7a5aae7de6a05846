// Goals that touch a depth video on a time of their own, without a clock: `dibhr touch` and clips.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "core/haptics/parameters.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/touch.hpp"
#include "core/loop/tick_runner.hpp"
#include "core/video/playing/depth_timeline.hpp"

namespace dibhr {

class GoalRun {
  public:
    /// `bump`: laid over the surface; null: none.
    GoalRun(std::unique_ptr<DepthTimeline> depth, const TouchParameters& parameters,
            std::shared_ptr<const BumpMap> bump);

    /// Touches the surface of that time, which must not decrease from call to call, not even to
    /// advance_to(). Throws InputError when the video breaks off.
    const Touch& update(double t_s, Vec3 goal);
    /// Shows the surface of that time; the next update gives the same bits as without this call.
    void advance_to(double t_s);

    /// Of the last call; valid until the next one.
    [[nodiscard]] DepthBlend frames() const noexcept { return depth_->now(); }
    [[nodiscard]] const std::shared_ptr<const BumpMap>& bump() const noexcept { return bump_; }
    /// See DepthTimeline.
    [[nodiscard]] const std::string& trouble() const { return depth_->trouble(); }
    /// How long the last update took.
    [[nodiscard]] std::chrono::nanoseconds update_time() const noexcept {
        return runner_.update_time();
    }

  private:
    TouchParameters parameters_;
    std::unique_ptr<DepthTimeline> depth_;
    std::shared_ptr<const BumpMap> bump_;
    TickRunner runner_{};
    std::optional<double> last_t_s_{};  // of the last update
    bool started_again_{false};         // the video did, since the last update
};

}  // namespace dibhr
