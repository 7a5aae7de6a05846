// The thread that scans for game pads and makes them rumble: drivers may block it.
#include "app/sound/pad_output.hpp"

#define SDL_MAIN_HANDLED  // main stays as it is
#include <SDL.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "app/sound/worker_control.hpp"
#include "core/realtime/triple_buffer.hpp"
#include "core/sound/touch_rumble.hpp"

namespace dibhr {

namespace {

constexpr double kScanInterval_s = 0.5;
constexpr double kRumbleInterval_s = 0.01;

}  // namespace

/// The thread's function and all its data.
class PadOutput::Work {
  public:
    explicit Work(std::shared_ptr<TouchSource> from) : source(std::move(from)) {}

    void run();
    [[nodiscard]] PadInfo info() const;

    std::shared_ptr<TouchSource> source;
    WorkerControl<bool> control{};            // true: pads rumble
    TripleBuffer<SoundMaterial> materials{};  // from the window's thread to this one
    std::atomic<bool> coils_move{false};

  private:
    void wait_without_session();
    void run_pads();
    void set_info(PadInfo info);

    mutable std::mutex mutex_{};
    PadInfo info_{};  // under the mutex
};

void PadOutput::Work::run() {
    while (control.wait()) {
        if (pads_would_copy_process()) {
            wait_without_session();
        } else {
            run_pads();
        }
        set_info({});
    }
    SDL_TLSCleanup();  // SDL's data of this thread, which SDL did not start
    control.report_stopped();
}

void PadOutput::Work::wait_without_session() {
    set_info({.state = PadInfo::State::no_session});
    while (control.unchanged_for(true, kScanInterval_s)) continue;
}

void PadOutput::Work::run_pads() {
    Pads pads(*source);
    TouchRumble rumble;
    SoundListener ticks(source->ticks);
    double step_s = kRumbleInterval_s;
    double since_scan_s = kScanInterval_s;
    do {
        if (since_scan_s >= kScanInterval_s) {
            pads.scan();
            set_info({.state = PadInfo::State::looking, .found = pads.found()});
            since_scan_s = 0.0;
        }
        rumble.choose(materials.front());
        for (SoundTick tick; ticks.pop(tick);) rumble.add(tick);
        pads.set_motors(rumble.after(step_s), coils_move);
        step_s = pads.empty() ? kScanInterval_s : kRumbleInterval_s;
        since_scan_s += step_s;
    } while (control.unchanged_for(true, step_s));
}

void PadOutput::Work::set_info(PadInfo info) {
    const std::lock_guard lock(mutex_);
    info_ = std::move(info);
}

PadInfo PadOutput::Work::info() const {
    const std::lock_guard lock(mutex_);
    return info_;
}

bool PadInfo::has_coils() const {
    return std::ranges::any_of(found, &FoundPad::has_coils);
}

PadOutput::PadOutput(const std::shared_ptr<TouchSource>& source)
    : work_(std::make_shared<Work>(source)) {
    configure_sdl();
    thread_ = std::thread([work = work_] { work->run(); });
}

PadOutput::~PadOutput() {
    work_->control.stop(thread_);
}

void PadOutput::choose(const SoundMaterial& material, bool on, bool coils_move) {
    if (!(material == chosen_)) {
        chosen_ = material;
        work_->materials.publish(material);
    }
    work_->coils_move = coils_move;
    work_->control.request(on);
}

PadInfo PadOutput::info() const {
    return work_->info();
}

}  // namespace dibhr
