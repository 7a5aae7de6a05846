// An update in slow motion: from where the proxy was when it was asked for to where the hand is.
#pragma once

#include <optional>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/input.hpp"
#include "core/haptics/proxy.hpp"
#include "core/replay/session_player.hpp"
#include "core/video/frame_window.hpp"
#include "render/camera.hpp"

namespace dibhr {

/// Nothing of it is felt. Of a hand's update the goal is where the hand pressed last, until the
/// first step is taken; of a replay's, that of the tick after the one that was shown.
class ViewerExplaining {
  public:
    /// The key that begins and ends it, and the keys that step meanwhile; nothing when the action
    /// is none of them. `replay` null: a hand touches.
    std::optional<Answer> perform(Action action, ViewerState& state, Player& player,
                                  SessionPlayer* replay);

    /// Once a picture: the update over the surface of now. The camera goes where it is, and back at
    /// its end.
    void advance(const DepthBlend& shown, ViewerState& state, Camera& camera, double now_s);

  private:
    void begin(ViewerState& state, Player& player);
    void take_next_tick(ViewerState& state, SessionPlayer& replay);
    void step_on(ExplainedNews& news, SessionPlayer* replay, ViewerState& state);
    void follow_hand(const ViewerState& state);
    void run(ExplainedNews& news, double now_s);
    void move_camera(const ExplainedNews& news, Camera& camera);

    Proxy proxy_{};                    // before the update
    Vec3 goal_{0.0};                   // of the update
    bool pressed_{false};              // that goal was on or under the surface
    int columns_{0}, rows_{0};         // of the surface it began on
    std::optional<Camera> before_{};   // to go back to
    std::optional<bool> seen_held_{};  // of the update that the camera shows
    std::int64_t seen_tick_{-1};
    double next_step_s_{0.0};
};

}  // namespace dibhr
