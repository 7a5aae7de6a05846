// The scene of one picture from the viewer's state, and the facts of a session.
#pragma once

#include <map>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "core/video/frame_window.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// What to draw now. The markers are those of the last tick; the colour is that of the `from`
/// frame.
[[nodiscard]] SceneContent scene_content(const ViewerState& state, const DepthBlend& shown);

/// What is kept with a recording: versions of program and libraries, files, parameters,
/// device.
[[nodiscard]] std::map<std::string, std::string> session_facts(const ViewerState& state);

}  // namespace dibhr
