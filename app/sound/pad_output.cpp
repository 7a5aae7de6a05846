// The thread that scans for game pads and makes them rumble: drivers may block it.
#include "app/sound/pad_output.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "app/sound/wishes.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/sound/touch_rumble.hpp"

namespace dibhr {

namespace {

constexpr double kLookForPads_s = 0.5;
constexpr double kTell_s = 0.01;

}  // namespace

/// The thread's function and all its data.
class PadOutput::Work {
  public:
    explicit Work(std::shared_ptr<TouchSource> from) : source(std::move(from)) {}

    void run();
    [[nodiscard]] PadNews news() const;

    std::shared_ptr<TouchSource> source;
    Wishes<bool> wishes{};                    // true: pads rumble
    TripleBuffer<SoundMaterial> materials{};  // from the window's thread to this one
    std::atomic<bool> coils_move{false};

  private:
    void wait_without();
    void serve();
    void say(PadNews news);

    mutable std::mutex mutex_{};
    PadNews news_{};  // under the mutex
};

void PadOutput::Work::run() {
    while (wishes.wait()) {
        if (pads_would_copy_process()) {
            wait_without();
        } else {
            serve();
        }
        say({});
    }
    SDL_TLSCleanup();  // SDL's data of this thread, which SDL did not start
    wishes.say_left();
}

void PadOutput::Work::wait_without() {
    say({.state = PadNews::State::no_session});
    while (wishes.holds_for(true, kLookForPads_s)) continue;
}

void PadOutput::Work::serve() {
    Pads pads(*source);
    TouchRumble rumble;
    SoundListener ticks(source->ticks);
    double step_s = kTell_s;
    double not_looked_s = kLookForPads_s;
    do {
        if (not_looked_s >= kLookForPads_s) {
            pads.look();
            say({.state = PadNews::State::looking, .found = pads.found()});
            not_looked_s = 0.0;
        }
        rumble.choose(materials.front());
        for (SoundTick tick; ticks.pop(tick);) rumble.add(tick);
        pads.turn(rumble.after(step_s), coils_move);
        step_s = pads.empty() ? kLookForPads_s : kTell_s;
        not_looked_s += step_s;
    } while (wishes.holds_for(true, step_s));
}

void PadOutput::Work::say(PadNews news) {
    const std::lock_guard lock(mutex_);
    news_ = std::move(news);
}

PadNews PadOutput::Work::news() const {
    const std::lock_guard lock(mutex_);
    return news_;
}

bool PadNews::has_coils() const {
    return std::ranges::any_of(found, &FoundPad::has_coils);
}

PadOutput::PadOutput(const std::shared_ptr<TouchSource>& source)
    : work_(std::make_shared<Work>(source)) {
    teach_sdl_manners();
    thread_ = std::thread([work = work_] { work->run(); });
}

PadOutput::~PadOutput() {
    work_->wishes.leave(thread_);
}

void PadOutput::choose(const SoundMaterial& material, bool on, bool coils_move) {
    if (!(material == chosen_)) {
        chosen_ = material;
        work_->materials.publish(material);
    }
    work_->coils_move = coils_move;
    work_->wishes.wish(on);
}

PadNews PadOutput::news() const {
    return work_->news();
}

}  // namespace dibhr
