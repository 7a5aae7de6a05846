// What keys do: the actions of the key table.
#pragma once

#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/keys.hpp"
#include "core/video/playing/transport.hpp"
#include "render/camera.hpp"

namespace dibhr {

/// What a person reads at the bottom of the picture after a key: nothing where what happens is
/// seen, or told by who does it.
struct Answer {
    std::string words{};
    bool place{false};  ///< instead: where playing is then
};

/// What an action does, to what plays or to the window.
Answer perform(Action action, ViewerState& state, Transport& transport);

/// A view as text for the clipboard, and back; nothing: that text is no view.
[[nodiscard]] std::string text_of(const Camera::View& view);
[[nodiscard]] std::optional<Camera::View> view_in(const std::string& text);

}  // namespace dibhr
