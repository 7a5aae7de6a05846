// Decides whether the window's next picture would differ from the last one.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "render/scene_mark.hpp"

namespace dibhr {

/// What a picture of the window is drawn of: pictures with equal marks look the same.
struct PictureMark {
    SceneMark scene{};
    std::size_t panels{0};  ///< Gui::content()

    bool operator==(const PictureMark&) const = default;
};

/// What may change the panels in a turn of the window.
struct PanelChanges {
    bool input{false};       ///< something happened in the window
    bool in_use{false};      ///< Gui::in_use()
    bool video_runs{false};  ///< they change with each frame of a video, and wait for it
};

/// Compares what would be drawn with what was drawn. The scene is compared in each turn of the
/// window. The panels must be laid out for that, which costs more: in each turn after input and
/// while they change, else a few times a second, so that no panel need say that it changed.
class PictureChange {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Of a video that runs: the hand and the colour of the last picture, while that is young. What
    /// changes in them alone waits for the next frame, but not for one that comes much later.
    [[nodiscard]] SceneMark with_drawn_hand(SceneMark scene, Time now) const;

    /// Whether the next picture is due only later, where at most so many are drawn a second; 0: as
    /// many as differ. What a person does in the window does not wait.
    [[nodiscard]] bool waits(double most_per_s, const PanelChanges& panels, Time now) const;

    /// Whether the panels are to be laid out for take().
    [[nodiscard]] bool may_differ(const SceneMark& scene, const PanelChanges& panels, Time now);

    /// Whether the picture differs. If so, it counts as drawn.
    [[nodiscard]] bool take(const PictureMark& next, Time now);

    /// The longest time to the next turn after one that drew nothing. `by_device`: a device may
    /// move the hand; the mouse wakes the window.
    [[nodiscard]] std::chrono::milliseconds pause(bool by_device, Time now) const;

    /// The last picture is not on the screen any more.
    void forget() { drawn_.reset(); }

  private:
    std::optional<PictureMark> drawn_{};
    Time drawn_at_{};
    Time laid_out_{};        // when the panels were last
    Time input_until_{};     // the panels may change by the last input
    Time settling_until_{};  // the panels may change by themselves
};

}  // namespace dibhr
