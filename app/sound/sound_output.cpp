// The thread that opens and closes sound devices: a sound server may answer late or never.
#include "app/sound/sound_output.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>

#include <atomic>
#include <optional>
#include <string>
#include <utility>

#include "app/sound/sound_stream.hpp"
#include "app/sound/wishes.hpp"
#include "core/realtime/triple_buffer.hpp"

namespace dibhr {

namespace {

constexpr double kLook_s = 0.5;
constexpr double kTryAgain_s = 5.0;

/// What the sound devices play from.
struct Heard {
    explicit Heard(std::shared_ptr<TouchSource> from) : source(std::move(from)) {}

    std::shared_ptr<TouchSource> source;
    // From the window's thread to SDL's audio threads.
    TripleBuffer<SoundChoice> by_speaker{};
    TripleBuffer<SoundChoice> by_coils{};
};

/// SDL's audio and the requested devices, as far as they could be opened.
class Playing {
  public:
    Playing(Heard& heard, SoundOutput::Wish wish) : heard_(heard), wish_(wish) {
        const SdlTurn::Taken turn(heard.source->sdl);
        // Not SDL_InitSubSystem: it connects to D-Bus and may fork the whole process for that.
        if (SDL_AudioInit(nullptr) != 0) return;
        initialised_ = true;
        if (wish.speaker) speaker_.emplace(nullptr, heard.source->ticks, heard.by_speaker);
        if (const auto device = new_coils()) {
            coils_.emplace(device->c_str(), heard.source->ticks, heard.by_coils);
            refused_ = !coils_->plays();
        }
    }
    ~Playing() {
        const SdlTurn::Taken turn(heard_.source->sdl);
        coils_.reset();
        speaker_.reset();
        if (initialised_) SDL_AudioQuit();
    }
    Playing(const Playing&) = delete;
    Playing& operator=(const Playing&) = delete;

    /// False if there was no speaker, or a device was disconnected.
    [[nodiscard]] bool goes_on() const {
        return initialised_ && (!wish_.speaker || (speaker_ && speaker_->plays())) &&
               (!coils_ || refused_ || coils_->plays());
    }
    [[nodiscard]] bool moves_coils() const { return coils_ && coils_->plays(); }
    /// Voice coils that were connected since the construction.
    [[nodiscard]] std::optional<std::string> new_coils() const {
        return wish_.coils && !coils_ ? voice_coil_device() : std::nullopt;
    }

  private:
    Heard& heard_;
    SoundOutput::Wish wish_;
    bool initialised_{false};
    std::optional<SoundStream> speaker_{};
    std::optional<SoundStream> coils_{};
    bool refused_{false};  // the coils could not be opened: no reason to reopen everything
};

}  // namespace

/// The thread's function and all its data.
class SoundOutput::Work {
  public:
    explicit Work(const std::shared_ptr<TouchSource>& source) : heard(source) {}

    void run();

    Heard heard;
    Wishes<Wish> wishes{};
    std::atomic<State> state{State::quiet};
    std::atomic<bool> moves_coils{false};

  private:
    /// Plays until another request, or until a device is connected or lost.
    enum class End { other_wish, lost, new_coils };
    [[nodiscard]] End play(const Wish& wish);
};

void SoundOutput::Work::run() {
    while (const auto wish = wishes.wait()) {
        const End end = play(*wish);
        moves_coils = false;
        state = end == End::lost && wish->speaker ? State::no_device : State::quiet;
        if (end == End::lost && !wishes.holds_for(*wish, kTryAgain_s)) state = State::quiet;
    }
    SDL_TLSCleanup();  // SDL's data of this thread, which SDL did not start
    wishes.say_left();
}

SoundOutput::Work::End SoundOutput::Work::play(const Wish& wish) {
    const Playing playing(heard, wish);
    while (playing.goes_on()) {
        state = wish.speaker ? State::playing : State::quiet;
        moves_coils = playing.moves_coils();
        if (!wishes.holds_for(wish, kLook_s)) return End::other_wish;
        if (playing.new_coils()) return End::new_coils;
    }
    return End::lost;
}

SoundOutput::SoundOutput(const std::shared_ptr<TouchSource>& source)
    : work_(std::make_shared<Work>(source)) {
    teach_sdl_manners();
    thread_ = std::thread([work = work_] { work->run(); });
}

SoundOutput::~SoundOutput() {
    work_->wishes.leave(thread_);
}

void SoundOutput::choose(const SoundChoice& choice, Wish wish) {
    if (!(choice == chosen_)) {
        chosen_ = choice;
        work_->heard.by_speaker.publish(choice);
        work_->heard.by_coils.publish({.material = choice.material});
    }
    work_->wishes.wish(wish);
}

SoundOutput::State SoundOutput::state() const noexcept {
    return work_->state.load(std::memory_order_relaxed);
}

bool SoundOutput::moves_coils() const noexcept {
    return work_->moves_coils.load(std::memory_order_relaxed);
}

}  // namespace dibhr
