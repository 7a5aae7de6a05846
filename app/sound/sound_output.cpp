// The thread that opens and closes sound devices: a sound server may answer late or never.
#include "app/sound/sound_output.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>

#include <atomic>
#include <optional>
#include <string>
#include <utility>

#include "app/sound/sound_stream.hpp"
#include "app/sound/worker_control.hpp"
#include "core/realtime/triple_buffer.hpp"

namespace dibhr {

namespace {

constexpr double kPollInterval_s = 0.5;
constexpr double kRetryInterval_s = 5.0;

/// What the sound devices play from.
struct SoundInputs {
    explicit SoundInputs(std::shared_ptr<TouchSource> from) : source(std::move(from)) {}

    std::shared_ptr<TouchSource> source;
    // From the window's thread to SDL's audio threads.
    TripleBuffer<SoundChoice> by_speaker{};
    TripleBuffer<SoundChoice> by_coils{};
};

/// SDL's audio and the requested devices, as far as they could be opened.
class OpenDevices {
  public:
    OpenDevices(SoundInputs& inputs, SoundOutput::Request request)
        : inputs_(inputs), request_(request) {
        const SdlLock::Guard guard(inputs.source->sdl);
        // Not SDL_InitSubSystem: it connects to D-Bus and may fork the whole process for that.
        if (SDL_AudioInit(nullptr) != 0) return;
        initialised_ = true;
        if (request.speaker) speaker_.emplace(nullptr, inputs.source->ticks, inputs.by_speaker);
        if (const auto device = new_coils()) {
            coils_.emplace(device->c_str(), inputs.source->ticks, inputs.by_coils);
            refused_ = !coils_->plays();
        }
    }
    ~OpenDevices() {
        const SdlLock::Guard guard(inputs_.source->sdl);
        coils_.reset();
        speaker_.reset();
        if (initialised_) SDL_AudioQuit();
    }
    OpenDevices(const OpenDevices&) = delete;
    OpenDevices& operator=(const OpenDevices&) = delete;

    /// False if there was no speaker, or a device was disconnected.
    [[nodiscard]] bool are_open() const {
        return initialised_ && (!request_.speaker || (speaker_ && speaker_->plays())) &&
               (!coils_ || refused_ || coils_->plays());
    }
    [[nodiscard]] bool moves_coils() const { return coils_ && coils_->plays(); }
    /// Voice coils that were connected since the construction.
    [[nodiscard]] std::optional<std::string> new_coils() const {
        return request_.coils && !coils_ ? voice_coil_device() : std::nullopt;
    }

  private:
    SoundInputs& inputs_;
    SoundOutput::Request request_;
    bool initialised_{false};
    std::optional<SoundStream> speaker_{};
    std::optional<SoundStream> coils_{};
    bool refused_{false};  // the coils could not be opened: no reason to reopen everything
};

}  // namespace

/// The thread's function and all its data.
class SoundOutput::Work {
  public:
    explicit Work(const std::shared_ptr<TouchSource>& source) : inputs(source) {}

    void run();

    SoundInputs inputs;
    WorkerControl<Request> control{};
    std::atomic<State> state{State::quiet};
    std::atomic<bool> moves_coils{false};

  private:
    /// Plays until another request, or until a device is connected or lost.
    enum class End { other_request, lost, new_coils };
    [[nodiscard]] End play(const Request& request);
};

void SoundOutput::Work::run() {
    while (const auto request = control.wait()) {
        const End end = play(*request);
        moves_coils = false;
        state = end == End::lost && request->speaker ? State::no_device : State::quiet;
        if (end == End::lost && !control.unchanged_for(*request, kRetryInterval_s))
            state = State::quiet;
    }
    SDL_TLSCleanup();  // SDL's data of this thread, which SDL did not start
    control.report_stopped();
}

SoundOutput::Work::End SoundOutput::Work::play(const Request& request) {
    const OpenDevices devices(inputs, request);
    while (devices.are_open()) {
        state = request.speaker ? State::playing : State::quiet;
        moves_coils = devices.moves_coils();
        if (!control.unchanged_for(request, kPollInterval_s)) return End::other_request;
        if (devices.new_coils()) return End::new_coils;
    }
    return End::lost;
}

SoundOutput::SoundOutput(const std::shared_ptr<TouchSource>& source)
    : work_(std::make_shared<Work>(source)) {
    configure_sdl();
    thread_ = std::thread([work = work_] { work->run(); });
}

SoundOutput::~SoundOutput() {
    work_->control.stop(thread_);
}

void SoundOutput::choose(const SoundChoice& choice, Request request) {
    if (!(choice == chosen_)) {
        chosen_ = choice;
        work_->inputs.by_speaker.publish(choice);
        work_->inputs.by_coils.publish({.material = choice.material});
    }
    work_->control.request(request);
}

SoundOutput::State SoundOutput::state() const noexcept {
    return work_->state.load(std::memory_order_relaxed);
}

bool SoundOutput::moves_coils() const noexcept {
    return work_->moves_coils.load(std::memory_order_relaxed);
}

}  // namespace dibhr
