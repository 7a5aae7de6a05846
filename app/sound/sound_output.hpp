// Plays the sound of touch through whatever the machine has to play it, away from all other
// threads.
#pragma once

#include <memory>
#include <thread>

#include "core/sound/sound_tick.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// From construction to destruction. While it is not muted it has a sound device open; without one
/// it looks for one every few seconds. That there is none, or no longer, is no error.
class SoundOutput {
  public:
    enum class State { quiet, playing, no_device };  ///< quiet: muted, or about to play

    /// Muted at first.
    SoundOutput();
    /// Waits half a second for a sound server at most: one that hangs is left alone.
    ~SoundOutput();
    SoundOutput(const SoundOutput&) = delete;
    SoundOutput& operator=(const SoundOutput&) = delete;

    /// The haptic loop's end. It must be still before this is destroyed.
    [[nodiscard]] SoundRing& ticks() noexcept;

    /// The window thread's: what the next samples are made of.
    void choose(const SoundChoice& choice, bool mute);

    [[nodiscard]] State state() const noexcept;

  private:
    class Work;

    std::shared_ptr<Work> work_;  // with the thread, which may outlive this
    SoundChoice chosen_{};
    std::thread thread_;
};

}  // namespace dibhr
