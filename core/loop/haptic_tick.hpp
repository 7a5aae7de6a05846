// The haptic loop: each tick reads the hand, moves the proxy over the newest surface and sends the
// force; a thread runs them at 1 kHz.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>

#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/touch.hpp"
#include "core/loop/device.hpp"
#include "core/loop/other_proxies.hpp"
#include "core/loop/standstill.hpp"
#include "core/loop/tick_runner.hpp"
#include "core/loop/tick_strip.hpp"
#include "core/realtime/tick_timer.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/session/tick_record.hpp"
#include "core/sound/sound_tick.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// What a person tunes, handed whole to the next tick, which holds it to what the device can stand.
struct HapticSettings {
    TouchParameters parameters{};
    SafetyLimits limits{};
    bool force_enabled{true};
    std::shared_ptr<const BumpMap> bump{};  ///< null: none
    bool recording{false};                  ///< every tick goes into the ring
    bool followed{false};                   ///< for the other algorithms' proxies, too
    std::uint64_t version{0};               ///< counts changes, for the recorder
};

/// But for recording, followers and the version.
[[nodiscard]] inline bool same_touch(const HapticSettings& a, const HapticSettings& b) {
    return a.parameters == b.parameters && a.limits == b.limits &&
           a.force_enabled == b.force_enabled && a.bump == b.bump;
}

/// How the loop did over the last whole second.
struct LoopSecond {
    double rate_hz{0.0};
    double worst_lateness_ms{0.0};
    double update_us{0.0};  ///< mean time of one update
    double worst_update_us{0.0};
    double moves{0.0};  ///< mean primitives visited in an update
};

/// What the window shows of the last tick.
struct HapticState {
    Touch touch{};
    bool touchable{false};  ///< there is a surface; without, no update and no force
    SurfaceShape shape{};   ///< of that surface: on its way to what is set
    HandReading hand{.ready = false};
    std::uint64_t ticks{0};
    std::uint64_t late_ticks{0};
    /// Ticks that ended before the proxy had caught up with its goal: it goes on in the next one.
    std::uint64_t bounds_met{0};
    LoopSecond second{};
    Standstill standstill{};  ///< the last one

    /// The last tick was one of them.
    [[nodiscard]] bool catching_up() const noexcept { return touchable && touch.proxy.bound_met; }
};

/// Where a loop gets its surface and leaves what it did. All must outlive it.
struct HapticConnections {
    Device& device;
    TripleBuffer<FrameWindow>& frames;
    TripleBuffer<HapticSettings>& settings;
    TripleBuffer<HapticState>& state;
    StripRing& strips;
    TickRing& ticks;  ///< for the recorder
    Heartbeats hearts{};
    /// Once true, no force is sent any more; null: never.
    const std::atomic<bool>* leaving{nullptr};
    SoundRing* sound{nullptr};        ///< null: nobody listens
    WalkedTickRing* walked{nullptr};  ///< for OtherProxies; null: nobody follows
};

/// One tick of the loop, without a thread: nothing in it allocates, locks, waits or throws.
/// Whatever the settings ask for, the device gets no more than it can stand.
class HapticTick {
  public:
    explicit HapticTick(const HapticConnections& connections);

    /// `late_ticks` is the timer's count so far.
    void run(const TickTiming& timing, std::uint64_t late_ticks) noexcept;

    /// How the loop ends, and what it does while there is nothing to touch; the next force begins
    /// from zero.
    void send_zero_force() noexcept;

  private:
    /// Where one of these changes the force begins from zero. The pointers are compared alone.
    struct ForceContext {
        double pitch_mm{0.0};  ///< the scale of the hand
        const BumpMap* bump{nullptr};
        double bump_size_px{0.0};
        const TouchMaps* maps{nullptr};
        std::uint64_t discontinuity{~0ull};  ///< of the video

        bool operator==(const ForceContext&) const = default;
    };

    /// The force begins from zero in another context, and where a recording begins: that begins as
    /// the program does, so that it can be replayed. Other settings glide.
    void notice_changes(const HapticSettings& settings, const FrameWindow& frames) noexcept;
    /// Moves the proxy and sends the force; gives what they depended on, for record().
    [[nodiscard]] TickRecord touch_surface(const DepthBlend& pair, const HapticSettings& settings,
                                           const TickTiming& timing) noexcept;
    /// The hand's button acts in this very tick, and until the window has switched the force off.
    [[nodiscard]] bool taken_off(const HandReading& hand, const HapticSettings& settings) noexcept;
    /// Adds what came of the tick.
    void record(TickRecord& row, const TickTiming& timing) noexcept;
    void let_hear(const HapticSettings& settings) noexcept;
    /// Adds what others need to walk after this tick's goal.
    void let_follow(const DepthBlend& pair, const HapticSettings& settings,
                    const TickRecord& row) noexcept;
    void count(const TickTiming& timing, double update_us) noexcept;

    HapticConnections to_;
    TickRunner runner_{};
    HapticState state_{};
    ForceContext context_{};  // of the last tick
    Vec3 carried_px_{0.0};    // the proxy by what it touches, in all: nothing is heard of it
    std::optional<DeviceLimits> limits_{};  // what the hand of the last reading can stand
    bool from_zero_{true};
    bool force_off_pressed_{false};
    bool taken_off_{false};
    bool recording_{false};
    bool reset_{false};  // in this tick, nothing was touched before
    StandstillWatch watch_{to_.hearts};
    bool standstill_{false};  // in this tick
    std::chrono::steady_clock::time_point start_{};
    std::chrono::steady_clock::time_point second_begin_{};
    LoopSecond sums_{};  // of the running second
    std::uint64_t second_ticks_{0};
    std::uint64_t second_updates_{0};
};

/// Runs ticks on their own real-time thread from construction until stop().
class HapticLoop {
  public:
    explicit HapticLoop(const HapticConnections& connections);
    ~HapticLoop() { stop(); }
    HapticLoop(const HapticLoop&) = delete;
    HapticLoop& operator=(const HapticLoop&) = delete;

    /// Ends the thread after it has sent zero force. May be called twice.
    void stop() noexcept;

    /// What the system answered; nothing until the thread has asked.
    [[nodiscard]] std::optional<RealtimeGrants> grants() const;

    /// The thread's timer and its lateness; to be read after stop().
    [[nodiscard]] const TickTimer& timer() const noexcept { return timer_; }

  private:
    void run();

    HapticTick tick_;
    TickTimer timer_{};        // the thread's until it has ended
    RealtimeGrants grants_{};  // the thread's until `granted_`
    std::atomic<bool> granted_{false};
    std::atomic<bool> stopping_{false};
    std::thread thread_{};
};

}  // namespace dibhr
