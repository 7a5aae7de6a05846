// Plays the sound of touch through whatever the machine has to play it, and through the voice
// coils of a game pad, away from all other threads.
#pragma once

#include <memory>
#include <thread>

#include "app/sound/touch_source.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// From construction to destruction. While it is not muted it has a sound device open; without one
/// it looks for one every few seconds. That there is none, or no longer, is no error.
class SoundOutput {
  public:
    enum class State { quiet, playing, no_device };  ///< quiet: muted, or about to play

    /// What is to be open. Nothing at first.
    struct Wish {
        bool speaker{false};  ///< false: muted
        bool coils{false};    ///< a game pad with voice coils, once it shows as a sound device

        bool operator==(const Wish&) const = default;
    };

    explicit SoundOutput(const std::shared_ptr<TouchSource>& source);
    /// Waits half a second for a sound server at most: one that hangs is left alone.
    ~SoundOutput();
    SoundOutput(const SoundOutput&) = delete;
    SoundOutput& operator=(const SoundOutput&) = delete;

    /// The window thread's: what the next samples are made of. The volume is the speaker's.
    void choose(const SoundChoice& choice, Wish wish);

    /// Of the speaker.
    [[nodiscard]] State state() const noexcept;
    /// Whether voice coils move now.
    [[nodiscard]] bool moves_coils() const noexcept;

  private:
    class Work;

    std::shared_ptr<Work> work_;  // with the thread, which may outlive this
    SoundChoice chosen_{};
    std::thread thread_;
};

}  // namespace dibhr
