// What a participant touches: the surface of an interval, its force on or off, recorded trial by
// trial.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/settings/settings.hpp"
#include "app/touching/touch_session.hpp"
#include "app/touching/touch_state.hpp"
#include "core/study/protocol.hpp"
#include "core/study/trial.hpp"
#include "device/hand_device.hpp"

namespace dibhr {

/// The window thread's. What is felt is what the command line would make of the values: nothing of
/// a person's own settings but those of the device, the limit of force and the sound's loudness.
class StudySurface {
  public:
    StudySurface(HandDevice hand, const Settings& settings, const TouchTies& ties);

    /// A trial's ticks go into that file, from the next interval on.
    void begin_trial(const std::filesystem::path& file);
    /// Puts the interval's surface there, from the media's first frame, without force. Throws
    /// InputError for media that cannot be opened.
    void show(const Protocol& protocol, const StudyInterval& interval);
    /// Its first frame can be touched and seen, and is recorded.
    [[nodiscard]] bool is_there() const;
    /// From here on it is felt: the force rises from zero. `number`: of the interval, from 1.
    void begin_interval(int number);
    /// The force goes to zero; the session has the mark "rest" where it was on.
    void rest();
    /// Turns one parameter of what is felt.
    void turn(const std::string& parameter, double value);
    /// Ends the session, whole. Throws InputError when it could not be written.
    void end_trial();

    /// Once a picture: what the hand and the recorder did. Throws InputError when the recording
    /// broke off.
    void poll(bool window_in_front);
    /// Once a picture, after all that was changed: to the next tick.
    void publish();
    /// Those since the last call, but for what takes the force off, which is done here.
    [[nodiscard]] std::vector<GripPress> take_presses();
    [[nodiscard]] bool is_down(int button) const noexcept {
        return (touch_.haptic.hand.buttons >> button & 1) != 0;
    }
    /// Where the mouse points, for the virtual hand.
    void point(const Camera::Ray& ray, const PointerUse& use) { session_.point(ray, shown_, use); }

    [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
    [[nodiscard]] const TouchState& touch() const noexcept { return touch_; }
    [[nodiscard]] const MediaState& media() const noexcept { return media_; }
    [[nodiscard]] const DepthBlend& shown() const noexcept { return shown_; }
    /// Whether the mouse is all that touches now.
    [[nodiscard]] bool by_mouse() const noexcept { return session_.by_mouse(); }

    /// Sends no force any more. Nothing is to be shown after it.
    void stop() noexcept { session_.stop(); }

  private:
    void wear(const TouchValues& values);
    void open(const Protocol& protocol, const std::string& media);
    void record_if_possible();

    Settings own_;       // a person's
    Settings settings_;  // of the interval
    TouchState touch_{.force_enabled = false};
    MediaState media_{};
    std::string media_name_{};            // of what is open
    std::filesystem::path trial_file_{};  // of a trial whose recording has not begun
    bool rests_{false};                   // from the next publish() on, to be marked
    DepthBlend shown_{};
    TouchSession session_;  // last: it goes first
};

}  // namespace dibhr
