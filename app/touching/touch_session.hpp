// Touching: the device, what is played, the haptic loop, the recorder, the outputs to ear and game
// pad, and what is published to the next tick. Each window has one. See README.md.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sound/pad_output.hpp"
#include "app/sound/sound_output.hpp"
#include "app/sound/touch_source.hpp"
#include "app/touching/device_ends.hpp"
#include "app/touching/pointer.hpp"
#include "app/touching/recording.hpp"
#include "app/touching/touch_state.hpp"
#include "app/window/last_words.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/loop/other_proxies.hpp"
#include "core/realtime/heartbeat.hpp"
#include "core/realtime/tick_timer.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/video/playing/player.hpp"
#include "core/video/sources/media.hpp"
#include "device/hand_device.hpp"

namespace dibhr {

/// Whom the loop listens to, and who is told of recordings; all outlive the session.
struct TouchTies {
    const Heartbeat& window;
    const std::atomic<bool>& without_force;
    LastWords& words;
};

/// The window thread's. No force is sent but between start() and stop().
class TouchSession {
  public:
    /// `state` is the window's, and outlives it.
    TouchSession(HandDevice hand, const TouchTies& ties, const TouchedState& state);

    // Once a picture, in this order; of a recording also TouchRecording::poll(), after the presses.

    /// What the loop and the devices did, into the state: as of the last tick. Notices for a
    /// person.
    [[nodiscard]] std::vector<std::string> poll(bool window_in_front);
    /// The buttons of the grips that went down since the last call.
    [[nodiscard]] std::vector<GripPress> take_presses();
    /// After all that was changed: to the next tick, the devices, the player and the outputs.
    void publish();

    /// Publishes, and begins the loop. Does nothing while it runs.
    void start();
    /// Sends zero force; the loop ends. How it kept its time, where one ran.
    std::optional<TickSchedule> stop() noexcept;
    [[nodiscard]] bool runs() const noexcept { return loop_ != nullptr; }
    /// Stops; the device is let go of, for good.
    void close_device();

    /// Plays it from its first frame; the state gets its description.
    void play(std::unique_ptr<Media> media, std::shared_ptr<const TouchMaps> maps = nullptr);
    /// That its frames and the ticks over them carry.
    [[nodiscard]] std::uint32_t media_number() const noexcept { return media_number_; }
    /// The frames that are played now, which the ticks touch, too.
    [[nodiscard]] DepthBlend frames_now();

    /// Where the mouse points, for the virtual hand. It presses only where no device touches.
    void point(const Camera::Ray& ray, const DepthBlend& shown, PointerUse use);
    /// Whether the mouse is all that touches now.
    [[nodiscard]] bool by_mouse() const noexcept;

    /// The loop has seen the end of the last recording: a next one gets none of its ticks.
    [[nodiscard]] bool may_record() const noexcept;

    /// Checks and keeps a firmware file, and gives it to the device of that kind. What came of it,
    /// for a notice. Throws InputError.
    std::string use_firmware(const std::filesystem::path& file);

    [[nodiscard]] Player& player() noexcept { return player_; }
    [[nodiscard]] TouchRecording& recording() noexcept { return recording_; }

  private:
    void follow_others();
    void notice_catching_up();
    void publish_to_outputs();
    void publish_to_player();

    TouchTies ties_;
    TouchedState state_;
    HandDevice hand_;
    std::vector<DeviceEnd> devices_{};  // that are looked for
    HandPointer pointer_{};
    std::uint32_t media_number_{0};
    HapticSettings published_{};
    std::uint64_t recording_ended_at_{0};  // the running loop's ticks, when that was published
    std::uint64_t standstills_{0};         // as told
    std::uint64_t bounds_met_{0};          // as of the last picture
    std::chrono::steady_clock::time_point catching_up_until_{};
    Player player_{};
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
    std::unique_ptr<HapticLoop> loop_{};  // last: it goes first
};

}  // namespace dibhr
