// Replay of a session in the window, as recorded or computed with other parameters.
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
    /// Begins to play. The parameters in `given` replace the recorded ones from the start.
    void begin(std::unique_ptr<OpenedSession> opened, const GivenParameters& given,
               ViewerState& state);
    /// Ends the replay, and restores the settings of before.
    void end(ViewerState& state);
    /// Null: no replay.
    [[nodiscard]] SessionPlayer* player() const { return player_.get(); }

    /// Once a turn, before the panels: puts the moment that is due into `state`.
    void advance(ViewerState& state, SessionPlayer::Time now);
    /// After the panels: computes with other parameters if the user has changed them.
    void follow_panels(const ViewerState& state);
    /// Shows the recorded parameters again.
    void restore_recorded(ViewerState& state);

    /// The frames of the shown moment.
    [[nodiscard]] DepthBlend shown() const;

    /// The settings to save: without the values that only show the recording.
    [[nodiscard]] Settings settings_to_save(const ViewerState& state) const;

  private:
    void show(const SessionMoment& moment, ViewerState& state);

    std::unique_ptr<SessionPlayer> player_{};
    std::unique_ptr<ContactBandReader> outline_{};
    TouchParameters recorded_{};               // of the shown moment
    std::optional<TouchParameters> chosen_{};  // instead of them
    Touch passed_{};                           // of the last tick that was played
    std::int64_t passed_tick_{-1};

    // Values before the replay, for end().
    TouchParameters touch_{};
    CleaningOptions cleaning_{};
    InBetweens in_betweens_{};
    std::shared_ptr<const BumpMap> bump_{};
    std::filesystem::path bump_file_{};
};

}  // namespace dibhr
