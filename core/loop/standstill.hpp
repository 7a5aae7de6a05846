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

/// A standstill that is over, during which there was a contact.
struct Standstill {
    enum class Of : std::uint8_t { window, video, recorder };

    Of of{Of::window};
    double seconds{0.0};     ///< without a heartbeat
    std::uint64_t count{0};  ///< of standstills since the loop began, with this one
};

/// Checks the heartbeats. For one thread.
class StandstillWatch {
  public:
    explicit StandstillWatch(const Heartbeats& hearts) noexcept
        : listeners_{HeartbeatListener(hearts.window), HeartbeatListener(hearts.video),
                     HeartbeatListener(hearts.recorder), HeartbeatListener(hearts.decoder)} {}

    /// Once a tick: whether a thread stands still. `contact`: there is a force, which goes to zero.
    [[nodiscard]] bool look(std::chrono::steady_clock::time_point now, bool contact) noexcept {
        std::array<std::chrono::steady_clock::duration, kListeners> silence{};
        for (std::size_t k = 0; k < silence.size(); ++k) silence[k] = listeners_[k].silence(now);
        const auto longest = std::max_element(silence.begin(), silence.end());
        if (*longest >= kLongestSilence) {
            running_.of = kOf[static_cast<std::size_t>(longest - silence.begin())];
            running_.seconds = std::chrono::duration<double>(*longest).count();
            felt_ = felt_ || contact;
            return true;
        }
        if (felt_) last_ = {running_.of, running_.seconds, last_.count + 1};
        felt_ = false;
        return false;
    }

    [[nodiscard]] const Standstill& last() const noexcept { return last_; }

  private:
    static constexpr std::size_t kListeners = 4;
    static constexpr std::array<Standstill::Of, kListeners> kOf{
        Standstill::Of::window, Standstill::Of::video, Standstill::Of::recorder,
        Standstill::Of::video};

    std::array<HeartbeatListener, kListeners> listeners_;
    Standstill running_{};
    Standstill last_{};
    bool felt_{false};
};

}  // namespace dibhr
