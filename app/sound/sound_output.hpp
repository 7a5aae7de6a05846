// Plays the sound of touch on the machine's sound device, and on the voice coils of a game pad. It
// opens them on a thread of its own.
#pragma once

#include <memory>
#include <thread>

#include "app/sound/touch_source.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// Unless muted, it keeps a sound device open; if there is none, it tries again every few seconds.
/// A missing or lost device is no error.
class SoundOutput {
  public:
    enum class State { quiet, playing, no_device };  ///< quiet: muted, or opening

    /// Which devices are to be open. None at first.
    struct Request {
        bool speaker{false};  ///< false: muted
        bool coils{false};    ///< a game pad's voice coils, once its sound device exists

        bool operator==(const Request&) const = default;
    };

    explicit SoundOutput(const std::shared_ptr<TouchSource>& source);
    /// Waits at most half a second: a thread that hangs in a sound server is detached.
    ~SoundOutput();
    SoundOutput(const SoundOutput&) = delete;
    SoundOutput& operator=(const SoundOutput&) = delete;

    /// For the window's thread: the choice for the next samples. The volume is the speaker's.
    void choose(const SoundChoice& choice, Request request);

    /// The speaker's state.
    [[nodiscard]] State state() const noexcept;
    /// Whether voice coils move now.
    [[nodiscard]] bool moves_coils() const noexcept;

  private:
    class Work;

    std::shared_ptr<Work> work_;  // shared with the thread, which may outlive this object
    SoundChoice chosen_{};
    std::thread thread_;
};

}  // namespace dibhr
