// SDL's audio, and the thread that opens and closes it: a sound server may take its time to answer.
#include "app/sound/sound_output.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>
#include <alsa/asoundlib.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

namespace dibhr {

namespace {

constexpr int kRate_hz = 48'000;
constexpr Uint16 kBlock = 256;  // 5 ms: a tap is heard as it is felt
constexpr double kLook_s = 0.5;
constexpr double kTryAgain_s = 5.0;

/// A machine without a sound card is none that misses something.
void say_nothing(const char*, int, const char*, int, const char*, ...) {}

}  // namespace

class SoundOutput::Playing {
  public:
    explicit Playing(SoundOutput& output) : output_(output) {
        SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // those are the program's
        SDL_SetHint(SDL_HINT_APP_NAME, "dibhr");
        SDL_SetHint(SDL_HINT_AUDIO_DEVICE_STREAM_NAME, "Touch");
        snd_lib_error_set_handler(say_nothing);
        if (SDL_InitSubSystem(SDL_INIT_AUDIO) != 0) return;
        initialised_ = true;
        for (SoundTick past; output.ticks_.pop(past);) continue;  // nobody listened
        SDL_AudioSpec wanted{};
        wanted.freq = kRate_hz;
        wanted.format = AUDIO_F32SYS;
        wanted.channels = 1;
        wanted.samples = kBlock;
        wanted.callback = &Playing::fill;
        wanted.userdata = this;
        SDL_AudioSpec given{};
        device_ =
            SDL_OpenAudioDevice(nullptr, 0, &wanted, &given, SDL_AUDIO_ALLOW_FREQUENCY_CHANGE);
        if (device_ == 0) return;
        sound_.emplace(given.freq);
        SDL_PauseAudioDevice(device_, 0);
    }
    ~Playing() {
        if (device_ != 0) SDL_CloseAudioDevice(device_);
        if (initialised_) SDL_QuitSubSystem(SDL_INIT_AUDIO);
    }
    Playing(const Playing&) = delete;
    Playing& operator=(const Playing&) = delete;

    /// False when there was none, or it has been pulled out.
    [[nodiscard]] bool goes_on() const {
        return device_ != 0 && SDL_GetAudioDeviceStatus(device_) == SDL_AUDIO_PLAYING;
    }

  private:
    /// SDL's audio thread.
    static void fill(void* self, Uint8* bytes, int count) {
        Playing& playing = *static_cast<Playing*>(self);
        TouchSound& sound = *playing.sound_;
        sound.choose(playing.output_.choices_.front());
        for (SoundTick tick; playing.output_.ticks_.pop(tick);) sound.add(tick);
        sound.render(
            {reinterpret_cast<float*>(bytes), static_cast<std::size_t>(count) / sizeof(float)});
    }

    SoundOutput& output_;
    bool initialised_{false};
    SDL_AudioDeviceID device_{0};
    std::optional<TouchSound> sound_{};  // SDL's audio thread's, once it plays
};

SoundOutput::SoundOutput(SoundRing& ticks) : ticks_(ticks), thread_([this] { run(); }) {}

SoundOutput::~SoundOutput() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void SoundOutput::choose(const SoundChoice& choice, bool mute) {
    if (!(choice == chosen_)) {
        chosen_ = choice;
        choices_.publish(choice);
    }
    {
        const std::lock_guard lock(mutex_);
        if (mute_ == mute) return;
        mute_ = mute;
    }
    changed_.notify_one();
}

void SoundOutput::run() {
    while (wait_for_sound()) {
        bool wanted = true;
        {
            const Playing playing(*this);
            while (wanted && playing.goes_on()) {
                state_ = State::playing;
                wanted = goes_on_for(kLook_s);
            }
        }
        state_ = wanted ? State::no_device : State::quiet;
        if (wanted && !goes_on_for(kTryAgain_s)) state_ = State::quiet;
    }
    SDL_TLSCleanup();  // what it keeps of a thread that is not its own
}

bool SoundOutput::wait_for_sound() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return leaving_ || !mute_; });
    return !leaving_;
}

bool SoundOutput::goes_on_for(double longest_s) {
    std::unique_lock lock(mutex_);
    return !changed_.wait_for(lock, std::chrono::duration<double>(longest_s),
                              [this] { return leaving_ || mute_; });
}

}  // namespace dibhr
