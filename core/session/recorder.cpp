// Writes every tick into one SQLite file from its own thread, so that no tick waits for a disk.
#include "core/session/recorder.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/session/session_file.hpp"

namespace dibhr {

namespace {

using Clock = std::chrono::steady_clock;

// The ring holds 16 s at 1 kHz; a transaction may be lost to a power cut, so it is kept short.
constexpr auto kBetweenDrains = std::chrono::milliseconds(20);
constexpr auto kLongestTransaction = std::chrono::milliseconds(200);

}  // namespace

struct Recorder::Implementation {
    Implementation(const std::filesystem::path& file, TickRing& ticks, const SessionFacts& facts)
        : ring(ticks), dropped_before(ticks.dropped()), session(std::in_place, file, facts) {
        status.recording = true;
        status.bytes = session->bytes();
        thread = std::thread([this] { run(); });
    }

    ~Implementation() { stop(); }

    void stop() {
        if (!thread.joinable()) return;
        {
            const std::lock_guard lock(mutex);
            stopping = true;
        }
        wake.notify_one();
        thread.join();
    }

    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    // The recorder thread from here on.

    void run() {
        while (!stop_asked()) drain();
        drain();
        close();
    }

    bool stop_asked() {
        std::unique_lock lock(mutex);
        return wake.wait_for(lock, kBetweenDrains, [this] { return stopping; });
    }

    /// Empties the ring even when nothing can be written any more: the producer must not notice.
    void drain() {
        TickRecord record;
        while (ring.pop(record)) {
            write([&] { add(record); });
        }
        if (transaction_begin && Clock::now() - *transaction_begin >= kLongestTransaction) {
            write([&] { commit(); });
        }
        const std::lock_guard lock(mutex);
        status.dropped = ring.dropped() - dropped_before;
    }

    void add(const TickRecord& record) {
        if (!transaction_begin) {
            session->begin();
            transaction_begin = Clock::now();
        }
        session->add(record);
        ++uncommitted;
        // A producer that never pauses must not keep a transaction open.
        if (uncommitted % 1024 == 0 && Clock::now() - *transaction_begin >= kLongestTransaction) {
            commit();
        }
    }

    void commit() {
        transaction_begin.reset();
        session->commit();
        const std::uint64_t bytes = session->bytes();
        const std::lock_guard lock(mutex);
        status.rows += std::exchange(uncommitted, 0);
        status.bytes = bytes;
    }

    void close() {
        write([&] {
            if (!transaction_begin) session->begin();
            session->set_fact("row_count", std::to_string(status.rows + uncommitted));
            session->set_fact("dropped_count", std::to_string(status.dropped));
            session->set_fact("complete", "1");
            commit();
            session->merge_log();
        });
        session.reset();
        const std::lock_guard lock(mutex);
        status.recording = false;
    }

    /// Does `step` unless writing broke off; when it breaks off now, says so once and lets the file
    /// go: what was committed stays readable.
    template <typename Step>
    void write(Step step) {
        if (!session) return;
        try {
            step();
        } catch (const DatabaseError& error) {
            const std::lock_guard lock(mutex);
            status.recording = false;
            status.failure = "Recording to " + session->path().string() +
                             " stopped: " + error.what() +
                             ". What was recorded until then is kept.";
            session.reset();
            transaction_begin.reset();
        }
    }

    TickRing& ring;
    std::uint64_t dropped_before;
    std::optional<SessionFile> session;  // none once writing broke off
    std::optional<Clock::time_point> transaction_begin{};
    std::uint64_t uncommitted{0};

    std::mutex mutex{};
    std::condition_variable wake{};
    bool stopping{false};     // under the mutex
    RecorderStatus status{};  // under the mutex

    std::thread thread{};
};

Recorder::Recorder(const std::filesystem::path& file, TickRing& ring,
                   const std::map<std::string, std::string>& facts)
    : implementation_(std::make_unique<Implementation>(file, ring, facts)) {}

Recorder::~Recorder() = default;

RecorderStatus Recorder::finish() {
    implementation_->stop();
    return status();
}

RecorderStatus Recorder::status() const {
    const std::lock_guard lock(implementation_->mutex);
    return implementation_->status;
}

}  // namespace dibhr
