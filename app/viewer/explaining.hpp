// An update of the algorithm in slow motion, from the proxy's place at the key press to the goal.
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

/// The explained update renders no force. With a hand, its goal is where the hand pressed last,
/// until the first step; in a replay, the goal of the tick after the shown one.
class ViewerExplaining {
  public:
    /// Handles the key that begins and ends the explanation, and the keys that step through it.
    /// Nothing: the action is none of them. `replay` null: a hand touches.
    std::optional<Answer> perform(Action action, ViewerState& state, Player& player,
                                  SessionPlayer* replay);

    /// Once a picture: explains the update over the current surface, with the camera near it. Ends,
    /// with the camera moved back, when a replay moves on or the surface's size changes.
    void advance(const DepthBlend& shown, ViewerState& state, Camera& camera, double now_s);
    /// Ends the explanation, as other files are shown.
    void end(ViewerState& state, Camera& camera);
    /// The user chose the view: do not move the camera back at the end.
    void keep_camera() { before_.reset(); }

  private:
    /// All that an update depends on. Owns the images, so that a new one never has their address.
    struct UpdateInput {
        std::shared_ptr<const DepthImage> from{}, to{};
        double blend{0.0};
        SurfaceShape shape{};
        std::shared_ptr<const BumpMap> bump{};
        Proxy proxy{};
        Vec3 goal{0.0};
        Friction friction{};

        bool operator==(const UpdateInput&) const = default;
    };

    void begin(ViewerState& state, Player& player);
    void take_next_tick(ViewerState& state, SessionPlayer& replay);
    Answer step_on(ExplainedInfo& info, SessionPlayer* replay, ViewerState& state);
    [[nodiscard]] bool is_outdated(const DepthBlend& shown, const ViewerState& state) const;
    void explain_if_changed(const DepthBlend& shown, ViewerState& state);
    void follow_hand(const ViewerState& state);
    void run(ExplainedInfo& info, double now_s);
    void move_camera(const ExplainedInfo& info, Camera& camera);

    Proxy proxy_{};                       // before the update
    Vec3 goal_{0.0};                      // of the update
    bool pressed_{false};                 // goal_ was on or under the surface
    std::int64_t left_tick_{-1};          // in a replay: the tick before the update
    std::int64_t tick_{-1};               // and the update's tick; -1: still being read
    int columns_{0}, rows_{0};            // of the surface at begin()
    std::optional<Camera> before_{};      // view to go back to
    std::optional<UpdateInput> input_{};  // input of the shown update
    std::optional<bool> seen_held_{};     // state of the update that the camera shows
    std::int64_t seen_tick_{-1};
    double next_step_s_{0.0};
};

}  // namespace dibhr
