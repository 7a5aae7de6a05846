// What keys do: the actions of the key table.
#pragma once

#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/keys.hpp"
#include "core/replay/session_player.hpp"
#include "render/camera.hpp"

namespace dibhr {

/// What a person reads at the bottom of the picture after a key: nothing where what happens is
/// seen, or told by who does it.
struct Answer {
    std::string words{};
    bool place{false};  ///< instead: where playing is then
};

/// What an action does, to a video or to the window.
Answer perform(Action action, ViewerState& state, Player& player);

/// What moves a replay, and nothing else; nothing when the action is not about that.
std::optional<Answer> perform_in_replay(Action action, SessionPlayer& replay, const KeyTable& keys);

/// A view as text for the clipboard, and back; nothing: that text is no view.
[[nodiscard]] std::string text_of(const Camera::View& view);
[[nodiscard]] std::optional<Camera::View> view_in(const std::string& text);

}  // namespace dibhr
