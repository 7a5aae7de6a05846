// Brings a session's write-ahead log to the disk, and empties it, from a thread of its own.
#include "core/session/log_keeper.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <string>

namespace dibhr {

namespace {

constexpr auto kBetweenFlushes = std::chrono::seconds(1);
constexpr auto kLongestPause = std::chrono::milliseconds(200);
constexpr auto kWaitForPause = std::chrono::milliseconds(500);
constexpr off_t kLongLog = off_t{4} << 20;  // [bytes]

}  // namespace

LogKeeper::LogKeeper(const std::filesystem::path& session)
    : database_(session), log_(::open((session.string() + "-wal").c_str(), O_RDONLY | O_CLOEXEC)) {
    database_.execute("PRAGMA busy_timeout = 0; PRAGMA synchronous = NORMAL");
    database_.execute("SELECT count(*) FROM session");  // only now it knows of the log
    thread_ = std::thread([this] { run(); });
}

LogKeeper::~LogKeeper() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    changed_.notify_all();
    thread_.join();
    if (log_ >= 0) ::close(log_);
}

void LogKeeper::between_transactions() {
    std::unique_lock lock(mutex_);
    if (!wanted_) return;
    paused_ = true;
    changed_.notify_all();
    changed_.wait_for(lock, kLongestPause, [this] { return !wanted_; });
    paused_ = wanted_ = false;
}

void LogKeeper::run() {
    pthread_setname_np(pthread_self(), "dibhr-log");
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, kBetweenFlushes, [this] { return leaving_; })) {
        lock.unlock();
        keep();
        lock.lock();
    }
}

void LogKeeper::keep() {
    struct stat log {};
    if (log_ < 0 || ::fdatasync(log_) != 0 || ::fstat(log_, &log) != 0) return;
    if (log.st_size >= kLongLog) empty();
}

/// Most of the log is merged into the file while the writer goes on, the rest in a pause of it.
void LogKeeper::empty() {
    checkpoint("PASSIVE");
    std::unique_lock lock(mutex_);
    wanted_ = true;
    changed_.wait_for(lock, kWaitForPause, [this] { return paused_ || leaving_; });
    if (paused_) {
        lock.unlock();
        checkpoint("PASSIVE");
        lock.lock();
    }
    // All of it is merged and flushed, so that cutting the log waits for no disk. Unlike a log that
    // is written over, one that was cut never holds old pages that a power cut could bring back.
    if (paused_) checkpoint("TRUNCATE");
    wanted_ = false;
    changed_.notify_all();
}

void LogKeeper::checkpoint(const char* mode) noexcept {
    try {
        database_.execute(std::string("PRAGMA wal_checkpoint(") + mode + ")");
    } catch (const DatabaseError&) {
        // The log is whole and grows; a disk that fails is told of by the writer, who meets it too.
    }
}

}  // namespace dibhr
