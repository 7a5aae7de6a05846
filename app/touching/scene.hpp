// What a picture of the relief shows: the surface of now, and what the hand does.
#pragma once

#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "core/video/frames/frame_window.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// The markers are those of the last tick.
[[nodiscard]] SceneContent scene_content(const Settings& settings, const TouchState& touch,
                                         const DepthBlend& shown);

}  // namespace dibhr
