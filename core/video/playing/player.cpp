// The thread that cleans and publishes frames; decoding has its own thread.
#include "core/video/playing/player.hpp"

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
#include "core/realtime/memory.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/playing/live_playback.hpp"
#include "core/video/playing/playback.hpp"

namespace dibhr {
namespace {

using Time = Playback::Time;

/// A command to the player's thread. Of seeks, cleanings or maps in a row only the last one counts.
enum class Kind { step, seek, cleaning, maps };
struct Command {
    std::function<void(Playback&, Time)> action{};
    Kind kind{Kind::step};
};

/// Requested changes; the status includes them at once, so that a second step adds to the first.
struct RequestedState {
    std::optional<double> media_s{}, speed{};
    std::optional<bool> playing{}, looping{};
    std::optional<std::optional<MediaPart>> part{};

    void replace(const RequestedState& newer) {
        if (newer.media_s) media_s = newer.media_s;
        if (newer.speed) speed = newer.speed;
        if (newer.playing) playing = newer.playing;
        if (newer.looping) looping = newer.looping;
        if (newer.part) part = newer.part;
    }
    void apply_to(PlaybackStatus& status) const {
        status.media_s = media_s.value_or(status.media_s);
        status.speed = speed.value_or(status.speed);
        status.playing = playing.value_or(status.playing);
        status.looping = looping.value_or(status.looping);
        if (part) status.part = *part;
    }
};

}  // namespace

struct Player::Implementation {
    void post(Command command, const RequestedState& change = {});
    void run();

    [[nodiscard]] bool has_media() const { return playback.is_open() || live.is_open(); }
    void publish_live();
    bool take_live(Time now);
    bool wait_for_work(std::vector<Command>& taken);
    void work(const std::vector<Command>& taken);
    template <typename Action>
    bool attempt(Action action);
    void publish();
    void publish_status(const FrameWindow& window, Time published);

    TripleBuffer<FrameWindow> haptics{};
    TripleBuffer<FrameWindow> picture{};
    Heartbeat heart{}, decoding{};
    // Set before the thread starts.
    std::function<void()> on_frames{};
    std::function<void(const FrameWindow&)> on_window{};

    // Used by the player thread only.
    Playback playback{};
    LivePlayback live{};  // while it is open, files are not shown
    Time handed_over{};   ///< `cleaned` of the last frame whose publishing was measured
    std::string failure{};

    // Used by all threads, under the mutex.
    std::mutex mutex{};
    std::condition_variable wake{};
    std::vector<Command> commands{};
    RequestedState requested{};  ///< by commands that are not published yet
    PlaybackStatus status{};
    FrameWindow shown{};  ///< published last, for the time line
    std::optional<double> seek_target_s{};
    DrawingCost drawing{};
    bool live_update{false};  ///< the live source has news
    bool stopping{false};

    std::thread thread{};
};

void Player::Implementation::post(Command command, const RequestedState& change) {
    {
        const std::lock_guard lock(mutex);
        requested.replace(change);
        if (command.kind != Kind::step && !commands.empty() && commands.back().kind == command.kind)
            commands.pop_back();
        commands.push_back(std::move(command));
    }
    wake.notify_one();
}

/// False when the player is to end.
bool Player::Implementation::wait_for_work(std::vector<Command>& taken) {
    const bool busy =
        !live.is_open() && (playback.needs_frame() || playback.can_prepare_step_back());
    const Time due =
        live.is_open() ? live.next_due(std::chrono::steady_clock::now()) : playback.next_due();
    std::unique_lock lock(mutex);
    const auto called = [this] { return stopping || live_update || !commands.empty(); };
    if (!busy) heart.set_idle();
    if (!busy && due == Time::max())
        wake.wait(lock, called);
    else if (!busy)
        wake.wait_until(lock, due, called);
    taken.swap(commands);
    playback.set_drawing_cost(drawing);
    live_update = false;
    heart.beat();
    return !stopping;
}

/// Performs the commands, or without any reads one frame: a command waits for one frame at most.
void Player::Implementation::work(const std::vector<Command>& taken) {
    bool changed = !live.is_open() && playback.advance(std::chrono::steady_clock::now());
    for (const Command& command : taken) {
        failure.clear();
        attempt([&] { command.action(playback, std::chrono::steady_clock::now()); });
        changed = true;
    }
    if (live.is_open()) {
        changed = take_live(std::chrono::steady_clock::now()) || changed;
    } else if (!changed && playback.needs_frame()) {
        const bool readable = attempt([&] {
            if (playback.read_ahead(std::chrono::steady_clock::now()))
                playback.on_frame_read(std::chrono::steady_clock::now());
        });
        if (!readable) playback.end_here();
        changed = true;
    } else if (!changed && playback.can_prepare_step_back()) {
        playback.prepare_step_back();
    }
    if (changed) publish();
}

/// A frame that cannot be read is reported by the live status.
bool Player::Implementation::take_live(Time now) {
    bool changed = false;
    attempt([&] { changed = live.take(now); });
    return changed;
}

/// False when a file could not be read: keeps the failure for the status, and the shown frames.
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
    heart.count_computing_as_beat();
    std::vector<Command> taken;
    while (wait_for_work(taken)) {
        work(taken);
        taken.clear();
    }
    heart.set_idle();
}

/// Publishes the same window to both readers; frees at once what the old windows held.
void Player::Implementation::publish() {
    const FrameWindow window = live.is_open() ? live.window() : playback.window();
    const FrameWindow touchable = live.is_open() ? window : playback.touchable();
    if (on_window) on_window(touchable);
    haptics.publish(touchable);
    const Time published = std::chrono::steady_clock::now();
    picture.publish(window);
    haptics.back() = {};
    picture.back() = {};
    publish_status(window, published);
    if (on_frames) on_frames();
}

void Player::Implementation::publish_status(const FrameWindow& window, Time published) {
    const std::lock_guard lock(mutex);
    if (commands.empty()) requested = {};
    shown = window;
    seek_target_s = live.is_open() ? std::nullopt : playback.seek_target_s();
    status.preview = !live.is_open() && playback.shows_preview();
    status.failure = failure;
    status.live.reset();
    if (live.is_open()) return publish_live();
    if (!playback.is_open()) return;
    if (failure.empty()) status.failure = playback.description().trouble;
    if (status.failure.empty()) status.failure = playback.prepared().trouble();
    status.prepared = playback.prepared().found();
    status.open = true;
    status.playing = playback.playing();
    status.looping = playback.looping();
    status.ended = playback.ended();
    status.part = playback.part();
    status.speed = playback.speed();
    status.duration_s = playback.description().duration_s;
    status.frames = playback.description().frames;
    status.frames_per_s = playback.description().frames_per_s;
    status.shown_per_s = playback.shown_per_s();
    status.dropped = playback.dropped_in_words();
    status.most_pictures_per_s = playback.most_pictures_per_s();
    status.cleaning = playback.cleaning_in_words();
    status.steps = playback.steps();
    status.decoders = playback.description().decoders;
    const FrameCost& cost = playback.cost();
    status.decode_ms = cost.decode_ms + cost.clean_ms;
    status.clean_ms = cost.clean_ms;
    if (cost.cleaned == handed_over) return;
    handed_over = cost.cleaned;
    status.handover_us =
        std::chrono::duration<double, std::micro>(published - cost.cleaned).count();
}

/// The caller holds the mutex.
void Player::Implementation::publish_live() {
    const MediaDescription& media = live.description();
    status.live = live.status(std::chrono::steady_clock::now());
    status.open = true;
    status.playing = live.playing();
    status.ended = false;
    status.part.reset();
    status.speed = 1.0;
    status.duration_s = 0.0;
    status.frames = 0;
    status.frames_per_s =
        status.live->arrives_per_s > 0.0 ? status.live->arrives_per_s : media.frames_per_s;
    status.shown_per_s = status.frames_per_s;
    status.dropped.clear();
    status.most_pictures_per_s = 0.0;
    status.cleaning = live.cleaning_in_words();
    status.steps = live.steps();
    status.decoders.clear();
    status.decode_ms = status.clean_ms = live.clean_ms();
}

Player::Player(std::function<void()> on_frames, std::function<void(const FrameWindow&)> on_window)
    : implementation_(std::make_unique<Implementation>()) {
    implementation_->on_frames = std::move(on_frames);
    implementation_->on_window = std::move(on_window);
    implementation_->thread = std::thread([this] { implementation_->run(); });
}

Player::~Player() {
    {
        const std::lock_guard lock(implementation_->mutex);
        implementation_->stopping = true;
    }
    implementation_->wake.notify_one();
    implementation_->thread.join();
    implementation_->live.close();  // its threads lock the mutex until here
}

void Player::play_media(std::unique_ptr<Media> media, std::uint32_t number,
                        std::shared_ptr<const TouchMaps> maps) {
    Implementation* const player = implementation_.get();
    if (media->live()) {
        auto shared = std::make_shared<std::unique_ptr<Media>>(std::move(media));
        const auto live_update = [player] {
            const std::lock_guard lock(player->mutex);
            player->live_update = true;
            player->wake.notify_one();
        };
        player->post({[=](Playback& playback, Time) {
            const bool replaces = player->has_media();
            playback.close();
            player->live.open(std::move(*shared), number, maps, live_update);
            if (replaces) return_unused_memory();
        }});
        return;
    }
    // std::function must be copyable, hence shared; the command moves the reader out.
    auto reader = std::make_shared<std::unique_ptr<FrameReader>>(std::make_unique<FrameReader>(
        std::move(media), number,
        ReaderHeartbeats{&implementation_->decoding, &implementation_->heart}));
    (*reader)->set_maps(std::move(maps));
    implementation_->post({[reader, player](Playback& playback, Time now) {
        const bool replaces = player->has_media();
        playback.open(std::move(*reader), now);
        player->live.close();
        // Else the memory of the media before stays with the program.
        if (replaces) return_unused_memory();
    }});
}

void Player::play() {
    implementation_->post({[player = implementation_.get()](Playback& playback, Time now) {
                              player->live.is_open() ? player->live.play() : playback.play(now);
                          }},
                          {.playing = true});
}

void Player::pause() {
    implementation_->post({[player = implementation_.get()](Playback& playback, Time now) {
                              player->live.is_open() ? player->live.pause(now)
                                                     : playback.pause(now);
                          }},
                          {.playing = false});
}

void Player::seek(double media_s) {
    implementation_->post({[player = implementation_.get(), media_s](Playback& playback, Time now) {
                               if (!player->live.is_open()) playback.seek(media_s, now);
                           },
                           Kind::seek},
                          {.media_s = media_s});
}

void Player::step(int frames) {
    implementation_->post({[player = implementation_.get(), frames](Playback& playback, Time now) {
                              player->live.is_open() ? player->live.pause(now)
                                                     : playback.step(frames, now);
                          }},
                          {.playing = false});
}

void Player::set_looping(bool looping) {
    implementation_->post({[looping](Playback& playback, Time) { playback.set_looping(looping); }},
                          {.looping = looping});
}

void Player::set_part(const std::optional<MediaPart>& part) {
    implementation_->post({[part](Playback& playback, Time) { playback.set_part(part); }},
                          {.part = part});
}

void Player::set_speed(double speed) {
    implementation_->post(
        {[speed](Playback& playback, Time now) { playback.set_speed(speed, now); }},
        {.speed = speed});
}

void Player::set_cleaning(const CleaningOptions& options) {
    if (std::exchange(cleaning_, options) == options) return;
    implementation_->post({[player = implementation_.get(), options](Playback& playback, Time now) {
                               player->live.set_cleaning(options, now);
                               playback.set_cleaning(options);
                           },
                           Kind::cleaning});
}

void Player::set_motion(const MotionRequest& wanted) {
    if (std::exchange(motion_, wanted) == wanted) return;
    implementation_->post({[player = implementation_.get(), wanted](Playback& playback, Time) {
        player->live.set_motion(wanted);
        playback.set_motion(wanted);
    }});
}

void Player::set_drawing_cost(const DrawingCost& drawing) {
    const std::lock_guard lock(implementation_->mutex);
    implementation_->drawing = drawing;
}

void Player::set_maps(std::shared_ptr<const TouchMaps> maps) {
    implementation_->post(
        {[player = implementation_.get(), maps = std::move(maps)](Playback& playback, Time) {
             player->live.is_open() ? player->live.set_maps(maps) : playback.set_maps(maps);
         },
         Kind::maps});
}

void Player::record_live(std::uint32_t number, LiveSink sink) {
    implementation_->post(
        {[player = implementation_.get(), number, sink = std::move(sink)](Playback&, Time now) {
            if (player->live.is_open()) player->live.record(number, sink, now);
        }});
}

PlaybackStatus Player::status() const {
    const std::lock_guard lock(implementation_->mutex);
    PlaybackStatus status = implementation_->status;
    const FrameWindow& shown = implementation_->shown;
    const double moment_s = shown.clock.playback_s(std::chrono::steady_clock::now());
    const DepthBlend pair = shown.at(moment_s);
    if (pair.from == nullptr) return status;  // no frame yet
    // Between two frames the media time advances; at the loop's seam up to the end of the file.
    const double lasts_s = pair.to->media_s < pair.from->media_s
                               ? pair.to->time_s - pair.from->time_s
                               : pair.to->media_s - pair.from->media_s;
    const double passed_s = pair.blend * lasts_s;
    status.frame = pair.from->index;
    status.media_s = implementation_->seek_target_s.value_or(pair.from->media_s + passed_s);
    implementation_->requested.apply_to(status);
    return status;
}

const Heartbeat& Player::heart() const noexcept {
    return implementation_->heart;
}
const Heartbeat& Player::decoder_heartbeat() const noexcept {
    return implementation_->decoding;
}
TripleBuffer<FrameWindow>& Player::haptics() noexcept {
    return implementation_->haptics;
}
TripleBuffer<FrameWindow>& Player::picture() noexcept {
    return implementation_->picture;
}

}  // namespace dibhr
