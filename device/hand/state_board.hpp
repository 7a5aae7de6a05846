// The state of a device: written by the device's thread, read by the window.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "device/hand/buttons.hpp"

namespace dibhr {

/// The part of the state that every device has.
struct DeviceStatus {
    std::string sentence{};   ///< the state and the next step, for the user
    bool trouble{false};      ///< the sentence is about a failure
    std::string unguarded{};  ///< why there is no guardian process; empty: there is one
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

    /// The state that is published next.
    [[nodiscard]] State& draft() noexcept { return draft_; }

    void publish() {
        const std::lock_guard lock(mutex_);
        published_ = draft_;
    }

    /// At most 50 times a second; never waits.
    void publish_if_due(Time now) {
        if (now - published_at_ < kPeriod) return;
        // While the window reads, skip this publication: the device's thread must not wait.
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) return;
        published_at_ = now;
        published_ = draft_;
    }

    /// Enters a new stage and publishes at once.
    void enter(decltype(State::stage) stage, const std::string& sentence, bool trouble = false) {
        draft_.stage = stage;
        draft_.sentence = sentence;
        draft_.trouble = trouble;
        publish();
    }

    /// enter(), unless the draft has this stage with this sentence.
    void enter_new(decltype(State::stage) stage, const std::string& sentence, bool trouble) {
        if (draft_.stage != stage || draft_.sentence != sentence) enter(stage, sentence, trouble);
    }

  private:
    static constexpr std::chrono::milliseconds kPeriod{20};  // more often than any screen shows

    State draft_{};
    Time published_at_{};
    mutable std::mutex mutex_{};
    State published_{};  // guarded by mutex_
};

}  // namespace dibhr
