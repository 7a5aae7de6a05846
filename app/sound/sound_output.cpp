// SDL's audio, and the thread that opens and closes it: a sound server may take its time to
// answer, or never do.
#include "app/sound/sound_output.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>
#include <alsa/asoundlib.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <span>

#include "core/realtime/triple_buffer.hpp"

namespace dibhr {

namespace {

constexpr int kRate_hz = 48'000;
constexpr Uint16 kBlock = 256;  // 5 ms: a tap is heard as it is felt
constexpr double kLook_s = 0.5;
constexpr double kTryAgain_s = 5.0;
constexpr auto kPatience = std::chrono::milliseconds(500);

/// A machine without a sound card is none that misses something.
void say_nothing(const char*, int, const char*, int, const char*, ...) {}

/// What a device is given to play.
struct Heard {
    SoundRing ticks{};
    TripleBuffer<SoundChoice> choices{};  // the window thread's and SDL's audio thread's
};

/// A device that is open, or was to be.
class Playing {
  public:
    explicit Playing(Heard& heard) : heard_(heard) {
        SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // those are the program's
        SDL_SetHint(SDL_HINT_APP_NAME, "dibhr");
        SDL_SetHint(SDL_HINT_AUDIO_DEVICE_STREAM_NAME, "Touch");
        snd_lib_error_set_handler(say_nothing);
        // Not SDL_InitSubSystem, which looks for D-Bus, and may copy the whole process for that.
        if (SDL_AudioInit(nullptr) != 0) return;
        initialised_ = true;
        for (SoundTick past; heard.ticks.pop(past);) continue;  // nobody listened
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
        if (initialised_) SDL_AudioQuit();
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
        sound.choose(playing.heard_.choices.front());
        for (SoundTick tick; playing.heard_.ticks.pop(tick);) sound.add(tick);
        sound.render(
            {reinterpret_cast<float*>(bytes), static_cast<std::size_t>(count) / sizeof(float)});
    }

    Heard& heard_;
    bool initialised_{false};
    SDL_AudioDeviceID device_{0};
    std::optional<TouchSound> sound_{};  // SDL's audio thread's, once it plays
};

}  // namespace

/// What the thread does, and all that it needs for it.
class SoundOutput::Work {
  public:
    void run();
    void mute(bool mute);
    /// Asks it to leave; false when it has not done so in time.
    [[nodiscard]] bool ends();

    Heard heard{};
    std::atomic<State> state{State::quiet};

  private:
    /// False when the thread is to leave.
    [[nodiscard]] bool wait_for_sound();
    /// Waits so long, or until no sound is wanted any more: then false.
    [[nodiscard]] bool goes_on_for(double longest_s);

    std::mutex mutex_{};
    std::condition_variable changed_{};
    // Under the mutex.
    bool mute_{true};
    bool leaving_{false};
    bool left_{false};
};

void SoundOutput::Work::run() {
    while (wait_for_sound()) {
        bool wanted = true;
        {
            const Playing playing(heard);
            while (wanted && playing.goes_on()) {
                state = State::playing;
                wanted = goes_on_for(kLook_s);
            }
        }
        state = wanted ? State::no_device : State::quiet;
        if (wanted && !goes_on_for(kTryAgain_s)) state = State::quiet;
    }
    SDL_TLSCleanup();  // what it keeps of a thread that is not its own
    const std::lock_guard lock(mutex_);
    left_ = true;
    changed_.notify_all();
}

void SoundOutput::Work::mute(bool mute) {
    const std::lock_guard lock(mutex_);
    if (mute_ == mute) return;
    mute_ = mute;
    changed_.notify_all();
}

bool SoundOutput::Work::ends() {
    std::unique_lock lock(mutex_);
    leaving_ = true;
    changed_.notify_all();
    return changed_.wait_for(lock, kPatience, [this] { return left_; });
}

bool SoundOutput::Work::wait_for_sound() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return leaving_ || !mute_; });
    return !leaving_;
}

bool SoundOutput::Work::goes_on_for(double longest_s) {
    std::unique_lock lock(mutex_);
    return !changed_.wait_for(lock, std::chrono::duration<double>(longest_s),
                              [this] { return leaving_ || mute_; });
}

SoundOutput::SoundOutput()
    : work_(std::make_shared<Work>()), thread_([work = work_] { work->run(); }) {}

SoundOutput::~SoundOutput() {
    if (work_->ends()) {
        thread_.join();
    } else {
        thread_.detach();
    }
}

SoundRing& SoundOutput::ticks() noexcept {
    return work_->heard.ticks;
}

void SoundOutput::choose(const SoundChoice& choice, bool mute) {
    if (!(choice == chosen_)) {
        chosen_ = choice;
        work_->heard.choices.publish(choice);
    }
    work_->mute(mute);
}

SoundOutput::State SoundOutput::state() const noexcept {
    return work_->state.load(std::memory_order_relaxed);
}

}  // namespace dibhr
