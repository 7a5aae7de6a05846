// A session in the window: what it felt, in place of a hand, and what other parameters would have
// given.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "app/panels/viewer_state.hpp"
#include "app/settings/command_options.hpp"
#include "core/replay/session_player.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

class ViewerReplay {
  public:
    /// Begins to play. `given` beats what was recorded from the start.
    void begin(std::unique_ptr<OpenedSession> opened, const GivenParameters& given,
               ViewerState& state);
    /// Gives back the settings of before.
    void end(ViewerState& state);
    /// Null: nothing is replayed.
    [[nodiscard]] SessionPlayer* player() const { return player_.get(); }

    /// Once a picture, before the panels: the moment that is due then, into `state`.
    void advance(ViewerState& state, SessionPlayer::Time now);
    /// After the panels: whether a person chose other parameters.
    void follow_panels(const ViewerState& state);
    /// Those of the recording again.
    void put_back(ViewerState& state);

    /// The frames of the moment that is shown.
    [[nodiscard]] DepthBlend shown() const;

    /// What is to last of the window's settings: not those that show the recording.
    [[nodiscard]] Settings lasting(const ViewerState& state) const;

  private:
    void show(const SessionMoment& moment, ViewerState& state);

    std::unique_ptr<SessionPlayer> player_{};
    std::unique_ptr<SessionOutline> outline_{};
    TouchParameters recorded_{};               // of the moment shown
    std::optional<TouchParameters> chosen_{};  // instead of them
    Touch passed_{};                           // in the last tick that was passed
    std::int64_t passed_tick_{-1};

    // Of before.
    TouchParameters touch_{};
    CleaningOptions cleaning_{};
    InBetweens in_betweens_{};
    std::shared_ptr<const BumpMap> bump_{};
    std::filesystem::path bump_file_{};
};

}  // namespace dibhr
