// Content of a picture of the relief: the current surface, and the markers of the hand.
#pragma once

#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "core/video/frames/frame_window.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// The markers show the last tick that is known.
[[nodiscard]] SceneContent scene_content(const Settings& settings, const TouchState& touch,
                                         const DepthBlend& shown);

}  // namespace dibhr
