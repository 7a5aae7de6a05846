// The clock of a replay, the thread that reads ahead of it, and the band of contacts.
#include "core/replay/session_player.hpp"

#include <pthread.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kTicksAhead = 400.0;  // at speed 1: longer than decoding a frame takes
constexpr std::size_t kBatch = 25;

/// What is computed for each moment.
struct ComputedRuns {
    std::optional<TouchParameters> other{};  ///< with these parameters
    bool algorithms{false};                  ///< with all algorithms and the same parameters

    [[nodiscard]] bool any() const noexcept { return other.has_value() || algorithms; }
};

/// The moments of a session, one after the other. One thread at a time, the opened session's.
class SessionMoments {
  public:
    /// `opened` must outlive it.
    explicit SessionMoments(OpenedSession& opened) : opened_(opened) {}

    /// The next moment will be the first tick at or after `from_s`. Computed runs begin earlier, so
    /// that the proxy has found its place.
    void begin(double from_s, const ComputedRuns& runs) {
        std::vector<ParameterChange> changes;
        const std::optional<TouchParameters>& other = runs.other;
        if (other) changes.push_back([other](TouchParameters& parameters) { parameters = *other; });
        if (runs.algorithms) {
            for (const Algorithm algorithm : all_algorithms()) {
                changes.push_back([other, algorithm](TouchParameters& parameters) {
                    if (other) parameters = *other;
                    parameters.algorithm = algorithm;
                });
            }
        }
        runs_ = runs;
        from_s_ = from_s;
        replay_.emplace(opened_.session, *opened_.frames.surfaces, std::move(changes),
                        runs.any() ? warm_up_s(opened_.session, from_s) : from_s);
    }

    /// Nothing after the last one, or when cancelled before the proxy had found its place. Throws
    /// InputError for a session or video that cannot be read on.
    [[nodiscard]] std::optional<SessionMoment> next(const std::atomic<bool>& cancelled) {
        while (replay_ && !cancelled && replay_->next()) {
            const TickRecord& tick = replay_->recorded();
            if (tick.t_s >= from_s_) return moment_of(tick);
        }
        return {};
    }

    /// The time of the tick before this one.
    [[nodiscard]] double time_before(std::int64_t tick) const {
        auto query =
            opened_.session.reader().rows("SELECT t FROM tick WHERE tick < " +
                                          std::to_string(tick) + " ORDER BY tick DESC LIMIT 1");
        return query.next() ? query.real(0) : opened_.session.begin_s();
    }

  private:
    [[nodiscard]] SessionMoment moment_of(const TickRecord& tick) {
        if (replay_->frames()) frames_ = replay_->frames();
        SessionMoment moment;
        moment.tick = tick;
        moment.count = opened_.session.count_of(tick.tick);
        moment.frames = frames_;
        moment.parameters = opened_.session.parameters_of(tick.settings);
        if (moment.parameters != nullptr)
            moment.bump = opened_.frames.surfaces->bump(*moment.parameters);
        if (runs_.other) moment.computed = replay_->touch(0);
        if (runs_.algorithms && tick.surface) add_others(moment);
        return moment;
    }

    void add_others(SessionMoment& moment) const {
        const TouchParameters& shown = runs_.other ? *runs_.other : moment.parameters->touch;
        std::size_t run = runs_.other ? 1 : 0;
        for (const Algorithm algorithm : all_algorithms()) {
            const Proxy& proxy = replay_->touch(run++).proxy;
            if (algorithm != shown.algorithm) moment.others.push_back({algorithm, proxy});
        }
    }

    OpenedSession& opened_;
    std::optional<SessionReplay> replay_{};
    double from_s_{0.0};
    ComputedRuns runs_{};
    std::shared_ptr<const TouchedFrames> frames_{};  // of the last tick with a surface
};

std::unique_ptr<ContactBand> read_band(const SessionReader& reader, double begin_s, double end_s,
                                       const std::atomic<bool>& stopping) {
    auto band = std::make_unique<ContactBand>();
    const double pieces_per_s =
        static_cast<double>(ContactBand::kPieces) / std::max(end_s - begin_s, 1e-3);
    auto query = reader.rows("SELECT t, contact, stand_in FROM tick WHERE surface ORDER BY tick");
    while (!stopping && query.next()) {
        ++band->hand.all;
        band->hand.mouse_fallback += query.integer(2);
        if (query.integer(1) == 0) continue;
        const double at = std::max(0.0, (query.real(0) - begin_s) * pieces_per_s);
        band->contact.at(std::min(static_cast<std::size_t>(at), ContactBand::kPieces - 1)) = true;
    }
    return band;
}

}  // namespace

OpenedSession::OpenedSession(const std::filesystem::path& file, bool any_media, SurfacesFrom from)
    : session(file),
      frames(open_surfaces((session.rescue_if_damaged(), session),
                           {.any_media = any_media, .colour = true}, from)) {
    if (session.reader().is_rescued()) try {
            band = read_band(session.reader(), session.begin_s(), session.end_s(), false);
        } catch (const InputError&) {  // the contacts alone are not shown
        }
    if (session.rows() > 0 && !session.sources().empty()) return;
    // One of the first format says why it has no video.
    if (!session.warning().empty()) throw InputError(session.warning());
    throw InputError(file.string() + ": holds no tick over a video; record a longer one");
}

struct SessionPlayer::Implementation {
    /// A request to the reading thread: where to go on.
    struct ReadRequest {
        double from_s{0.0};
        std::optional<std::int64_t> before_tick{};  ///< instead: the tick before this one
        ComputedRuns runs{};
        bool preview{false};  ///< shows the recorded moment there until the rest is computed
    };

    explicit Implementation(std::unique_ptr<OpenedSession> session)
        : opened(std::move(session)), moments(*opened) {
        playback.begin_s = playback.now_s = opened->session.begin_s();
        playback.end_s = opened->session.end_s();
        go_to({playback.begin_s, {}, {}, false});
        thread = std::thread([this] { run(); });
    }

    ~Implementation() {
        {
            const std::lock_guard lock(mutex);
            stopping = superseded = true;
        }
        wake_reader.notify_one();
        thread.join();
    }

    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    // The window's thread.

    /// A jump waits until the last one has arrived, so that pictures keep coming during a drag.
    void go_to(ReadRequest wanted) {
        playback.now_s = wanted.from_s;
        if (jumping) {
            next_jump = wanted;
            return;
        }
        jumping = true;
        steps = 0;
        {
            const std::lock_guard lock(mutex);
            pending_request = wanted;
            superseded = true;
            ahead.clear();
            complete = false;
            failure.clear();
        }
        wake_reader.notify_one();
    }

    void anchor(double at_s) {
        playback.now_s = at_s;
        anchored_s = at_s;
        anchored = now;
    }

    void take_due(const std::function<void(const SessionMoment&)>& passed) {
        double due_s = playback.now_s;
        if (playback.playing && !jumping) {
            const std::chrono::duration<double> since = now - anchored;
            due_s = anchored_s + playback.speed * since.count();
        }
        const bool leaves_part =
            playback.part && playback.now_s <= playback.part->to_s && due_s > playback.part->to_s;
        if (leaves_part) due_s = playback.part->to_s;
        bool all_taken = false;
        {
            const std::lock_guard lock(mutex);
            playback.failure = failure;
            if (jumping) arrive();
            while (!ahead.empty() && (is_due(ahead.front(), due_s) || due_now)) {
                take_next();
                passed(*moment);
            }
            playback.waiting = ahead.empty() && !complete;
            all_taken = (ahead.empty() && complete) || (leaves_part && !playback.waiting);
        }
        wake_reader.notify_one();
        if (jumping) return;
        if (playback.playing) advance_clock(due_s, all_taken);
        if (next_jump) go_to(*std::exchange(next_jump, std::nullopt));
    }

    [[nodiscard]] bool is_due(const SessionMoment& next, double due_s) const {
        return !jumping && playback.playing && next.tick.t_s <= due_s;
    }

    /// The first moment after a jump is shown at once.
    void arrive() {
        if (ahead.empty() && !complete) return;
        jumping = false;
        due_now = !ahead.empty();
    }

    void take_next() {
        moment = std::move(ahead.front());
        ahead.pop_front();
        if (std::exchange(due_now, false)) anchor(moment->tick.t_s);
        if (!playback.playing) playback.now_s = moment->tick.t_s;
        if (steps > 0) due_now = --steps > 0;
        due_now = due_now || moment->preview;
    }

    void advance_clock(double due_s, bool all_taken) {
        playback.now_s = std::clamp(due_s, playback.begin_s, playback.end_s);
        if (all_taken && playback.looping && playback.failure.empty()) {
            go_to({loop_begin_s(), {}, runs, true});
        } else if (all_taken) {
            playback.playing = false;
        } else if (playback.waiting && moment) {
            anchor(moment->tick.t_s);  // the clock waits for the reading thread
        }
    }

    /// Where a lap begins: with the played part, beyond that part with the session.
    [[nodiscard]] double loop_begin_s() const {
        const std::optional<MediaPart>& part = playback.part;
        return part && playback.now_s <= part->to_s ? part->from_s : playback.begin_s;
    }

    // The reading thread.

    void run() {
        pthread_setname_np(pthread_self(), "dibhr-session");
        std::unique_lock lock(mutex);
        for (;;) {
            wake_reader.wait(lock, [this] { return stopping || pending_request || wants_more(); });
            if (stopping) return;
            if (pending_request) request = *std::exchange(pending_request, std::nullopt);
            superseded = false;
            lock.unlock();
            std::vector<SessionMoment> read;
            bool at_end = false;
            const std::string trouble = attempt([&] { at_end = !read_on(read); });
            lock.lock();
            if (pending_request) continue;  // these are out of date
            std::move(read.begin(), read.end(), std::back_inserter(ahead));
            complete = at_end || !trouble.empty();
            if (!trouble.empty()) failure = trouble;
        }
    }

    [[nodiscard]] bool wants_more() const {
        return !complete && static_cast<double>(ahead.size()) < ticks_ahead;
    }

    /// False at the end.
    bool read_on(std::vector<SessionMoment>& read) {
        const bool preview = request && request->preview && request->runs.any();
        // After a jump one moment is enough to show.
        const std::size_t most = request ? 1 : kBatch;
        if (request) {
            if (request->before_tick) request->from_s = moments.time_before(*request->before_tick);
            request->before_tick.reset();
            moments.begin(request->from_s, preview ? ComputedRuns{} : request->runs);
        }
        while (read.size() < most) {
            std::optional<SessionMoment> next = moments.next(superseded);
            if (!next) return false;
            next->preview = preview;
            read.push_back(std::move(*next));
        }
        request = preview ? std::optional(ReadRequest{request->from_s, {}, request->runs, false})
                          : std::nullopt;
        return true;
    }

    template <typename Step>
    static std::string attempt(Step step) {
        try {
            step();
        } catch (const Error& error) {
            return error.what();
        } catch (const std::exception& error) {
            return std::string("the replay broke off (") + error.what() + "): open it again";
        }
        return {};
    }

    const std::unique_ptr<OpenedSession> opened;

    // The reading thread's.
    SessionMoments moments;
    std::optional<ReadRequest> request{};  // where to begin with the next reading

    // The window's thread's.
    SessionPlayback playback{};
    std::optional<SessionMoment> moment{};
    ComputedRuns runs{};
    std::optional<ReadRequest> next_jump{};
    Time now{};  // of the last picture
    Time anchored{};
    double anchored_s{0.0};
    bool jumping{false};
    bool due_now{false};  // take the next moment at once
    int steps{0};

    // Of both threads, under the mutex.
    std::mutex mutex{};
    std::condition_variable wake_reader{};
    std::optional<ReadRequest> pending_request{};
    std::deque<SessionMoment> ahead{};
    double ticks_ahead{kTicksAhead};
    bool complete{false};  // no tick follows those that are ahead
    std::string failure{};
    bool stopping{false};
    std::atomic<bool> superseded{false};  // the running read is out of date

    std::thread thread{};
};

SessionPlayer::SessionPlayer(std::unique_ptr<OpenedSession> opened)
    : implementation_(std::make_unique<Implementation>(std::move(opened))) {}

SessionPlayer::~SessionPlayer() = default;

void SessionPlayer::play() {
    Implementation& impl = *implementation_;
    if (impl.playback.playing) return;
    impl.playback.playing = true;
    impl.anchor(impl.playback.now_s);
    const std::optional<MediaPart>& part = impl.playback.part;
    const double ends_s = part ? std::min(part->to_s, impl.playback.end_s) : impl.playback.end_s;
    if (impl.playback.now_s >= ends_s) seek(impl.loop_begin_s());
}

void SessionPlayer::pause() {
    Implementation& impl = *implementation_;
    impl.playback.playing = false;
    if (impl.moment && !impl.jumping) impl.playback.now_s = impl.moment->tick.t_s;
}

void SessionPlayer::seek(double t_s) {
    Implementation& impl = *implementation_;
    const double within_s = std::clamp(t_s, impl.playback.begin_s, impl.playback.end_s);
    impl.go_to({within_s, {}, impl.runs, true});
}

void SessionPlayer::step(int ticks) {
    Implementation& impl = *implementation_;
    pause();
    if (!impl.moment || impl.jumping) return;
    if (ticks > 0) {
        impl.steps += ticks;
        impl.due_now = true;
    } else if (ticks < 0) {
        impl.go_to({impl.playback.now_s, impl.moment->tick.tick, impl.runs, true});
    }
}

void SessionPlayer::set_looping(bool looping) {
    implementation_->playback.looping = looping;
}

void SessionPlayer::set_part(const std::optional<MediaPart>& part) {
    implementation_->playback.part = part;
}

void SessionPlayer::set_speed(double speed) {
    Implementation& impl = *implementation_;
    impl.anchor(impl.playback.now_s);
    impl.playback.speed = std::clamp(speed, kSlowestSpeed, kFastestSpeed);
    const std::lock_guard lock(impl.mutex);
    impl.ticks_ahead = kTicksAhead * std::max(1.0, impl.playback.speed);
}

void SessionPlayer::compute(const std::optional<TouchParameters>& other) {
    Implementation& impl = *implementation_;
    impl.runs.other = other;
    impl.go_to({impl.playback.now_s, {}, impl.runs, false});
}

void SessionPlayer::compare(bool algorithms) {
    Implementation& impl = *implementation_;
    if (impl.runs.algorithms == algorithms) return;
    impl.runs.algorithms = algorithms;
    impl.go_to({impl.playback.now_s, {}, impl.runs, false});
}

void SessionPlayer::advance(Time now, const std::function<void(const SessionMoment&)>& passed) {
    implementation_->now = now;
    implementation_->take_due(passed);
}

const SessionMoment* SessionPlayer::moment() const {
    const auto& moment = implementation_->moment;
    return moment ? &*moment : nullptr;
}

const SessionPlayback& SessionPlayer::playback() const {
    return implementation_->playback;
}

ContactBandReader::ContactBandReader(OpenedSession& opened) : band_(std::move(opened.band)) {
    if (band_) return;
    const Session& session = opened.session;
    result_ = std::async(
        std::launch::async,
        [this, file = session.file(), begin_s = session.begin_s(), end_s = session.end_s()] {
            return read_band(SessionReader(file, IfDamaged::refuse), begin_s, end_s, stopping_);
        });
}

ContactBandReader::~ContactBandReader() {
    stopping_ = true;
    if (result_.valid()) result_.wait();
}

const ContactBand* ContactBandReader::band() {
    using std::chrono::seconds;
    if (result_.valid() && result_.wait_for(seconds(0)) == std::future_status::ready) {
        try {
            band_ = result_.get();
        } catch (const InputError&) {
            return nullptr;  // the player finds the same damage and reports it
        }
    }
    return band_.get();
}

}  // namespace dibhr
