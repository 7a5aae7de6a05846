// SDL's audio devices.
#include "app/sound/sound_stream.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>

#include <cstddef>
#include <span>

#include "core/sound/voice_coils.hpp"

namespace dibhr {

namespace {

constexpr int kRate_hz = 48'000;
constexpr Uint16 kBlock = 256;  // 5 ms: a tap's sound comes with its force

// With PulseAudio, SDL takes four channels as front, centre and bass. Of six channels the last two
// are always the rear pair. A device of four channels still opens with four.
constexpr int kCoilChannels = 6;

}  // namespace

SoundStream::SoundStream(const char* coils, const SoundRing& ticks,
                         TripleBuffer<SoundChoice>& choices)
    : ticks_(ticks), choices_(choices) {
    const bool is_pad = coils != nullptr;
    SDL_AudioSpec wanted{};
    wanted.freq = kRate_hz;
    wanted.format = AUDIO_F32SYS;
    wanted.channels = static_cast<Uint8>(is_pad ? kCoilChannels : 1);
    wanted.samples = kBlock;
    wanted.callback = &SoundStream::fill;
    wanted.userdata = this;
    SDL_AudioSpec given{};
    device_ = SDL_OpenAudioDevice(
        coils, 0, &wanted, &given,
        SDL_AUDIO_ALLOW_FREQUENCY_CHANGE | (is_pad ? SDL_AUDIO_ALLOW_CHANNELS_CHANGE : 0));
    if (device_ == 0) return;
    if (is_pad && given.channels < kFewestCoilChannels) return;  // the device stays silent
    channels_ = given.channels;
    mono_.resize(given.samples);
    sound_.emplace(given.freq);
    SDL_PauseAudioDevice(device_, 0);
}

SoundStream::~SoundStream() {
    if (device_ != 0) SDL_CloseAudioDevice(device_);
}

bool SoundStream::plays() const {
    return device_ != 0 && SDL_GetAudioDeviceStatus(device_) == SDL_AUDIO_PLAYING;
}

/// Called by SDL's audio thread.
void SoundStream::fill(void* self, std::uint8_t* bytes, int count) {
    SoundStream& stream = *static_cast<SoundStream*>(self);
    TouchSound& sound = *stream.sound_;
    sound.choose(stream.choices_.front());
    for (SoundTick tick; stream.ticks_.pop(tick);) sound.add(tick);
    const std::span<float> frames(reinterpret_cast<float*>(bytes),
                                  static_cast<std::size_t>(count) / sizeof(float));
    if (stream.channels_ == 1) {
        sound.render(frames);
        return;
    }
    stream.mono_.resize(frames.size() / static_cast<std::size_t>(stream.channels_));
    sound.render(stream.mono_);
    spread_to_rear(stream.mono_, frames, stream.channels_);
}

std::optional<std::string> voice_coil_device() {
    for (int k = 0; k < SDL_GetNumAudioDevices(0); ++k) {
        const char* name = SDL_GetAudioDeviceName(k, 0);
        SDL_AudioSpec preferred{};  // 0 channels: not known before the device is open
        if (SDL_GetAudioDeviceSpec(k, 0, &preferred) != 0) preferred.channels = 0;
        if (name != nullptr && has_voice_coils(name, preferred.channels)) return name;
    }
    return std::nullopt;
}

}  // namespace dibhr
