// Where a device's thread writes its state and the window reads it.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "device/hand/buttons.hpp"

namespace dibhr {

/// What every device tells, whatever its stages are.
struct DeviceStatus {
    std::string sentence{};   ///< what is, and what to do next
    bool trouble{false};      ///< the sentence tells of something that went wrong
    std::string unguarded{};  ///< why nobody sends zero if the program is killed
    ButtonPresses presses{};  ///< since the start
    ButtonPressTimes pressed_at{};
};

/// `State` is a DeviceStatus with a `stage`.
template <typename State>
class StateBoard {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Any thread but the haptic one.
    [[nodiscard]] State read() const {
        const std::lock_guard lock(mutex_);
        return published_;
    }

    // The device's thread alone:

    /// The state to come.
    [[nodiscard]] State& draft() noexcept { return draft_; }

    void publish() {
        const std::lock_guard lock(mutex_);
        published_ = draft_;
    }

    /// At most 50 times a second; never waits.
    void publish_if_due(Time now) {
        if (now - published_at_ < kPeriod) return;
        // The window is reading: it must not hold up a reply. The next one will do.
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) return;
        published_at_ = now;
        published_ = draft_;
    }

    /// A new stage, published at once.
    void enter(decltype(State::stage) stage, const std::string& sentence, bool trouble = false) {
        draft_.stage = stage;
        draft_.sentence = sentence;
        draft_.trouble = trouble;
        publish();
    }

  private:
    static constexpr std::chrono::milliseconds kPeriod{20};  // more often than any screen shows

    State draft_{};
    Time published_at_{};
    mutable std::mutex mutex_{};
    State published_{};  // guarded by mutex_
};

}  // namespace dibhr
