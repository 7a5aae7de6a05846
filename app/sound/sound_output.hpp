// Plays the sound of touch through whatever the machine has to play it, away from all other
// threads.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/realtime/triple_buffer.hpp"
#include "core/sound/sound_tick.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// From construction to destruction. While it is not muted it has a sound device open; without one
/// it looks for one every few seconds. That there is none, or no longer, is no error.
class SoundOutput {
  public:
    enum class State { quiet, playing, no_device };  ///< quiet: muted, or about to play

    /// Muted at first. `ticks` outlives it: the haptic loop's end.
    explicit SoundOutput(SoundRing& ticks);
    ~SoundOutput();
    SoundOutput(const SoundOutput&) = delete;
    SoundOutput& operator=(const SoundOutput&) = delete;

    /// The window thread's: what the next samples are made of.
    void choose(const SoundChoice& choice, bool mute);

    [[nodiscard]] State state() const noexcept { return state_.load(std::memory_order_relaxed); }

  private:
    /// A device that is open.
    class Playing;

    void run();
    /// False when the thread is to leave.
    [[nodiscard]] bool wait_for_sound();
    /// Waits so long, or until no sound is wanted any more: then false.
    bool goes_on_for(double longest_s);

    SoundRing& ticks_;
    TripleBuffer<SoundChoice> choices_{};
    SoundChoice chosen_{};  // the window thread's
    std::atomic<State> state_{State::quiet};
    std::mutex mutex_{};
    std::condition_variable changed_{};
    bool mute_{true};      // under the mutex
    bool leaving_{false};  // under the mutex
    std::thread thread_{};
};

}  // namespace dibhr
