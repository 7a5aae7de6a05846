// What the sound of touch and the game pads are fed from, and share.
#pragma once

#include <condition_variable>
#include <mutex>

#include "core/sound/sound_tick.hpp"

namespace dibhr {

/// SDL is set up and taken down by one thread after the other.
class SdlTurn {
  public:
    /// While it lives, it is this thread's turn. Waits a second for that and goes on then: a
    /// server that hangs keeps the other thread no longer.
    class Taken {
      public:
        explicit Taken(SdlTurn& turn);
        ~Taken();
        Taken(const Taken&) = delete;
        Taken& operator=(const Taken&) = delete;

      private:
        SdlTurn& turn_;
        bool mine_;
    };

  private:
    std::mutex mutex_{};
    std::condition_variable given_back_{};
    bool taken_{false};  // under the mutex
};

/// Held by each output together with its thread, which may outlive it.
struct TouchSource {
    SoundRing ticks{};  ///< pushed by the haptic loop
    SdlTurn sdl{};
};

/// SDL leaves signals, drivers' messages and the program's name as they are to be. Called by each
/// output before its thread begins, on the thread of the window.
void teach_sdl_manners();

}  // namespace dibhr
