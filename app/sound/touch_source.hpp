// The ticks that sound and game pads are made from, and the lock for SDL that both outputs share.
#pragma once

#include <condition_variable>
#include <mutex>

#include "core/sound/sound_tick.hpp"

namespace dibhr {

/// Only one thread at a time may initialise or shut down SDL.
class SdlLock {
  public:
    /// Holds the lock during its life. Waits at most a second for it and then goes on without: a
    /// hanging server must not block the other thread.
    class Guard {
      public:
        explicit Guard(SdlLock& sdl_lock);
        ~Guard();
        Guard(const Guard&) = delete;
        Guard& operator=(const Guard&) = delete;

      private:
        SdlLock& sdl_lock_;
        bool owned_;
    };

  private:
    std::mutex mutex_{};
    std::condition_variable released_{};
    bool locked_{false};  // under the mutex
};

/// Owned by each output together with its thread, which may outlive the output.
struct TouchSource {
    SoundRing ticks{};  ///< the haptic loop pushes them
    SdlLock sdl{};
};

/// SDL must not handle signals, print drivers' messages, or open pads by its own drivers. Each
/// output calls it on the window's thread before its own thread starts.
void configure_sdl();

}  // namespace dibhr
