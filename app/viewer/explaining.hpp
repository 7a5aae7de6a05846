// An update in slow motion: from where the proxy was when it was asked for to where the hand is.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/input.hpp"
#include "core/haptics/proxy.hpp"
#include "core/replay/session_player.hpp"
#include "core/video/frames/frame_window.hpp"
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
    /// its end, which is also when a replay moves on or there is a surface of another size.
    void advance(const DepthBlend& shown, ViewerState& state, Camera& camera, double now_s);
    /// Other files are shown.
    void end(ViewerState& state, Camera& camera);
    /// A person chose where to look from: that stays.
    void leave_camera() { before_.reset(); }

  private:
    /// All that an update depends on. The images are held: another one never has their address.
    struct Asked {
        std::shared_ptr<const DepthImage> from{}, to{};
        double blend{0.0};
        SurfaceShape shape{};
        std::shared_ptr<const BumpMap> bump{};
        Proxy proxy{};
        Vec3 goal{0.0};
        Friction friction{};

        bool operator==(const Asked&) const = default;
    };

    void begin(ViewerState& state, Player& player);
    void take_next_tick(ViewerState& state, SessionPlayer& replay);
    Answer step_on(ExplainedNews& news, SessionPlayer* replay, ViewerState& state);
    [[nodiscard]] bool has_gone(const DepthBlend& shown, const ViewerState& state) const;
    void explain_anew(const DepthBlend& shown, ViewerState& state);
    void follow_hand(const ViewerState& state);
    void run(ExplainedNews& news, double now_s);
    void move_camera(const ExplainedNews& news, Camera& camera);

    Proxy proxy_{};                    // before the update
    Vec3 goal_{0.0};                   // of the update
    bool pressed_{false};              // that goal was on or under the surface
    std::int64_t left_tick_{-1};       // of a replay: the tick before the update
    std::int64_t tick_{-1};            // and its own; -1: it is still being read
    int columns_{0}, rows_{0};         // of the surface it began on
    std::optional<Camera> before_{};   // to go back to
    std::optional<Asked> asked_{};     // of the update that is shown
    std::optional<bool> seen_held_{};  // of the update that the camera shows
    std::int64_t seen_tick_{-1};
    double next_step_s_{0.0};
};

}  // namespace dibhr
