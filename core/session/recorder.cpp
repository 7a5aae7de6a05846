// Writes every tick into one SQLite file from its own thread, so that no tick waits for a disk.
#include "core/session/recorder.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "core/files/content_hash.hpp"
#include "core/session/session_file.hpp"

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;

// The ring holds 16 s at 1 kHz; a transaction is lost when the program is killed, so it is short.
constexpr auto kBetweenDrains = std::chrono::milliseconds(20);
constexpr auto kLongestTransaction = std::chrono::milliseconds(100);
// How often the wall clock is recorded beside the ticks' own clock: both may drift.
constexpr auto kBetweenClocks = std::chrono::seconds(2);
// The most ticks taken at once, so that a transaction is little longer than its limit.
constexpr std::size_t kMostInDrain = 4096;

std::int64_t nanoseconds(Clock::time_point time) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

/// The absolute path; the path as given where the working directory is gone.
std::filesystem::path absolute_path(const std::filesystem::path& file) {
    std::error_code gone;
    std::filesystem::path whole = std::filesystem::absolute(file, gone);
    return file.empty() || gone ? file : whole;
}

/// Nothing when the file cannot be read or `cancelled` became true.
std::optional<SessionMedia> content_of(const std::filesystem::path& file,
                                       const std::atomic<bool>& cancelled) {
    try {
        const std::uintmax_t bytes = content_bytes(file);
        auto sum = sha256_of_file(file, cancelled);
        if (!sum) return std::nullopt;
        return SessionMedia{file, bytes, std::move(*sum)};
    } catch (const std::exception&) {
        return std::nullopt;  // the session then holds no sum of the file
    }
}

/// Computes the SHA-256 of files on threads of their own, so that no caller waits for large ones.
/// For one thread. Files that cannot be read are left out.
class FileHashes {
  public:
    FileHashes() = default;
    ~FileHashes() {
        cancelled_ = true;
    }  // gives up the sums that are not ready, and waits for that
    FileHashes(const FileHashes&) = delete;
    FileHashes& operator=(const FileHashes&) = delete;

    void request(const std::filesystem::path& file) try {
        sums_.push_back(
            std::async(std::launch::async, [this, file]() -> std::optional<SessionMedia> {
                const std::lock_guard one_after_the_other(disk_);
                return content_of(file, cancelled_);
            }));
    } catch (const std::system_error&) {  // no thread for it: left out, too
    }
    /// The sums that were completed since the last call.
    [[nodiscard]] std::vector<SessionMedia> take() {
        std::vector<SessionMedia> known;
        for (Sum& sum : sums_) {
            if (!ready(sum)) continue;
            if (auto content = sum.get()) known.push_back(std::move(*content));
        }
        std::erase_if(sums_, [](const Sum& sum) { return !sum.valid(); });
        return known;
    }
    [[nodiscard]] bool all_ready() const { return std::all_of(sums_.begin(), sums_.end(), ready); }

  private:
    using Sum = std::future<std::optional<SessionMedia>>;

    static bool ready(const Sum& sum) {
        return sum.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    }

    std::atomic<bool> cancelled_{false};
    std::mutex disk_{};
    std::vector<Sum> sums_{};
};

}  // namespace

struct Recorder::Implementation {
    Implementation(const std::filesystem::path& file, TickRing& ticks, const SessionFacts& facts,
                   Heartbeat* given_heart, Now time, const RecordedSurface& surface)
        : ring(ticks),
          now(std::move(time)),
          heart(given_heart != nullptr ? *given_heart : own_heart),
          dropped_before(ticks.dropped()),
          session(std::in_place, file, facts, surface) {
        batch.reserve(kMostInDrain);
        status.recording = true;
        status.bytes = session->bytes();
        bytes_before = session->bytes_recorded();
        thread = std::thread([this] { run(); });
    }

    ~Implementation() { stop(kPatience); }

    void stop(std::chrono::milliseconds for_sums) {
        if (!thread.joinable()) return;
        {
            const std::lock_guard lock(mutex);
            stopping = true;
            patience_for_sums = for_sums;
        }
        wake.notify_one();
        thread.join();
    }

    /// Queues a note that is written before the ticks that are pushed from now on.
    void enqueue(std::function<void(Implementation&)> note) {
        const std::lock_guard lock(mutex);
        notes.push_back(std::move(note));
    }

    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    // The recorder thread from here on.

    void run() {
        pthread_setname_np(pthread_self(), "dibhr-recorder");
        heart.count_computing_as_beat();
        try {
            while (!stop_requested()) drain();
            drain();
            close();
        } catch (const std::exception& error) {
            abort_recording(error.what());
        }
        heart.set_idle();
    }

    bool stop_requested() {
        std::unique_lock lock(mutex);
        heart.set_idle();
        const bool asked = wake.wait_for(lock, kBetweenDrains, [this] { return stopping; });
        heart.beat();
        return asked;
    }

    /// Empties the ring also after writing has failed: the producer must not find it full.
    void drain() {
        do {
            heart.beat();
            take_ticks();
            write([this] { add_batch(); });
            write([this] { commit_if_due(); });
        } while (batch.size() == kMostInDrain);
        const std::lock_guard lock(mutex);
        status.dropped = ring.dropped() - dropped_before;
        status.high_water = high_water;
        if (!session) notes.clear();
    }

    void take_ticks() {
        batch.clear();
        high_water = std::max(high_water, ring.size());
        for (TickRecord record; batch.size() < kMostInDrain && ring.pop(record);)
            batch.push_back(record);
    }

    /// The notes to which a tick of the batch refers were queued before the tick was pushed.
    void add_batch() {
        std::vector<std::function<void(Implementation&)>> queued;
        {
            const std::lock_guard lock(mutex);
            queued.swap(notes);
        }
        if (queued.empty() && batch.empty() && sums.all_ready()) return;
        open_transaction();
        if (!zero_ns && !batch.empty()) {
            first_s = batch.front().t_s;
            const std::int64_t first_ns = std::llround(first_s * kNanosecondsPerSecond);
            // Ticks of no clock of this machine count from now on.
            zero_ns =
                batch.front().zero_ns != 0 ? batch.front().zero_ns : nanoseconds(now()) - first_ns;
            set_clock(first_ns);
            add_early_marks();
        }
        for (const auto& note : queued) note(*this);
        for (const TickRecord& record : batch) session->add(record);
        uncommitted += batch.size();
        if (zero_ns && now() - clock_set >= kBetweenClocks)
            set_clock(nanoseconds(now()) - *zero_ns);
        add_contents();
    }

    void open_transaction() {
        if (transaction_begin) return;
        session->begin();
        transaction_begin = now();
    }

    /// The wall clock at time `t_ns` of the ticks.
    void set_clock(std::int64_t t_ns) {
        const Clock::time_point moment = now();
        const std::int64_t passed_ns = nanoseconds(moment) - *zero_ns - t_ns;
        session->add_clock(t_ns,
                           utc_now_s() - static_cast<double>(passed_ns) / kNanosecondsPerSecond,
                           ring.dropped() - dropped_before, high_water);
        clock_set = moment;
    }

    void add_contents() {
        for (const auto& file : session->take_new_files()) sums.request(file);
        for (const SessionMedia& content : sums.take()) session->set_content(content);
    }

    void add_mark(Clock::time_point moment, const std::string& tag, const std::string& text) {
        const auto t_ns = static_cast<double>(nanoseconds(moment) - zero_ns.value_or(0));
        add_mark_at(t_ns / kNanosecondsPerSecond, tag, text);
    }

    void add_mark_at(double t_s, const std::string& tag, const std::string& text) {
        if (!zero_ns)
            early_marks.push_back({0.0, tag, text});
        else
            session->add_mark({std::max(first_s, t_s), tag, text});
    }

    /// Marks made before the first tick, without a clock, are placed at that tick.
    void add_early_marks() {
        for (const SessionMark& mark : early_marks) {
            session->add_mark({first_s, mark.tag, mark.text});
        }
        early_marks.clear();
    }

    void commit_if_due() {
        if (transaction_begin && now() - *transaction_begin >= kLongestTransaction) commit();
    }

    void commit() {
        transaction_begin.reset();
        session->commit();
        const std::uint64_t bytes = session->bytes();
        const std::uint64_t grown = session->bytes_recorded() - bytes_before;
        const std::uint64_t missing_surfaces = session->missing_surfaces();
        const std::chrono::duration<double> passed = now() - begin;
        const std::lock_guard lock(mutex);
        status.rows += std::exchange(uncommitted, 0);
        status.bytes = bytes;
        status.missing_surfaces = missing_surfaces;
        if (passed.count() > 1.0)
            status.bytes_per_minute = 60.0 * static_cast<double>(grown) / passed.count();
    }

    void close() {
        const Clock::time_point patience = now() + patience_for_sums;
        while (session && !sums.all_ready() && now() < patience) {
            heart.beat();
            std::this_thread::sleep_for(kBetweenDrains / 4);
        }
        write([this] {
            open_transaction();
            add_contents();
            add_early_marks();
            if (zero_ns) set_clock(nanoseconds(now()) - *zero_ns);
            session->set_fact("row_count", std::to_string(status.rows + uncommitted));
            session->set_fact("dropped_count", std::to_string(status.dropped));
            session->set_fact("ring_high_water", std::to_string(high_water));
            session->set_fact("missing_surfaces", std::to_string(session->missing_surfaces()));
            session->set_fact("complete", "1");
            commit();
            session->merge_log();
            session->end_log();
        });
        session.reset();
        const std::lock_guard lock(mutex);
        status.recording = false;
    }

    /// Does `step` unless writing failed before. Where it fails now, sets the failure once and
    /// closes the file: what was committed stays readable.
    template <typename Step>
    void write(Step step) {
        if (!session) return;
        try {
            step();
        } catch (const std::exception& error) {
            abort_recording(error.what());
        }
    }

    [[nodiscard]] bool anything_left() const {
        std::error_code failed;
        return status.rows > 0 && std::filesystem::exists(session->path(), failed);
    }

    void abort_recording(const std::string& reason) {
        {
            const std::lock_guard lock(mutex);
            status.recording = false;
            if (!session) return;
            status.failure = "Recording to " + session->path().string() + " stopped: " + reason +
                             (anything_left() ? ". What was recorded until then is kept."
                                              : ". Nothing of it is kept.");
        }
        session.reset();  // may wait for the disk: not under the mutex, so that status() does not
        transaction_begin.reset();
    }

    TickRing& ring;
    const Now now;
    Heartbeat own_heart{};  // not monitored
    Heartbeat& heart;
    const std::uint64_t dropped_before;
    const Clock::time_point begin{now()};
    std::optional<SessionFile> session;  // none once writing broke off
    FileHashes sums{};
    std::vector<TickRecord> batch{};
    std::optional<Clock::time_point> transaction_begin{};
    std::optional<std::int64_t> zero_ns{};  // of the ticks' clock; none before the first
    double first_s{0.0};                    // the first tick's time
    std::vector<SessionMark> early_marks{};
    Clock::time_point clock_set{};
    std::uint64_t bytes_before{0};
    std::uint64_t high_water{0};
    std::uint64_t uncommitted{0};

    std::mutex mutex{};
    std::condition_variable wake{};
    bool stopping{false};                                       // under the mutex
    std::chrono::milliseconds patience_for_sums{0};             // the thread's once `stopping`
    RecorderStatus status{};                                    // under the mutex
    std::vector<std::function<void(Implementation&)>> notes{};  // under the mutex

    std::thread thread{};
};

Recorder::Recorder(const std::filesystem::path& file, TickRing& ring, const SessionFacts& facts,
                   Heartbeat* heart, Now now, const RecordedSurface& surface)
    : implementation_(
          std::make_unique<Implementation>(file, ring, facts, heart, std::move(now), surface)) {}

Recorder::~Recorder() = default;

void Recorder::parameters(const SessionParameters& parameters,
                          std::shared_ptr<const BumpMap> bump) {
    SessionParameters known = parameters;
    known.bump.file = absolute_path(parameters.bump.file);
    implementation_->enqueue(
        [known = std::move(known), bump = std::move(bump)](Implementation& writer) {
            writer.session->register_parameters(known, bump);
        });
}

void Recorder::media(std::uint32_t number, const std::filesystem::path& colour,
                     const std::filesystem::path& depth, const std::string& depth_meaning,
                     bool grow) {
    implementation_->enqueue([number, colour = absolute_path(colour), depth = absolute_path(depth),
                              depth_meaning, grow](Implementation& writer) {
        writer.session->register_media(number, colour, depth, depth_meaning, grow);
    });
}

void Recorder::complete_media(std::vector<SessionMedia> contents) {
    for (SessionMedia& content : contents) content.file = absolute_path(content.file);
    implementation_->enqueue([contents = std::move(contents)](Implementation& writer) {
        writer.session->complete_media(contents);
    });
}

void Recorder::maps(std::uint32_t version, std::vector<SessionMap> maps) {
    implementation_->enqueue([version, maps = std::move(maps)](Implementation& writer) {
        writer.session->add_maps(version, maps);
    });
}

void Recorder::mark(const std::string& tag, const std::string& text,
                    std::optional<std::chrono::steady_clock::time_point> moment) {
    implementation_->enqueue([moment = moment.value_or(implementation_->now()), tag, text](
                                 Implementation& writer) { writer.add_mark(moment, tag, text); });
}

void Recorder::mark_at(double t_s, const std::string& tag, const std::string& text) {
    implementation_->enqueue(
        [t_s, tag, text](Implementation& writer) { writer.add_mark_at(t_s, tag, text); });
}

void Recorder::set_fact(const std::string& key, const std::string& value) {
    implementation_->enqueue(
        [key, value](Implementation& writer) { writer.session->set_fact(key, value); });
}

RecorderStatus Recorder::finish(std::chrono::milliseconds for_sums) {
    implementation_->stop(for_sums);
    return status();
}

RecorderStatus Recorder::status() const {
    const std::lock_guard lock(implementation_->mutex);
    return implementation_->status;
}

}  // namespace dibhr
