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

/// The user's settings, published whole to the next tick, which lowers them to the device's limits.
struct HapticSettings {
    TouchParameters parameters{};
    SafetyLimits limits{};
    bool force_enabled{true};
    std::shared_ptr<const BumpMap> bump{};  ///< null: none
    bool recording{false};                  ///< every tick is pushed into the recorder's ring
    bool compare_algorithms{false};         ///< and into the ring of the other algorithms
    std::uint64_t version{0};               ///< counts changes, for the recorder
};

/// Equality but for recording, the other algorithms and the version.
[[nodiscard]] inline bool same_touch(const HapticSettings& a, const HapticSettings& b) {
    return a.parameters == b.parameters && a.limits == b.limits &&
           a.force_enabled == b.force_enabled && a.bump == b.bump;
}

/// Periods from tick to tick while nobody touches: a tick of that length is far from a late one
/// (SafetyLimits::max_tick_s).
inline constexpr int kRestingPeriods = 8;

/// The loop's timing over the last whole second.
struct LoopSecond {
    double rate_hz{0.0};
    double worst_lateness_ms{0.0};
    double update_us{0.0};  ///< mean time of one update
    double worst_update_us{0.0};
    double moves{0.0};                      ///< mean primitives visited in an update
    std::uint64_t ticks{0}, late_ticks{0};  ///< from the loop's begin to the end of that second
};

/// What the window shows of the last tick.
struct HapticState {
    Touch touch{};
    bool touchable{false};  ///< there is a surface; without, no update and no force
    SurfaceShape shape{};   ///< of that surface: may be gliding to the setting
    HandReading hand{.ready = false};
    std::uint64_t ticks{0};
    std::uint64_t late_ticks{0};
    /// Ticks that ended before the proxy had caught up with its goal: it goes on in the next one.
    std::uint64_t bounds_met{0};
    bool rests{false};  ///< nobody touches and nothing moves: ticks are kRestingPeriods apart
    LoopSecond second{};
    Standstill standstill{};  ///< the last one

    /// The last tick ended before the proxy had caught up.
    [[nodiscard]] bool catching_up() const noexcept { return touchable && touch.proxy.bound_met; }
};

/// Where a loop reads its input and publishes its results. All must outlive it.
struct HapticConnections {
    Device& device;
    TripleBuffer<FrameWindow>& frames;
    TripleBuffer<HapticSettings>& settings;
    TripleBuffer<HapticState>& state;
    StripRing& strips;
    TickRing& ticks;  ///< for the recorder
    Heartbeats hearts{};
    /// Once true, no force is sent any more; null: never.
    const std::atomic<bool>* without_force{nullptr};
    SoundRing* sound{nullptr};        ///< null: no sound
    WalkedTickRing* walked{nullptr};  ///< for OtherProxies; null: none
};

/// One tick of the loop, without a thread: nothing in it allocates, locks, waits or throws. The
/// device gets no more than it can stand, whatever the settings.
class HapticTick {
  public:
    explicit HapticTick(const HapticConnections& connections);

    /// `late_ticks` is the timer's count so far.
    void run(const TickTiming& timing, std::uint64_t late_ticks) noexcept;

    /// At the end of the loop, and while there is no surface; the next force begins from zero.
    void send_zero_force() noexcept;

    /// Whether the next tick may come kRestingPeriods after this one.
    [[nodiscard]] bool rests() const noexcept { return state_.rests; }

  private:
    /// Where one of these changes the force begins from zero. Pointers are compared, not contents.
    struct ForceContext {
        double pitch_mm{0.0};  ///< the scale of the hand
        const BumpMap* bump{nullptr};
        double bump_size_px{0.0};
        const TouchMaps* maps{nullptr};
        std::uint64_t discontinuity{~0ull};  ///< of the video

        bool operator==(const ForceContext&) const = default;
    };

    /// The force begins from zero in another context, and where a recording begins: it begins with
    /// the state of a fresh program, so that it can be replayed. Other settings glide.
    void notice_changes(const HapticSettings& settings, const FrameWindow& frames) noexcept;
    /// Moves the proxy and sends the force; returns their input, for record().
    [[nodiscard]] TickRecord touch_surface(const DepthBlend& pair, const HapticSettings& settings,
                                           const TickTiming& timing) noexcept;
    /// The hand's force-off button acts in this tick, and until the window switches the force off.
    [[nodiscard]] bool update_force_off(const HandReading& hand,
                                        const HapticSettings& settings) noexcept;
    /// Adds the tick's result, and pushes the row.
    void record(TickRecord& row, const TickTiming& timing) noexcept;
    void push_sound(const HapticSettings& settings) noexcept;
    /// Whether, for half a second, the hand has rested over a still surface with the same settings,
    /// and nothing was recorded.
    [[nodiscard]] bool update_rest(const FrameWindow& frames, const DepthBlend& pair,
                                   const HapticSettings& settings, const TickRecord& row) noexcept;
    /// Pushes the input that the other algorithms' proxies need to walk to this tick's goal.
    void push_walked_tick(const DepthBlend& pair, const HapticSettings& settings,
                          const TickRecord& row) noexcept;
    void count(const TickTiming& timing, double update_us) noexcept;

    HapticConnections connections_;
    TickRunner runner_{};
    HapticState state_{};
    ForceContext context_{};                // of the last tick
    Vec3 carried_px_{0.0};                  // sum of what carried the proxy, which makes no sound
    std::optional<DeviceLimits> limits_{};  // what the hand of the last reading can stand
    bool from_zero_{true};
    bool force_off_pressed_{false};
    bool force_off_by_button_{false};
    bool recording_{false};
    bool reset_{false};  // in this tick: a recording begins
    StandstillWatch watch_{connections_.hearts};
    bool standstill_{false};         // in this tick
    double calm_s_{0.0};             // how long all conditions of update_rest() have been true
    std::uint64_t last_version_{0};  // of the settings in the last tick
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

    /// The system's answers; nothing until the thread has requested them.
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
