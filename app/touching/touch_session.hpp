// Touching: device, player, haptic loop, recorder, sound, game pads, and what is published to the
// next tick. Each window has one TouchSession. See README.md.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sound/pad_output.hpp"
#include "app/sound/sound_output.hpp"
#include "app/sound/touch_source.hpp"
#include "app/touching/device_client.hpp"
#include "app/touching/pointer.hpp"
#include "app/touching/recording.hpp"
#include "app/touching/touch_state.hpp"
#include "app/window/crash_note.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/loop/other_proxies.hpp"
#include "core/realtime/heartbeat.hpp"
#include "core/realtime/tick_timer.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "device/hand_device.hpp"

namespace dibhr {

/// What a session uses of its window and program; all must outlive the session.
struct TouchConnections {
    const Heartbeat& window;
    const std::atomic<bool>& without_force;
    CrashNote& crash_note;
    /// Called on another thread whenever the player has published frames; null: by nobody.
    std::function<void()> on_frames{};
};

/// Cleaning of the settings; raw while the key *Depth as recorded* is held.
[[nodiscard]] CleaningOptions wanted_cleaning(const Settings& settings, const MediaState& media);

/// For the window's thread only. Force is sent only between start() and stop().
class TouchSession {
  public:
    /// `state` belongs to the window and must outlive the session.
    TouchSession(HandDevice hand, const TouchConnections& connections, const TouchStateRefs& state);

    // Once a turn of the window, in this order, with TouchRecording::poll() after take_presses().

    /// Copies the newest state of loop and devices into the window's state. Returns notices to show
    /// to the user.
    [[nodiscard]] std::vector<std::string> poll(bool window_in_front);
    /// The presses of device buttons since the last call.
    [[nodiscard]] std::vector<DeviceButtonPress> take_presses();
    /// Publishes all changes of this turn: to the next tick, the devices, player and outputs.
    void publish();

    /// Publishes, and starts the loop. Does nothing while the loop runs.
    void start();
    /// Sends zero force and ends the loop. Returns the loop's timing; nothing when none ran.
    std::optional<TickSchedule> stop() noexcept;
    [[nodiscard]] bool runs() const noexcept { return loop_ != nullptr; }
    /// Stops, and closes the device for good.
    void close_device();

    /// Plays `media` from its first frame, and puts its description into the state.
    void play(std::unique_ptr<Media> media, std::shared_ptr<const TouchMaps> maps = nullptr);
    /// The number that the frames of the current media, and ticks over them, carry.
    [[nodiscard]] std::uint32_t media_number() const noexcept { return media_number_; }
    /// The frames of this moment: the same that the ticks touch.
    [[nodiscard]] DepthBlend frames_now();

    /// Moves the virtual hand to where the mouse points. It presses only while no device touches.
    /// `at`: when it did; the ring's clicks follow from `use`.
    void point(const Camera::Ray& ray, const DepthBlend& shown, PointerUse use,
               std::chrono::steady_clock::time_point at);
    /// Whether the mouse is the hand: no device touches.
    [[nodiscard]] bool by_mouse() const noexcept;

    /// Whether the loop has seen the end of the last recording: the next gets none of its ticks.
    [[nodiscard]] bool may_record() const noexcept;

    /// Checks and stores a firmware file, and passes it to the device of that kind. Returns a
    /// notice. Throws InputError.
    std::string use_firmware(const std::filesystem::path& file);
    /// Passes the user's agreement to the device of that kind; `offer`: DeviceOffer::number.
    void agree_to(std::size_t kind, std::uint64_t offer);

    [[nodiscard]] Player& player() noexcept { return player_; }
    [[nodiscard]] const Player& player() const noexcept { return player_; }
    [[nodiscard]] TouchRecording& recording() noexcept { return recording_; }

  private:
    void follow_others();
    void update_catching_up();
    /// Once, where many ticks are late and the system refused real-time priority.
    [[nodiscard]] std::optional<std::string> priority_notice();
    void publish_to_outputs();
    void publish_to_player();

    TouchConnections connections_;
    TouchStateRefs state_;
    HandDevice hand_;
    std::vector<DeviceClient> devices_{};  // in the order of touch.devices
    HandPointer pointer_{};
    bool clicked_{false};  // the button is down, as of the last click
    std::chrono::steady_clock::time_point clicked_at_{};
    std::uint64_t clicks_{0};  // pushed to the mouse's hand
    std::uint32_t media_number_{0};
    HapticSettings published_{};
    std::uint64_t recording_ended_at_{0};  // count of the loop's ticks when the end was published
    std::uint64_t standstills_{0};         // as of the last notice
    std::uint64_t bounds_met_{0};          // as of the last picture
    bool priority_reported_{false};
    std::chrono::steady_clock::time_point catching_up_until_{};
    FeltFrames felt_frames_{};  // the player fills it
    Player player_;
    TripleBuffer<HapticSettings> haptic_settings_{};
    TripleBuffer<HapticState> haptic_state_{};
    std::unique_ptr<StripRing> strips_;
    std::unique_ptr<TickRing> ticks_;
    std::unique_ptr<WalkedTickRing> walked_;
    OtherProxies others_{};
    std::shared_ptr<TouchSource> touch_source_{std::make_shared<TouchSource>()};
    SoundOutput sound_{touch_source_};
    PadOutput pads_{touch_source_};
    TouchRecording recording_;
    std::unique_ptr<HapticLoop> loop_{};  // last member: destroyed first
};

}  // namespace dibhr
