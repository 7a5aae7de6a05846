// What a picture of the relief shows: the surface of now, and what the hand does.
#pragma once

#include "app/panels/viewer_state.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// The markers are those of the last tick.
[[nodiscard]] SceneContent scene_content(const ViewerState& state, const DepthBlend& shown);

}  // namespace dibhr
