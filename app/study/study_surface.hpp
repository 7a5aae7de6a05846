// The surface that a participant touches: an interval's surface, force on or off, one recording a
// trial.
#pragma once

#include <chrono>
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

/// For the window's thread. An interval uses its values and defaults, as the command line would. Of
/// the user's settings only device, force limit and loudness are used.
class StudySurface {
  public:
    StudySurface(HandDevice hand, const Settings& settings, const TouchConnections& connections);

    /// Records the trial's ticks into that file, from the next interval on.
    void begin_trial(const std::filesystem::path& file);
    /// Loads the interval's surface, from the media's first frame, with the force off. Throws
    /// InputError for media that cannot be opened.
    void show(const Protocol& protocol, const StudyInterval& interval);
    /// Whether the first frame can be touched and seen, and the recording has begun.
    [[nodiscard]] bool is_ready() const;
    /// Begins the interval: the force rises from zero. `number`: of the interval, from 1.
    void begin_interval(int number);
    /// Takes the force off. Where it was on, the session gets the mark "rest".
    void take_force_off();
    /// Changes one parameter of the interval.
    void turn(const std::string& parameter, double value);
    /// Ends the recording. Throws InputError when it could not be written.
    void end_trial();

    /// Once a picture: polls the session and the recording. Throws InputError when one of them
    /// failed.
    void poll(bool window_in_front);
    /// Once a picture, after all changes: publishes to the next tick.
    void publish();
    /// The presses since the last call; *force off* is done here and left out.
    [[nodiscard]] std::vector<DeviceButtonPress> take_presses();
    [[nodiscard]] bool is_down(int button) const noexcept {
        return (touch_.haptic.hand.buttons >> button & 1) != 0;
    }
    /// Moves the virtual hand to where the mouse points.
    void point(const Camera::Ray& ray, const PointerUse& use) {
        session_.point(ray, shown_, use, std::chrono::steady_clock::now());
    }

    [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
    [[nodiscard]] const TouchState& touch() const noexcept { return touch_; }
    [[nodiscard]] const MediaState& media() const noexcept { return media_; }
    [[nodiscard]] const DepthBlend& shown() const noexcept { return shown_; }
    /// Whether the mouse is the hand: no device touches.
    [[nodiscard]] bool by_mouse() const noexcept { return session_.by_mouse(); }

    /// Ends the haptic loop for good.
    void stop() noexcept { session_.stop(); }

  private:
    void apply_values(const TouchValues& values);
    void open(const Protocol& protocol, const std::string& media);
    void record_if_possible();

    Settings own_;       // the user's
    Settings settings_;  // of the interval
    TouchState touch_{.force_enabled = false};
    MediaState media_{};
    std::string media_name_{};            // of the open media
    std::filesystem::path trial_file_{};  // until the trial's recording begins; else empty
    bool rest_mark_due_{false};           // the mark "rest" is due after the next publish()
    DepthBlend shown_{};
    TouchSession session_;  // last member: destroyed first
};

}  // namespace dibhr
