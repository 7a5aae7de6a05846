// The question which meaning of the open depth is right: when it is asked, and its small reliefs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/task_group.hpp"
#include "core/haptics/depth_image.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/sources/media.hpp"
#include "render/gl_objects.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// The question on a media that was opened; nothing where its meaning is sure, or a person stated
/// it. Looks at the disk.
[[nodiscard]] std::optional<DepthQuestion> question_on(const MediaDescription& media);

/// The frame's depth as it would be by another meaning of the same file, from 0 to 255, with at
/// most 256 columns and rows. What is beyond the range of `now` stays at its end, and what was
/// never seen is far.
[[nodiscard]] DepthImage depth_by(const Frame& frame, const DepthMeaning& now,
                                  const DepthMeaning& other);

/// Takes a number key while asks_depth() is true: that of an alternative, or 0, for the other files
/// of the folder.
void take_digit(int digit, ViewerState& state);

/// How far the drawn depth spreads, as the standard deviation of its nearness, 0 to 0.5. Where it
/// is large, near and far are easily distinguished.
[[nodiscard]] double spread_of(const Frame& frame);

/// Of four frames over the length of the media, the one with the largest spread, without colour;
/// nothing where none can be read. Opens the files again: not for the window's thread.
[[nodiscard]] std::optional<Frame> telling_frame(const MediaDescription& media,
                                                 DepthRequest request);

class ViewerAsking {
  public:
    /// The task group must outlive it.
    explicit ViewerAsking(TaskGroup& tasks) : searching_(tasks) {}

    /// Once a picture: draws one more of the open question's reliefs, all from one frame. That is
    /// the first one that is shown of the media of that number, until one of clearly more spread is
    /// shown, or found in the file.
    void draw_reliefs(const DepthBlend& shown, std::uint32_t media, ViewerState& state,
                      SceneView& scene);

  private:
    void offer(const Frame& frame);

    std::optional<Frame> frame_{};
    double spread_{0.0};   // of frame_
    std::size_t next_{0};  // the next relief to draw
    BackgroundTask<std::optional<Frame>> searching_;
    std::array<ColourTexture, 4> reliefs_{};
};

}  // namespace dibhr
