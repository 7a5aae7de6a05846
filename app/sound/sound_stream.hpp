// One sound device that is open, and plays the sound of touch.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/realtime/triple_buffer.hpp"
#include "core/sound/sound_tick.hpp"
#include "core/sound/touch_sound.hpp"

namespace dibhr {

/// From construction to destruction, on SDL's audio, which is to be set up. What it is made of must
/// outlive it.
class SoundStream {
  public:
    /// `coils`: the voice coils of the pad whose sound device is called so, and nothing on its
    /// front channels; null: one channel, on the device that the machine plays sounds on.
    SoundStream(const char* coils, const SoundRing& ticks, TripleBuffer<SoundChoice>& choices);
    ~SoundStream();
    SoundStream(const SoundStream&) = delete;
    SoundStream& operator=(const SoundStream&) = delete;

    /// False when there is no such device, or it has been pulled out.
    [[nodiscard]] bool plays() const;

  private:
    static void fill(void* self, std::uint8_t* bytes, int count);

    // SDL's audio thread's, once it plays.
    SoundListener ticks_;
    TripleBuffer<SoundChoice>& choices_;
    std::optional<TouchSound> sound_{};
    int channels_{1};
    std::vector<float> mono_{};

    std::uint32_t device_{0};
};

/// The first sound device that moves voice coils; nothing when there is none.
[[nodiscard]] std::optional<std::string> voice_coil_device();

}  // namespace dibhr
