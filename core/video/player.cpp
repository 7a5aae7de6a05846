// The thread that cleans frames and hands them over; decoding has one of its own.
#include "core/video/player.hpp"

#include <malloc.h>
#include <pthread.h>

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/video/frame_reader.hpp"
#include "core/video/playback.hpp"

namespace dibhr {
namespace {

using Time = Playback::Time;

/// What a method asks of the player's thread. Of seeks in a row, of cleanings and of maps, only the
/// last one counts.
enum class Kind { step, seek, cleaning, maps };
struct Command {
    std::function<void(Playback&, Time)> action{};
    Kind kind{Kind::step};
};

}  // namespace

struct Player::Implementation {
    void ask(Command command);
    void run();

    bool wait_for_work(std::vector<Command>& taken);
    void work(const std::vector<Command>& taken);
    template <typename Action>
    bool attempt(Action action);
    void publish();

    TripleBuffer<FrameWindow> haptics{};
    TripleBuffer<FrameWindow> picture{};
    Heartbeat heart{}, decoding{};

    // The player thread's.
    Playback playback{};
    Time handed_over{};  ///< `cleaned` of the last frame whose hand-over was measured
    std::string failure{};

    // Everybody's, under the mutex.
    std::mutex mutex{};
    std::condition_variable asked{};
    std::vector<Command> commands{};
    PlaybackStatus status{};
    FrameWindow shown{};  ///< as last published, for the time line
    std::optional<double> sought_s{};
    bool leaving{false};

    std::thread thread{};
};

void Player::Implementation::ask(Command command) {
    {
        const std::lock_guard lock(mutex);
        if (command.kind != Kind::step && !commands.empty() && commands.back().kind == command.kind)
            commands.pop_back();
        commands.push_back(std::move(command));
    }
    asked.notify_one();
}

/// False when the player is to end.
bool Player::Implementation::wait_for_work(std::vector<Command>& taken) {
    const bool busy = playback.needs_frame() || playback.has_time();
    const Time due = playback.next_due();
    std::unique_lock lock(mutex);
    const auto called = [this] { return leaving || !commands.empty(); };
    if (!busy) heart.rest();
    if (!busy && due == Time::max())
        asked.wait(lock, called);
    else if (!busy)
        asked.wait_until(lock, due, called);
    taken.swap(commands);
    heart.beat();
    return !leaving;
}

/// Performs the commands, or, without any, reads one frame: they wait for one frame at most.
void Player::Implementation::work(const std::vector<Command>& taken) {
    bool changed = playback.advance(std::chrono::steady_clock::now());
    for (const Command& command : taken) {
        failure.clear();
        attempt([&] { command.action(playback, std::chrono::steady_clock::now()); });
        changed = true;
    }
    if (!changed && playback.needs_frame()) {
        const bool readable = attempt([&] {
            if (playback.read_ahead(std::chrono::steady_clock::now()))
                playback.arrived(std::chrono::steady_clock::now());
        });
        if (!readable) playback.end_here();
        changed = true;
    } else if (!changed && playback.has_time()) {
        playback.make_ready_to_step_back();
    }
    if (changed) publish();
}

/// False when a file could not be read: the failure is kept for the status, and what is shown
/// stays.
template <typename Action>
bool Player::Implementation::attempt(Action action) {
    try {
        action();
        return true;
    } catch (const Error& error) {
        failure = error.what();
    } catch (const std::exception& error) {
        failure = std::string("playing broke off (") + error.what() + "): open the file again";
    }
    return false;
}

void Player::Implementation::run() {
    pthread_setname_np(pthread_self(), "dibhr-video");
    heart.also_computes();
    std::vector<Command> taken;
    while (wait_for_work(taken)) {
        work(taken);
        taken.clear();
    }
    heart.rest();
}

/// Both readers get the same window; what the old ones held is freed here.
void Player::Implementation::publish() {
    const FrameWindow window = playback.window();
    haptics.publish(playback.touchable());
    const Time published = std::chrono::steady_clock::now();
    picture.publish(window);
    const std::lock_guard lock(mutex);
    shown = window;
    sought_s = playback.sought_s();
    status.failure = failure;
    if (!playback.is_open()) return;
    if (failure.empty()) status.failure = playback.description().trouble;
    status.open = true;
    status.playing = playback.playing();
    status.looping = playback.looping();
    status.part = playback.part();
    status.speed = playback.speed();
    status.duration_s = playback.description().duration_s;
    status.frames = playback.description().frames;
    status.frames_per_s = playback.description().frames_per_s;
    status.shown_per_s = playback.shown_per_s();
    status.waits = playback.waits();
    status.cleaning = playback.cleaning_in_words();
    status.steps = playback.steps();
    const FrameCost& cost = playback.cost();
    status.decode_ms = cost.decode_ms + cost.clean_ms;
    status.clean_ms = cost.clean_ms;
    if (cost.cleaned == handed_over) return;
    handed_over = cost.cleaned;
    status.handover_us =
        std::chrono::duration<double, std::micro>(published - cost.cleaned).count();
}

Player::Player() : implementation_(std::make_unique<Implementation>()) {
    implementation_->thread = std::thread([this] { implementation_->run(); });
}

Player::~Player() {
    {
        const std::lock_guard lock(implementation_->mutex);
        implementation_->leaving = true;
    }
    implementation_->asked.notify_one();
    implementation_->thread.join();
}

void Player::play_media(std::unique_ptr<Media> media, std::uint32_t number,
                        std::shared_ptr<const TouchMaps> maps) {
    // std::function wants to be copyable, hence shared; the reader moves on when the command runs.
    auto reader = std::make_shared<std::unique_ptr<FrameReader>>(std::make_unique<FrameReader>(
        std::move(media), number,
        ReadingHearts{&implementation_->decoding, &implementation_->heart}));
    (*reader)->set_maps(std::move(maps));
    implementation_->ask({[reader](Playback& playback, Time now) {
        playback.open(std::move(*reader), now);
        // Else what the media before took stays with the program.
        malloc_trim(0);
    }});
}

void Player::play() {
    implementation_->ask({[](Playback& playback, Time now) { playback.play(now); }});
}

void Player::pause() {
    implementation_->ask({[](Playback& playback, Time now) { playback.pause(now); }});
}

void Player::seek(double media_s) {
    implementation_->ask(
        {[media_s](Playback& playback, Time now) { playback.seek(media_s, now); }, Kind::seek});
}

void Player::step(int frames) {
    implementation_->ask({[frames](Playback& playback, Time now) { playback.step(frames, now); }});
}

void Player::set_looping(bool looping) {
    implementation_->ask({[looping](Playback& playback, Time) { playback.set_looping(looping); }});
}

void Player::set_part(const std::optional<MediaPart>& part) {
    implementation_->ask({[part](Playback& playback, Time) { playback.set_part(part); }});
}

void Player::set_speed(double speed) {
    implementation_->ask(
        {[speed](Playback& playback, Time now) { playback.set_speed(speed, now); }});
}

void Player::set_cleaning(const CleaningOptions& options) {
    implementation_->ask(
        {[options](Playback& playback, Time) { playback.set_cleaning(options); }, Kind::cleaning});
}

void Player::set_motion(bool wanted) {
    implementation_->ask({[wanted](Playback& playback, Time) { playback.set_motion(wanted); }});
}

void Player::set_maps(std::shared_ptr<const TouchMaps> maps) {
    implementation_->ask(
        {[maps = std::move(maps)](Playback& playback, Time) { playback.set_maps(maps); },
         Kind::maps});
}

PlaybackStatus Player::status() const {
    const std::lock_guard lock(implementation_->mutex);
    PlaybackStatus status = implementation_->status;
    const FrameWindow& shown = implementation_->shown;
    const double moment_s = shown.clock.playback_s(std::chrono::steady_clock::now());
    const DepthBlend pair = shown.at(moment_s);
    if (pair.from == nullptr) return status;
    // Between two frames the media time moves on, up to the end of the file at the loop's seam.
    const double lasts_s = pair.to->media_s < pair.from->media_s
                               ? pair.to->time_s - pair.from->time_s
                               : pair.to->media_s - pair.from->media_s;
    const double passed_s = pair.blend * lasts_s;
    status.frame = pair.from->index;
    status.media_s = implementation_->sought_s.value_or(pair.from->media_s + passed_s);
    return status;
}

const Heartbeat& Player::heart() const noexcept {
    return implementation_->heart;
}
const Heartbeat& Player::decoder_heart() const noexcept {
    return implementation_->decoding;
}
TripleBuffer<FrameWindow>& Player::haptics() noexcept {
    return implementation_->haptics;
}
TripleBuffer<FrameWindow>& Player::picture() noexcept {
    return implementation_->picture;
}

}  // namespace dibhr
