// What keys do: the actions of the key table.
#pragma once

#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/keys.hpp"
#include "core/video/playing/transport.hpp"
#include "render/camera.hpp"

namespace dibhr {

/// The notice at the bottom of the picture after a key; empty where the effect is visible, or where
/// another function shows the notice.
struct Answer {
    std::string words{};
    bool place{false};  ///< show the playing position instead
};

/// Performs an action on the player or the window's state.
Answer perform(Action action, ViewerState& state, Transport& transport);

/// Closes the message, dialog, question or sheet that is in front; false: there was none.
bool close_topmost(ViewerState& state);

/// A view as text for the clipboard, and back; nothing: the text is not a view.
[[nodiscard]] std::string text_of(const Camera::View& view);
[[nodiscard]] std::optional<Camera::View> view_in(const std::string& text);

}  // namespace dibhr
