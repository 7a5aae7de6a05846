// The threads whose heartbeats the haptic loop checks: while one stands still no force is sent.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "core/realtime/heartbeat.hpp"

namespace dibhr {

/// Null: not checked.
struct Heartbeats {
    const Heartbeat* window{nullptr};    ///< keys, signals' orderly end, the display
    const Heartbeat* video{nullptr};     ///< making surfaces of what was read
    const Heartbeat* recorder{nullptr};  ///< writing the session
    const Heartbeat* decoder{nullptr};   ///< reading it
};

/// Timeout of a heartbeat. Then the force goes to zero within SafetyStage::kFade_s: together less
/// than the 250 ms of the safety rules.
inline constexpr std::chrono::milliseconds kLongestSilence{200};

/// The timeout for a hand without motors: a window that is late on a busy machine does no harm.
inline constexpr std::chrono::milliseconds kLongestHarmlessSilence{2000};

/// A standstill that is over, during which there was a contact.
struct Standstill {
    enum class Thread : std::uint8_t { window, video, recorder };

    Thread thread{Thread::window};
    double seconds{0.0};     ///< without a heartbeat
    std::uint64_t count{0};  ///< of standstills since the loop began, with this one
};

/// Checks the heartbeats. For one thread.
class StandstillWatch {
  public:
    explicit StandstillWatch(const Heartbeats& hearts) noexcept
        : monitors_{HeartbeatMonitor(hearts.window), HeartbeatMonitor(hearts.video),
                    HeartbeatMonitor(hearts.recorder), HeartbeatMonitor(hearts.decoder)} {}

    /// Once a tick: whether a thread stands still. `contact`: there is a force, which goes to zero.
    /// `harmless`: of a hand without motors, whose standstills are not reported.
    [[nodiscard]] bool poll(std::chrono::steady_clock::time_point now, bool contact,
                            bool harmless) noexcept {
        std::array<std::chrono::steady_clock::duration, kMonitors> silence{};
        for (std::size_t k = 0; k < silence.size(); ++k) silence[k] = monitors_[k].silence(now);
        const auto longest = std::max_element(silence.begin(), silence.end());
        if (*longest >= (harmless ? kLongestHarmlessSilence : kLongestSilence)) {
            running_.thread = kThreads[static_cast<std::size_t>(longest - silence.begin())];
            running_.seconds = std::chrono::duration<double>(*longest).count();
            had_contact_ = had_contact_ || (contact && !harmless);
            return true;
        }
        if (had_contact_) last_ = {running_.thread, running_.seconds, last_.count + 1};
        had_contact_ = false;
        return false;
    }

    [[nodiscard]] const Standstill& last() const noexcept { return last_; }

  private:
    static constexpr std::size_t kMonitors = 4;
    static constexpr std::array<Standstill::Thread, kMonitors> kThreads{
        Standstill::Thread::window, Standstill::Thread::video, Standstill::Thread::recorder,
        Standstill::Thread::video};

    std::array<HeartbeatMonitor, kMonitors> monitors_;
    Standstill running_{};
    Standstill last_{};
    bool had_contact_{false};
};

}  // namespace dibhr
