// What a participant touches: the surface of an interval, its force on or off, recorded trial by
// trial.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "app/sound/sound_output.hpp"
#include "app/viewer/falcon.hpp"
#include "app/viewer/input.hpp"
#include "app/viewer/inverse3.hpp"
#include "app/viewer/recording.hpp"
#include "core/loop/haptic_tick.hpp"
#include "core/study/protocol.hpp"
#include "core/study/trial.hpp"
#include "core/video/player.hpp"
#include "device/hand_device.hpp"

namespace dibhr {

/// Who listens to whom, as the haptic loop has it; all outlive the surface.
struct StudyTies {
    const Heartbeat& window;
    const std::atomic<bool>& without_force;
    LastWords& words;
};

/// The window thread's. What is felt is what the command line would make of the values: nothing of
/// a person's own settings but those of the device, the limit of force and the sound's loudness.
class StudySurface {
  public:
    StudySurface(HandDevice hand, const Settings& settings, const StudyTies& ties);

    /// A trial's ticks go into that file, from the next interval on.
    void begin_trial(const std::filesystem::path& session);
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
    void take_news(bool window_in_front);
    /// Once a picture, after all that was changed: to the next tick.
    void hand_over();
    struct ButtonPress {
        int button{0};  ///< of the device, from 0
        std::chrono::steady_clock::time_point at{};
    };
    /// Those since the last call.
    [[nodiscard]] std::vector<ButtonPress> take_presses();
    [[nodiscard]] bool is_down(int button) const noexcept {
        return (state_.touch.haptic.hand.buttons >> button & 1) != 0;
    }
    /// Where the mouse points, for the virtual hand; does nothing where there is none.
    void point(const Camera::Ray& ray, const PointerUse& use);

    /// As what is drawn of it needs.
    [[nodiscard]] const ViewerState& state() const noexcept { return state_; }
    [[nodiscard]] const DepthBlend& shown() const noexcept { return shown_; }
    /// Whether the mouse is all that touches now.
    [[nodiscard]] bool by_mouse() const noexcept;

    /// Sends no force any more, for good.
    void stop() noexcept;

  private:
    enum class Grip : std::uint8_t { falcon, inverse3 };

    void wear(const TouchValues& values);
    void open(const Protocol& protocol, const std::string& media);
    void start_loop();
    void record_if_possible();

    StudyTies ties_;
    Settings own_;  // a person's
    HandDevice hand_;
    ViewerState state_{};
    ViewerFalcon falcon_;
    ViewerInverse3 inverse3_;
    HandPointer pointer_{};
    std::string media_{};  // the name of what is open
    std::uint32_t number_{0};
    std::filesystem::path session_{};         // of a trial whose recording has not begun
    bool rests_{false};                       // from the next hand-over on, to be marked
    std::array<ButtonPresses, 2> pressed_{};  // as taken, by Grip
    HapticSettings handed_{};
    std::uint64_t handed_at_{0};  // the loop's ticks then
    DepthBlend shown_{};
    Player player_{};
    TripleBuffer<HapticSettings> haptic_settings_{};
    TripleBuffer<HapticState> haptic_state_{};
    std::unique_ptr<StripRing> strips_;
    std::unique_ptr<TickRing> ticks_;
    std::shared_ptr<TouchSource> touch_source_{std::make_shared<TouchSource>()};
    SoundOutput sound_{touch_source_};
    ViewerRecording recording_;
    std::unique_ptr<HapticLoop> loop_{};  // last: it goes first
};

}  // namespace dibhr
