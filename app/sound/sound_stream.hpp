// One open sound device that plays the sound of touch.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/realtime/triple_buffer.hpp"
#include "core/sound/sound_tick.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// Plays from construction to destruction. SDL's audio must be initialised. The constructor's
/// arguments must outlive the stream.
class SoundStream {
  public:
    /// `coils`: name of the sound device of a pad: plays on its voice coils, and leaves its front
    /// channels silent. Null: one channel, on the machine's default sound device.
    SoundStream(const char* coils, const SoundRing& ticks, TripleBuffer<SoundChoice>& choices);
    ~SoundStream();
    SoundStream(const SoundStream&) = delete;
    SoundStream& operator=(const SoundStream&) = delete;

    /// False if there is no such device, or it was disconnected.
    [[nodiscard]] bool plays() const;

  private:
    static void fill(void* self, std::uint8_t* bytes, int count);

    // Only for SDL's audio thread, once the device plays.
    SoundListener ticks_;
    TripleBuffer<SoundChoice>& choices_;
    std::optional<TouchSound> sound_{};
    int channels_{1};
    std::vector<float> mono_{};

    std::uint32_t device_{0};
};

/// The name of the first sound device that moves voice coils; nothing if there is none.
[[nodiscard]] std::optional<std::string> voice_coil_device();

}  // namespace dibhr
