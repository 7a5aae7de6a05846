// Pictures of a recording or a session on simulated time, for a clip that is drawn off line: each
// takes as long as it takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/command_options.hpp"
#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "app/viewer/trace.hpp"
#include "app/window/window.hpp"
#include "core/loop/goal_run.hpp"
#include "core/replay/session_player.hpp"
#include "device/goal_stream.hpp"
#include "render/camera.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// What moves in a clip. Its time begins at 0 s.
class ClipMotion {
  public:
    virtual ~ClipMotion() = default;
    /// Computes all ticks until that time, which must not decrease. Throws InputError.
    virtual void advance_to(double t_s) = 0;
    /// The surface of that time; valid until the next call.
    [[nodiscard]] virtual DepthBlend shown() const = 0;

    /// A sentence for people on what could not be read as it should; empty: nothing.
    [[nodiscard]] virtual std::string trouble() const { return {}; }

    /// The last tick, and the parameters that it was computed with.
    [[nodiscard]] const TouchState& touch() const noexcept { return touch_; }
    [[nodiscard]] const TouchParameters& parameters() const noexcept { return parameters_; }
    [[nodiscard]] double max_force_newton() const noexcept { return max_force_newton_; }

  protected:
    /// Stores the tick for the markers.
    void take(const Touch& touch);

    TouchState touch_{};
    TouchParameters parameters_{};
    double max_force_newton_{SafetyLimits{}.max_force_newton};
};

/// A video, touched by goals: the updates are those of `dibhr touch --video`. Both repeat.
class GoalMotion final : public ClipMotion {
  public:
    /// No goals: nobody touches.
    GoalMotion(std::unique_ptr<DepthTimeline> depth, const TouchParameters& parameters,
               std::shared_ptr<const BumpMap> bump, std::vector<TimedGoal> goals);

    void advance_to(double t_s) override;
    [[nodiscard]] DepthBlend shown() const override { return run_.frames(); }
    [[nodiscard]] std::string trouble() const override { return run_.trouble(); }
    /// When all goals were touched once; 0 without goals.
    [[nodiscard]] double goals_end_s() const noexcept;

  private:
    [[nodiscard]] double lap_s() const noexcept;

    GoalRun run_;
    std::vector<TimedGoal> goals_;
    std::size_t next_{0};
    double lap_begin_s_{0.0};
};

/// A session, whose hand moves as recorded. Time 0 is its first tick.
class SessionMotion final : public ClipMotion {
  public:
    /// `given` replaces recorded parameters. Nothing before `from_s` is shown. In the middle of a
    /// session, ticks are computed from before it, as in the window: see warm_up_s().
    SessionMotion(std::unique_ptr<OpenedSession> opened, const GivenParameters& given,
                  double from_s);

    void advance_to(double t_s) override;
    [[nodiscard]] DepthBlend shown() const override;
    [[nodiscard]] double duration_s() const noexcept;
    [[nodiscard]] const MediaDescription& description() const noexcept {
        return opened_->frames.description;
    }

  private:
    void take_tick();

    std::unique_ptr<OpenedSession> opened_;
    GivenParameters given_;
    SessionReplay replay_;
    bool waits_{false};  // the replay's tick is later than what is shown
    std::shared_ptr<const TouchedFrames> frames_{};
    double blend_{0.0};
    std::optional<std::uint64_t> version_{};  // of the parameters
};

/// How the pictures look.
struct ClipLook {
    glm::ivec2 size_px{1280, 800};
    Theme theme{Theme::dark};
    bool straight{false};
    std::optional<Camera::View> view{};  ///< nothing: the whole relief
    SurfaceLook surface{};               ///< of the material
};

/// Draws what the window shows, without panels, in a hidden window.
class ClipPainter {
  public:
    /// For a depth image of that size. Throws DeviceError without a display or OpenGL 3.3.
    ClipPainter(const ClipLook& look, int columns, int rows, double relief_px);

    /// `shown_s`: time of the picture in the clip, which must not decrease. Throws DeviceError.
    [[nodiscard]] ColourImage picture(const ClipMotion& motion, double shown_s);

  private:
    glm::ivec2 size_px_;
    SurfaceLook surface_;
    Settings settings_{};
    Window window_;
    SceneView scene_{};
    Camera camera_{};
    TouchTrace trace_{};
};

}  // namespace dibhr
